// Estimates the cost of a start from linear theory: stiff studies are refused before they begin.
#pragma once

#include "equipoise/simulation/rule/classification_rule.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// The work for one start that comes to balance.
struct StartCost {
  double time = 0.0;     ///< until it is decided: about one e-folding of the slow approach to balance (drag 20: 0.8)
  double fastest = 0.0;  ///< decay rate that limits the step of an explicit method
  bool by_drag = false;  ///< whether that is of balls in their race, else of the supports
  double cause = 0.0;    ///< the ball drag or support damping behind it
  double steps = 0.0;    ///< integration steps
  /// The largest such drag (or damping) with which a start takes at most most_steps, all else being equal.
  double allowed = 0.0;

  bool bearable() const;
};

/// Studies with more steps a start are refused: at this limit pilots and trials, 10^4 starts and more, take a minute.
inline constexpr double most_steps = 3e4;

/// Largest speed of a rotor, in critical speeds. No machine is faster, and the integrator's steps shrink with the
/// speed.
inline constexpr double fastest_speed = runaway_speed;

StartCost start_cost(const Study& study);

/// Throws InputError for a study whose starts would take more than most_steps each because it is stiff.
void check_cost(const Study& study);

}  // namespace equipoise
