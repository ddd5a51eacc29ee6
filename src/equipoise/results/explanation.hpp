// A study explained: every quantity in both forms, what follows from them without any simulation, and what to beware
// of.
#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/mechanics/balanced_state.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/units/units.hpp"

namespace equipoise {

/// What an ensemble costs, in seconds of CPU, summed over threads, on the machine that measured them.
struct BasinCost {
  std::uint64_t starts = 0;    ///< that the study asks for
  double search = 0.0;         ///< for attractors; if it was cut off, what it had taken by then
  bool search_ended = false;   ///< else what starts take is not known
  double a_start = 0.0;        ///< in the mean of those measured
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

/// The balls' way into balance, linearised at the final speed.
struct BalancedMotion {
  std::array<double, model::max_balls> angles{};  ///< of a balanced state; of several, or of a continuum, one
  std::string less;             ///< what linear theory had to leave out: "without gravity"; empty: nothing
  double section_period = 0.0;  ///< time after which the equations repeat themselves; 0: they do not change
  /// Slowest first; without the continuum's own zeros. Where the equations repeat themselves: ln(multiplier) /
  /// section_period, whose imaginary parts are known but for whole turns in a section period.
  std::vector<std::complex<double>> eigenvalues;
  /// Largest displacement that is left in balance, of the race's centre from where it rests; none: the rotor rests.
  std::optional<double> left;
  bool stable = false;
  double slowest_rate = 0.0;  ///< largest real part
  /// Relative change of the slowest rate's size for a relative change of all drags: whether more drag is sooner.
  double drag_sensitivity = 0.0;
  bool grows() const { return slowest_rate > least_rate; }
  /// What is said of it holds there: ", without gravity, in the state shown, one of a continuum"; empty: everywhere.
  std::string place(const model::BalancedStates& states) const {
    const bool one_of_many = states.kind == model::BalancedStates::Kind::continuum;
    return (less.empty() ? "" : ", " + less) + (one_of_many ? ", in the state shown of a continuum" : "");
  }
  /// 1: more drag makes it die out sooner; -1: less drag does; 0: drag changes it by less than a hundredth of its own
  /// change.
  int more_drag() const { return drag_sensitivity > 0.01 ? 1 : drag_sensitivity < -0.01 ? -1 : 0; }
  std::optional<double> slowest_if_sliding;  ///< of balls that roll: slowest_rate of the same balls if they slid
};

/// Forced vibration of the rotor alone, per direction (x, y): amplitudes.
struct BareVibration {
  std::array<double, 2> displacement{}, force{};  ///< in R and M R omega_c^2
};

/// A formula of docs/rules-of-thumb.md, applied to the study: an estimate, not a result.
struct RuleOfThumb {
  std::string id, name;                         ///< "ball_mass", "ball mass"
  std::string formula, source;                  ///< in the symbols of docs/equations.md; where it comes from
  std::optional<bool> kept = {};                ///< none: it asks for nothing, or cannot be told
  std::string words = {};                       ///< what follows; without figures, why it says nothing of this study
  std::vector<ExplainedQuantity> figures = {};  ///< by the rule, and by linear theory where that knows better
};

/// How long a motor takes to bring the rotor to speed, balls turning with it.
struct RunUp {
  double inertia = 0.0;         ///< of rotor and balls
  double speed = 0.0;           ///< that it is counted to: a share of the final one
  std::optional<double> alone;  ///< without any losses; none: never
  std::optional<double>
      shaken;               ///< less the torque that the rotor's own unbalance takes at each speed; none: it stalls
  double stalls_at = 0.0;   ///< then: the speed that it comes to
  double last_piece = 0.0;  ///< when the last piece of the motor's law begins, from where a horizon counts
};

struct Explanation {
  Study study;
  std::vector<ExplainedQuantity> quantities;
  std::array<double, 2> critical_alone{}, critical_with_balls{};  ///< by direction (x, y)
  std::optional<double> speed;                                    ///< final; none: the motor holds none
  std::string speed_words;         ///< of a motor: why it is that; without `speed`, why there is none
  bool speeds_up = false;          ///< for ever, in balance: the motor's last torque acts for good
  std::optional<RunUp> run_up;     ///< of a motor that speeds the rotor up
  std::optional<double> spin_up;   ///< time until it is reached; none: it does not change, or depends on the motor
  std::vector<double> ball_width;  ///< angle that each takes up in the race; empty: the study gives no size
  /// What the balls have to cancel: lambda, or what an off-centre race makes of it at the final speed.
  double unbalance = 0.0;
  double least_unbalance = 0.0, largest_unbalance = 0.0;  ///< that they can cancel beside each other
  /// Gravity left out, and supports that differ. None, too, where the balls have no room to be balanced.
  model::BalancedStates balanced;
  double sag = 0.0;                     ///< of the rotor's centre under the weight of rotor and balls
  std::optional<double> gravity_ratio;  ///< weight of a ball over its centrifugal force; none without gravity or speed
  std::optional<BalancedMotion> motion;
  std::string no_motion;  ///< why `motion` is not there
  std::optional<BareVibration> bare;
  std::optional<double> reynolds;  ///< of a ball that keeps the critical speed while the rotor runs at its final one
  std::vector<RuleOfThumb> advice;
  std::vector<std::string> warnings;
  std::optional<BasinCost> cost;  ///< of basin; if it was measured
};

}  // namespace equipoise
