// Least squares by normal equations: Chebyshev polynomials of points spread over a cube are nearly orthogonal.
#include "equipoise/core/math/polynomial_terms.hpp"

#include "equipoise/core/math/dense.hpp"

namespace equipoise {

Eigen::MatrixXd polynomial_fit(const std::vector<Eigen::VectorXd>& terms, const std::vector<Eigen::VectorXd>& values) {
  const auto count = terms.front().size();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(count, values.front().size());
  for (std::size_t i = 0; i < terms.size(); ++i) {
    normal += terms[i] * terms[i].transpose();
    right += terms[i] * values[i].transpose();
  }
  normal.diagonal().array() += 1e-13 * normal.trace();  // for coordinates that turn out not to vary
  return dense::LinearSolver(normal).solve(right);
}

}  // namespace equipoise
