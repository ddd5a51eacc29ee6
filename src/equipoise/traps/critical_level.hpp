// The largest level set of a quadratic form inside which it decreases along the full nonlinear flow.
#pragma once

#include <Eigen/Core>

#include "equipoise/model/parameters.hpp"

namespace equipoise {

/// Smallest V = d^T P d > 0 at which dV/dt >= 0 was found around the balanced state with ball angles `phi`, by sampling
/// `rays` directions (fixed pseudo-random sequence) and descending from the worst. The true one is below or
/// equal; 0 if P is not positive definite or V grows at once.
double critical_level(const model::Parameters& p, double speed, const double* phi, const Eigen::MatrixXd& form,
                      int rays);

}  // namespace equipoise
