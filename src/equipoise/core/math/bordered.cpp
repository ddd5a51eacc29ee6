// By LU factors of the bordered matrix and of its transpose.
#include "equipoise/core/math/bordered.hpp"

#include "equipoise/core/math/dense.hpp"

namespace equipoise {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Bordered bordered(const MatrixXd& a, const VectorXd& row, const VectorXd& column) {
  const Index n = a.rows();
  MatrixXd whole = MatrixXd::Zero(n + 1, n + 1);
  whole.topLeftCorner(n, n) = a;
  whole.col(n).head(n) = column;
  whole.row(n).head(n) = row.transpose();
  const VectorXd unit = VectorXd::Unit(n + 1, n), right = dense::LinearSolver(whole).solve(unit),
                 left = dense::LinearSolver(whole.transpose()).solve(unit);
  return {right.head(n), left.head(n), right[n]};
}

bool fit_borders(const MatrixXd& a, int rounds, VectorXd& row, VectorXd& column) {
  row = column = VectorXd::Ones(a.rows()).normalized();
  for (int round = 0; round < rounds; ++round) {
    const Bordered b = bordered(a, row, column);
    row = b.right.normalized();
    column = b.left.normalized();
  }
  return row.allFinite() && column.allFinite();
}

std::optional<Eigen::VectorXcd> eigenvector_near(const MatrixXd& a, std::complex<double> value) {
  const dense::EigenPairs pairs = dense::eigenpairs(a);
  if (!pairs.found) return std::nullopt;
  Index nearest = 0;
  (pairs.values.array() - value).abs().minCoeff(&nearest);
  return Eigen::VectorXcd(pairs.vectors.col(nearest));
}

}  // namespace equipoise
