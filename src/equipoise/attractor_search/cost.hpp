// What deciding a start costs, as far as linear theory tells: stiff studies are refused before they begin.
#pragma once

#include "equipoise/classification/classification_rule.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// The work for one start that comes to balance.
struct StartCost {
  double time = 0.0;     ///< until it is decided: about one e-folding on the slow way into balance (drag 20: 0.8)
  double fastest = 0.0;  ///< rate of decay that limits the step of an explicit method
  bool by_drag = false;  ///< it is that of balls in their race, else of the supports
  double cause = 0.0;    ///< the ball drag or support damping that it comes from
  double steps = 0.0;    ///< of integration
  /// The largest ball drag (or support damping) with which a start took no more than most_steps, all else being equal.
  double allowed = 0.0;

  bool bearable() const;
};

/// Steps a start beyond which a study is refused: pilots and tries, 10^4 starts and more, then take a minute.
inline constexpr double most_steps = 3e4;

/// Largest speed of a rotor, in critical speeds: beyond any machine, and the integrator's steps shrink with the turns
/// to be made.
inline constexpr double fastest_speed = runaway_speed;

StartCost start_cost(const Study& study);

/// Throws InputError for a study whose starts would take more than most_steps each because it is stiff.
void check_cost(const Study& study);

}  // namespace equipoise
