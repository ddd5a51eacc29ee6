// Floquet theory for deviations across the motion. At every state of the orbit an orthonormal basis spans the
// directions perpendicular to dz/dt; the arcs' derivatives act between these bases. The shift in time is left out and
// carried along unchanged. So the product of the reduced matrices has all other multipliers, and left Floquet vectors
// made from it vanish on dz/dt exactly.
#include "equipoise/attractors/periodic_orbits/orbit.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>

#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"

namespace equipoise {

namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Columns: an orthonormal basis perpendicular to `direction`, from the reflection that maps it to an axis.
MatrixXd basis_across(const VectorXd& direction) {
  VectorXd normal = direction.normalized();
  normal[0] += normal[0] < 0.0 ? -1.0 : 1.0;
  const Index size = direction.size();
  const MatrixXd reflection =
      MatrixXd::Identity(size, size) - (2.0 / normal.squaredNorm()) * normal * normal.transpose();
  return reflection.rightCols(size - 1);
}

std::vector<MatrixXd> bases_across(const model::System& system, const std::vector<VectorXd>& states) {
  std::vector<MatrixXd> bases;
  for (const VectorXd& z : states) bases.push_back(basis_across(model::rate(system, z)));
  return bases;
}

// Arcs' derivatives between the bases.
std::vector<MatrixXd> arcs_across(const std::vector<MatrixXd>& bases, const std::vector<TangentFlight>& arcs) {
  std::vector<MatrixXd> result;
  for (std::size_t k = 0; k < arcs.size(); ++k)
    result.push_back(bases[(k + 1) % bases.size()].transpose() * arcs[k].tangents * bases[k]);
  return result;
}

MatrixXd product(const std::vector<MatrixXd>& arcs) {
  MatrixXd all = arcs.front();
  for (std::size_t k = 1; k < arcs.size(); ++k) all = arcs[k] * all;
  return all;
}

// Positions of `values` by falling modulus, pairs with the positive imaginary part first.
std::vector<Index> falling(const Eigen::VectorXcd& values) {
  std::vector<Index> order(values.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    const double x = std::abs(values[a]), y = std::abs(values[b]);
    return x != y ? x > y : values[a].imag() > values[b].imag();
  });
  return order;
}

}  // namespace

Eigen::VectorXcd floquet_multipliers(const model::System& system, const std::vector<VectorXd>& nodes,
                                     const std::vector<TangentFlight>& arcs) {
  const VectorXd rate = model::rate(system, nodes.front());
  const Eigen::VectorXcd across = dense::eigenvalues(product(arcs_across(bases_across(system, nodes), arcs)));
  Eigen::VectorXcd result(rate.size());
  result[0] = rate.dot(monodromy(arcs) * rate) / rate.squaredNorm();
  Index k = 1;
  for (const Index i : falling(across)) result[k++] = across[i];
  return result;
}

Eigen::VectorXcd floquet_multipliers(const std::vector<TangentFlight>& arcs) {
  const Eigen::VectorXcd values = dense::eigenvalues(monodromy(arcs));
  return values(falling(values));
}

std::optional<FloquetFrame> floquet_frame(const model::System& system, const PeriodicOrbit& orbit, int count) {
  // Vectors are carried backward, where slow modes grow into fast ones. Double precision must leave something of the
  // fastest.
  constexpr double widest_span = 1e-9, worst_condition = 1e9;
  constexpr double tolerance = 1e-12;
  if (count < 1) return std::nullopt;
  FloquetFrame frame;
  frame.states = sample_orbit(system, orbit, count);
  if (frame.states.empty()) return std::nullopt;
  const std::vector<TangentFlight> arcs = follow_arcs(system, frame.states, orbit.period / count, tolerance);
  if (arcs.empty()) return std::nullopt;
  const auto bases = bases_across(system, frame.states);
  const auto across = arcs_across(bases, arcs);

  const dense::EigenPairs pairs = dense::eigenpairs(product(across).transpose());
  if (!pairs.found) return std::nullopt;
  const Eigen::VectorXcd& multipliers = pairs.values;
  const auto order = falling(multipliers);
  const double largest = std::max(1.0, std::abs(multipliers[order.front()]));
  if (!(std::abs(multipliers[order.back()]) > widest_span * largest)) return std::nullopt;
  const Index size = multipliers.size();
  MatrixXcd vectors(size, size);
  frame.rates.resize(size);
  for (Index k = 0; k < size; ++k) {
    vectors.col(k) = pairs.vectors.col(order[k]).normalized();
    frame.rates[k] = std::log(std::abs(multipliers[order[k]])) / orbit.period;
  }
  if (!(vectors.norm() * dense::inverse(vectors).norm() < worst_condition)) return std::nullopt;

  // w(t_j) = A_j^T w(t_{j+1}) would keep w . d; the factor makes its modulus periodic.
  const Eigen::ArrayXd factor = (-frame.rates.array() * (orbit.period / count)).exp();
  frame.left.resize(count);
  MatrixXcd carried = vectors;
  for (int j = count - 1; j >= 0; --j) {
    carried = (across[j].transpose() * carried) * factor.matrix().asDiagonal();
    frame.left[j] = bases[j] * carried;
  }
  VectorXd squares = VectorXd::Zero(size);
  for (const MatrixXcd& left : frame.left) squares += left.colwise().squaredNorm().transpose() / count;
  const VectorXd scale = squares.cwiseSqrt().cwiseInverse();
  for (MatrixXcd& left : frame.left) left = left * scale.asDiagonal();
  return frame;
}

}  // namespace equipoise
