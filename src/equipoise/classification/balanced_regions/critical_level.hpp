// The largest level set of a quadratic form inside which it decreases along the full nonlinear flow.
#pragma once

#include <cstddef>
#include <deque>

#include <Eigen/Core>

#include "equipoise/core/base/random.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

/// Random vectors that all searches try in the same order; each is made once for all searches that share them.
class SearchVectors {
 public:
  explicit SearchVectors(Eigen::Index size) : size_(size) {}
  const Eigen::VectorXd& operator[](std::size_t number);

 private:
  const Eigen::Index size_;
  RandomStream random_;
  std::deque<Eigen::VectorXd> made_;
};

/// Smallest V = d^T P d > 0 with dV/dt >= 0 found around the balanced state `centre` of a smooth system with section
/// `none`. It samples `rays` directions (a fixed pseudo-random sequence), takes random steps from the worst, and
/// descends by gradients from the principal directions of dV/dt. The true one is below or equal; 0 if P is not positive
/// definite or V grows at once.
double critical_level(const model::System& system, const Eigen::VectorXd& centre, const Eigen::MatrixXd& form, int rays,
                      SearchVectors& vectors);

/// The same by rays and random steps alone, each ray tested in two places: for comparing forms. For narrow level sets
/// it is several times too high.
double level_by_rays(const model::System& system, const Eigen::VectorXd& centre, const Eigen::MatrixXd& form, int rays,
                     SearchVectors& vectors);

}  // namespace equipoise
