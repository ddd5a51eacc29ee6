// Bordered matrices, and a pair of multipliers.
#include "equipoise/extras/cycles/cycle_shooting.hpp"

#include <array>
#include <cmath>
#include <complex>

#include "equipoise/core/math/bordered.hpp"
#include "equipoise/core/math/dense.hpp"

namespace equipoise {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

namespace {

// An orthonormal basis of the plane that two eigenvectors span: real ones, or real and imaginary part of one.
std::optional<MatrixXd> plane_of(const MatrixXd& a, const std::array<std::complex<double>, 2>& values) {
  const dense::EigenPairs pairs = dense::eigenpairs(a);
  if (!pairs.found) return std::nullopt;
  Index first = 0, second = 0;
  (pairs.values.array() - values[0]).abs().minCoeff(&first);
  Eigen::ArrayXd away = (pairs.values.array() - values[1]).abs();
  away[first] = INFINITY;
  away.minCoeff(&second);
  MatrixXd plane(a.rows(), 2);
  const VectorXcd one = pairs.vectors.col(first), other = pairs.vectors.col(second);
  const bool complex = values[0].imag() != 0.0;
  plane << one.real(), complex ? VectorXd(one.imag()) : VectorXd(other.real());
  for (int round = 0; round < 2; ++round) {
    plane.col(0).normalize();
    plane.col(1).normalize();
    plane.col(1) -= plane.col(0).dot(plane.col(1)) * plane.col(0);
  }
  plane.col(1).normalize();
  return plane.allFinite() ? std::optional(plane) : std::nullopt;
}

}  // namespace

MatrixXd CycleTest::matrix(const CycleArcs& arcs) const {
  const MatrixXd monodromy = arcs.monodromy();
  const Index n = monodromy.rows();
  if (change_ == CurveKind::cycle_flip) return monodromy + MatrixXd::Identity(n, n);
  MatrixXd a = MatrixXd::Zero(n + 1, n + 1);
  a.topLeftCorner(n, n) = monodromy - MatrixXd::Identity(n, n);
  a.col(n).head(n) = arcs.rates.back();
  a.row(n).head(n) = phase_.transpose();
  return a;
}

bool CycleTest::begin(const CycleArcs& arcs, const VectorXd& phase) {
  phase_ = phase;
  if (change_ == CurveKind::cycle_torus) return true;
  const MatrixXd a = matrix(arcs);
  row_ = column_ = VectorXd::Ones(a.rows()).normalized();
  for (int round = 0; round < 4; ++round) {
    const Bordered b = bordered(a, row_, column_);
    row_ = b.right.normalized();
    column_ = b.left.normalized();
  }
  return row_.allFinite() && column_.allFinite();
}

std::optional<CycleTest::Value> CycleTest::torus(const CycleArcs& arcs) const {
  // Wielandt's deflation: the shift's multiplier becomes 0, all others stay.
  const VectorXd &rate = arcs.rates.back(), share = phase_ / phase_.dot(rate);
  const MatrixXd monodromy = arcs.monodromy() - rate * share.transpose();
  const VectorXcd values = dense::eigenvalues(monodromy);
  // A pair is complex, or two real multipliers: its half sum and its product are smooth where the two meet.
  Value found;
  std::array<std::complex<double>, 2> pair;
  double least = INFINITY;
  for (Index i = 0; i < values.size(); ++i)
    for (Index k = 0; k < i; ++k) {
      const bool real = values[i].imag() == 0.0 && values[k].imag() == 0.0;
      if (!real && values[i] != std::conj(values[k])) continue;
      const double mean = 0.5 * (values[i] + values[k]).real(), product = (values[i] * values[k]).real(),
                   distance = std::hypot(mean - cosine_, product - 1.0);
      if (distance >= least) continue;
      least = distance;
      found.value = product - 1.0;
      found.cosine = mean;
      pair = {values[i], values[k]};
    }
  if (least == INFINITY) return std::nullopt;
  // The product is the determinant of what the matrix is on the plane of the pair, however close the two are.
  const auto right = plane_of(monodromy, pair), left = plane_of(monodromy.transpose(), pair);
  if (!right || !left) return std::nullopt;
  const MatrixXd dual = *left * dense::inverse(MatrixXd(right->transpose() * *left));
  const Eigen::Matrix2d within = dual.transpose() * monodromy * *right;
  Eigen::Matrix2d adjugate;
  adjugate << within(1, 1), -within(0, 1), -within(1, 0), within(0, 0);
  const MatrixXd weighted = dual * adjugate.transpose();
  const std::complex<double> unit(0.0, 1.0);
  const VectorXcd directions = right->col(0) + unit * right->col(1);
  found.weights = {weighted.col(0) - unit * weighted.col(1), directions,
                   -std::complex<double>(share.dot(right->col(0)), share.dot(right->col(1)))};
  return found;
}

std::optional<CycleTest::Value> CycleTest::at(const CycleArcs& arcs) const {
  if (change_ == CurveKind::cycle_torus) return torus(arcs);
  const MatrixXd a = matrix(arcs);
  const Index n = arcs.slopes.front().rows();
  const Bordered b = bordered(a, row_, column_);
  Value found;
  found.value = b.value;
  if (!std::isfinite(b.value)) return std::nullopt;
  found.right = b.right.normalized();
  found.left = b.left.normalized();
  found.weights = {-b.left.head(n), b.right.head(n), change_ == CurveKind::cycle_fold ? b.right[n] : 0.0};
  return found;
}

}  // namespace equipoise
