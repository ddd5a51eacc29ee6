// The largest level set of a quadratic form inside which it decreases along the full nonlinear flow.
#pragma once

#include <cstddef>
#include <deque>

#include <Eigen/Core>

#include "equipoise/core/base/random.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

/// Random directions, the same for every study, by number or one after the other. Each is made once for all searches
/// that share them.
class Directions {
 public:
  explicit Directions(Eigen::Index size) : size_(size) {}
  Eigen::VectorXd operator[](std::size_t number) { return unscaled(number).normalized(); }
  Eigen::VectorXd next() { return (*this)[next_++]; }
  /// Components are standard normal deviates.
  const Eigen::VectorXd& unscaled(std::size_t number);

 private:
  const Eigen::Index size_;
  RandomStream random_;
  std::deque<Eigen::VectorXd> made_;
  std::size_t next_ = 0;
};

/// Smallest V = d^T P d > 0 with dV/dt >= 0 found around the balanced state `centre` of a smooth system with section
/// `none`. It samples `rays` directions (a fixed pseudo-random sequence), takes random steps from the worst, and
/// descends by gradients from the principal directions of dV/dt. The true one is below or equal; 0 if P is not positive
/// definite or V grows at once. Not `descending`: by rays and random steps alone, each ray tested in two places: for
/// comparing forms. For narrow level sets that is several times too high.
double critical_level(const model::System& system, const Eigen::VectorXd& centre, const Eigen::MatrixXd& form, int rays,
                      Directions& vectors, bool descending = true);

}  // namespace equipoise
