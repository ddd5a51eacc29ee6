// A study explained: every quantity in both forms, what follows from them without any simulation, and what to beware
// of.
#pragma once

#include <array>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/model/balanced_state.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/study/units.hpp"

namespace equipoise {

/// One line of the table of quantities.
struct ExplainedQuantity {
  std::string symbol, name;
  double value;                               ///< dimensionless
  std::optional<study::Dimension> dimension;  ///< none: a plain number in both forms
};

/// The balls' way into balance, linearised at the final speed.
struct BalancedMotion {
  std::array<double, model::max_balls> angles{};  ///< of a balanced state; of several, or of a continuum, one
  std::vector<std::complex<double>> eigenvalues;  ///< slowest first; without the continuum's own zeros
  bool stable = false;
  double slowest_rate = 0.0;  ///< largest real part
  /// Relative change of the slowest rate's size for a relative change of all drags: whether more drag is sooner.
  double drag_sensitivity = 0.0;
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

struct Explanation {
  Study study;
  std::vector<ExplainedQuantity> quantities;
  std::array<double, 2> critical_alone{}, critical_with_balls{};  ///< by direction (x, y)
  std::optional<double> speed;                                    ///< final; none: nothing prescribes one
  std::optional<double> spin_up;  ///< time until it is reached; none: it does not change, or depends on the motor
  double least_unbalance = 0.0, largest_unbalance = 0.0;  ///< lambda that the balls can cancel
  model::BalancedStates balanced;                         ///< gravity left out
  double sag = 0.0;                                       ///< of the rotor's centre under the weight of rotor and balls
  std::optional<double> gravity_ratio;  ///< weight of a ball over its centrifugal force; none without gravity or speed
  std::optional<BalancedMotion> motion;
  std::string no_motion;  ///< why `motion` is not there
  std::optional<BareVibration> bare;
  std::optional<double> reynolds;  ///< of a ball that keeps the critical speed while the rotor runs at its final one
  std::vector<RuleOfThumb> advice;
  std::vector<std::string> warnings;
};

}  // namespace equipoise
