// Terms of a polynomial in several coordinates, and its fit.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace equipoise {

/// Products of Chebyshev polynomials of 2 x - 1, for each coordinate x in [0, 1], of total degree up to `degree`.
inline Eigen::VectorXd polynomial_terms(const std::vector<double>& coordinates, int degree) {
  std::vector<double> terms;
  const auto add = [&](const auto& self, std::size_t k, int left, double product) -> void {
    if (k == coordinates.size()) {
      terms.push_back(product);
      return;
    }
    const double x = 2.0 * coordinates[k] - 1.0;
    double before = 1.0, here = x;
    self(self, k + 1, left, product);
    for (int d = 1; d <= left; ++d) {
      self(self, k + 1, left - d, product * here);
      before = std::exchange(here, 2.0 * x * here - before);
    }
  };
  add(add, 0, degree, 1.0);
  return Eigen::Map<const Eigen::VectorXd>(terms.data(), static_cast<Eigen::Index>(terms.size()));
}

/// Between two points with equally many coordinates.
inline double squared_distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

/// Least-squares coefficients, one row per term and one column per quantity; rows of `values` match `terms`.
Eigen::MatrixXd polynomial_fit(const std::vector<Eigen::VectorXd>& terms, const std::vector<Eigen::VectorXd>& values);

}  // namespace equipoise
