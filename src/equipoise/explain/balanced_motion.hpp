// The motion near balance, linearised: how fast balls settle there, and how that hangs on their drag.
#pragma once

#include <array>
#include <complex>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/model/balanced_state.hpp"
#include "equipoise/results/explanation.hpp"

namespace equipoise {

inline constexpr double least_rate = 1e-9;  ///< slower than any horizon shows

/// The balls' angles in one balanced state of these; of a continuum far from its ends. None if there is none.
std::optional<std::array<double, model::max_balls>> balanced_angles(const model::BalancedStates& states,
                                                                    const model::Parameters& p);

/// Fills `e.motion`, or `e.no_motion` with why not.
void linearise(Explanation& e);

/// Rates near one balanced state as all drags are multiplied by one factor.
class DragScan {
 public:
  /// At constant `speed`, on equal supports, without gravity and with a centred race.
  DragScan(const model::Parameters& p, double speed, const std::array<double, model::max_balls>& angles, bool family);

  /// Largest real part of an eigenvalue, the continuum's own zeros left out.
  double slowest(double factor) const;

  /// The factors around the best one within which balls settle at `share` of its rate or faster. None if no factor
  /// from `low` to `high` makes balance stable; ends that are not within these are these.
  struct Range {
    double low, best, high;
  };
  std::optional<Range> range(double share, double low, double high) const;

 private:
  double fastest_within(double low, double high) const;
  double end_of(double best, double end, double rate) const;

  Eigen::MatrixXd without_, drag_;  // the equations are linear in drag
  bool family_;
};

}  // namespace equipoise
