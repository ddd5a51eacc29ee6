// The linearised approach to balance as drag changes.
#pragma once

#include <array>
#include <complex>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/mechanics/balanced_state.hpp"
#include "equipoise/results/explanation.hpp"

namespace equipoise {

/// Rounding moves an eigenvalue by about 1e-15, a double zero, as continua have without drag, by its square root.
inline constexpr double zero_rate = 1e-7;

/// Slowest first, without the continuum's own `freedom` zeros; of a continuum, rates up to `zero` become 0.
std::vector<std::complex<double>> without_continuum(const Eigen::VectorXcd& rates, int freedom, double zero);

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
