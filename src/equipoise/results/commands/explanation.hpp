// A study explained: every quantity in both forms, what follows from them without simulation, and warnings.
#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/balance/carrying.hpp"
#include "equipoise/machine/mechanics/whirl.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise {

/// The cost of an ensemble in seconds of CPU, summed over threads, on the machine that measured it.
struct BasinCost {
  std::uint64_t starts = 0;    ///< that the study asks for
  double search = 0.0;         ///< attractor search; if it was cut off, its time until then
  bool search_ended = false;   ///< otherwise the time per start is not known
  double a_start = 0.0;        ///< mean over the measured starts
  std::uint64_t measured = 0;  ///< starts

  double total() const { return search + static_cast<double>(starts) * a_start; }
};

/// One line of the table of quantities.
struct ExplainedQuantity {
  std::string symbol, name;
  double value;                               ///< dimensionless
  std::optional<study::Dimension> dimension;  ///< none: a plain number in both forms
};

inline constexpr double least_rate = 1e-9;  ///< slower than any horizon shows

/// How the balls move into balance, linearised at the final speed.
struct BalancedMotion {
  std::array<double, model::max_balls> angles{};  ///< of a balanced state; of several, or of a continuum, one
  std::string less;             ///< what linear theory had to leave out: "without gravity"; empty: nothing
  double section_period = 0.0;  ///< time after which the equations repeat themselves; 0: they do not change
  /// Slowest first; without the continuum's own zeros. Where the equations repeat themselves: ln(multiplier) /
  /// section_period, whose imaginary parts are known but for whole turns in a section period.
  std::vector<std::complex<double>> eigenvalues;
  /// Largest displacement left in balance, of the race's centre from its rest position; empty: the rotor rests.
  std::optional<double> left;
  bool stable = false;
  double slowest_rate = 0.0;  ///< largest real part
  /// Relative change of the slowest rate's size per relative change of all drags: whether more drag is faster.
  double drag_sensitivity = 0.0;
  bool grows() const { return slowest_rate > least_rate; }
  /// Where statements about it hold: ", without gravity, in the state shown, one of a continuum"; empty: everywhere.
  std::string place(const model::BalancedStates& states) const {
    const bool one_of_many = states.kind == model::BalancedStates::Kind::continuum;
    return (less.empty() ? "" : ", " + less) + (one_of_many ? ", in the state shown of a continuum" : "");
  }
  /// 1: more drag makes it die out sooner; -1: less drag does; 0: drag changes it by less than 1 % of its own change.
  int more_drag() const { return drag_sensitivity > 0.01 ? 1 : drag_sensitivity < -0.01 ? -1 : 0; }
  std::optional<double> slowest_if_sliding;  ///< for rolling balls: slowest_rate if they slid
};

/// Forced vibration of the rotor alone, per direction (x, y): amplitudes.
struct BareVibration {
  std::array<double, 2> displacement{}, force{};  ///< in R and M R omega_c^2
};

/// One plane of balls: what they have to cancel there, and the range that they can.
struct ExplainedPlane {
  double at = 0.0;  ///< along the shaft, from the centre of mass
  double unbalance = 0.0, least = 0.0, most = 0.0;
  std::string why_not;  ///< empty: they can
};

/// Of a tilting rotor.
struct TiltExplanation {
  model::WhirlSpeeds alone, with_balls;
  double couple = 0.0;                 ///< couple unbalance, in M R^2
  std::vector<ExplainedPlane> planes;  ///< of balls in one plane or two that can cancel a couple
  /// Forced vibration of the rotor alone at the final speed: furthest from the axis at each bearing that is stated.
  std::vector<double> at_bearings;
  std::vector<double> forces;  ///< then, the largest force at each bearing, if each is known; else empty
};

/// A formula of docs/explanation/rules-of-thumb.md, applied to the study: an estimate, not a result.
struct RuleOfThumb {
  std::string id, name;           ///< "ball_mass", "ball mass"
  std::string formula, source;    ///< in the symbols of docs/explanation/equations.md; where it comes from
  std::optional<bool> kept = {};  ///< empty: it requires nothing, or this cannot be decided
  std::string words = {};         ///< what follows; without figures, why it does not apply to this study
  std::vector<ExplainedQuantity> figures = {};  ///< by the rule, and by linear theory where that is more accurate
};

/// Time in which a motor brings the rotor to speed, with the balls turning along.
struct RunUp {
  double inertia = 0.0;         ///< of rotor and balls
  double speed = 0.0;           ///< the speed counted to: a part of the final one
  std::optional<double> alone;  ///< without losses; empty: never
  std::optional<double>
      shaken;               ///< less the torque that the rotor's own unbalance absorbs at each speed; empty: it stalls
  double stalls_at = 0.0;   ///< in that case, the speed that it comes to
  double last_piece = 0.0;  ///< when the motor's last piece begins, from which a horizon counts
};

struct Explanation {
  Study study;
  std::vector<ExplainedQuantity> quantities;
  /// By direction (x, y). For a tilting rotor: the lowest and the highest that unbalance excites.
  std::array<double, 2> critical_alone{}, critical_with_balls{};
  std::optional<double> speed;     ///< final; empty: the motor holds none
  std::string speed_words;         ///< for a motor: why it has this speed; without `speed`, why there is none
  bool speeds_up = false;          ///< in balance, for ever: the motor's last torque acts for good
  std::optional<RunUp> run_up;     ///< of a motor that speeds the rotor up
  std::optional<double> spin_up;   ///< time until `speed` is reached; empty: it is constant, or depends on the motor
  std::vector<double> ball_width;  ///< angle that each takes up in the race; empty: the study gives no size
  /// What the balls have to cancel: lambda, or its equivalent for an off-centre race at the final speed.
  double unbalance = 0.0;
  double least_unbalance = 0.0, largest_unbalance = 0.0;  ///< range that they can cancel side by side
  /// Without gravity and with averaged supports. Also none if the balls have no room to be balanced.
  model::BalancedStates balanced;
  double sag = 0.0;                     ///< of the rotor's centre under the weight of rotor and balls
  std::optional<double> gravity_ratio;  ///< weight of a ball over its centrifugal force; empty without gravity or speed
  std::optional<model::Carrying> carrying;  ///< of balls by their drag, against their weight
  std::optional<BalancedMotion> motion;
  std::string no_motion;  ///< why `motion` is not there
  std::optional<BareVibration> bare;
  std::optional<TiltExplanation> tilt;
  std::optional<double> reynolds;  ///< for a ball that stays at the critical speed while the rotor runs at its final
                                   ///< speed
  std::vector<RuleOfThumb> advice;
  std::vector<std::string> warnings;
  /// Of rotor and balls: the force that holds the sag.
  double weight() const {
    const model::Parameters& p = study.parameters;
    return tilt ? (1.0 + p.total_mass()) * p.gravity : sag * p.stiffness[1];
  }
  std::optional<BasinCost> cost;  ///< of the ensemble, if it was measured
};

}  // namespace equipoise
