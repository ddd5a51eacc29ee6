// Bordered matrices, and a pair of multipliers.
#include "equipoise/cycles/cycle_test.hpp"

#include <cmath>

#include "equipoise/math/bordered.hpp"
#include "equipoise/math/dense.hpp"

namespace equipoise {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

MatrixXd CycleTest::matrix(const CycleArcs& arcs) const {
  const MatrixXd monodromy = arcs.monodromy();
  const Index n = monodromy.rows();
  if (change_ == CycleChange::flip) return monodromy + MatrixXd::Identity(n, n);
  MatrixXd a = MatrixXd::Zero(n + 1, n + 1);
  a.topLeftCorner(n, n) = monodromy - MatrixXd::Identity(n, n);
  a.col(n).head(n) = arcs.rates.back();
  a.row(n).head(n) = phase_.transpose();
  return a;
}

bool CycleTest::begin(const CycleArcs& arcs, const VectorXd& phase) {
  phase_ = phase;
  if (change_ == CycleChange::torus) return true;
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
  const MatrixXd monodromy = arcs.monodromy();
  const VectorXcd values = dense::eigenvalues(monodromy);
  // A pair is complex, or two real multipliers: its half sum and its product are smooth where the two meet.
  Value found;
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
      found.multiplier = values[values[i].imag() > 0.0 ? i : k];
    }
  if (least == INFINITY) return std::nullopt;
  if (std::fabs(found.multiplier.imag()) < 1e-3) return found;
  const auto right = eigenvector_near(monodromy, found.multiplier),
             left = eigenvector_near(monodromy.transpose(), found.multiplier);
  if (!right || !left) return std::nullopt;
  const std::complex<double> product = (left->transpose() * *right)(0);
  found.weights = CycleWeights{VectorXcd(*left * (2.0 * std::conj(found.multiplier) / product)), *right};
  return found;
}

std::optional<CycleTest::Value> CycleTest::at(const CycleArcs& arcs) const {
  if (change_ == CycleChange::torus) return torus(arcs);
  const MatrixXd a = matrix(arcs);
  const Index n = arcs.slopes.front().rows();
  const Bordered b = bordered(a, row_, column_);
  Value found;
  found.value = b.value;
  if (!std::isfinite(b.value)) return std::nullopt;
  found.right = b.right.normalized();
  found.left = b.left.normalized();
  found.weights = CycleWeights{-b.left.head(n), b.right.head(n), change_ == CycleChange::fold ? b.right[n] : 0.0};
  return found;
}

}  // namespace equipoise
