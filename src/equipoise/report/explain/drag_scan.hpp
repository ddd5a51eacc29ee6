// The linearised approach to balance as drag changes.
#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"

namespace equipoise {

/// Rates near one balanced state as all drags are multiplied by one factor.
class DragScan {
 public:
  /// At constant `speed`, on equal supports and without gravity. `family`: the state is one of a continuum.
  DragScan(const model::Parameters& p, double speed, const std::array<double, model::max_balls>& angles, bool family);

  /// Largest real part of an eigenvalue, the continuum's own zeros left out.
  double slowest(double factor) const;

  /// The factors within [low, high] at which balls settle at `share` of the fastest rate or faster. None if no factor
  /// makes balance stable.
  struct Range {
    double low, best, high;
  };
  std::optional<Range> range(double share, double low, double high) const;

 private:
  double fastest_within(double low, double high) const;
  double end_of(double best, double end, double rate) const;

  Eigen::MatrixXd without_, drag_;  // the equations are linear in drag
  int freedom_;
};

}  // namespace equipoise
