// Arcs, their mismatch, and derivatives; those of slopes by differences along one direction, as second derivatives are
// symmetric. Test functions: bordered matrices, and a pair of multipliers.
#include "equipoise/extras/cycles/cycle_shooting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/bordered.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/extras/stability/balance_at.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"

namespace equipoise {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

namespace {

// In units of a state's scale: an error of its square next to that of the integrations over it.
constexpr double arc_difference = 1e-5;
constexpr double natural_cycle = 10.0;  // of all nodes together; steps are then limited by the plane

}  // namespace

MatrixXd CycleArcs::monodromy() const {
  MatrixXd all = slopes.front();
  for (std::size_t k = 1; k < slopes.size(); ++k) all = slopes[k] * all;
  return all;
}

int CycleShooting::nodes_for(double period) {
  constexpr double arc = 6.0, fewest = 6.0, most = 16.0;
  return static_cast<int>(std::clamp(std::ceil(period / arc), fewest, most));
}

CycleShooting::CycleShooting(const model::System& like, const CycleShape& first, double tolerance)
    : size_(like.dimension()),
      count_(static_cast<Index>(first.nodes.size())),
      unit_(like.scale()),
      turned_(first.turned.size() > 0 ? first.turned : VectorXd(VectorXd::Zero(size_))),
      tolerance_(tolerance),
      node_weight_(natural_cycle * std::sqrt(static_cast<double>(first.nodes.size()))),
      period_weight_(natural_cycle * first.period) {}

VectorXd CycleShooting::packed(const CycleShape& shape) const {
  VectorXd all(unknowns());
  all[0] = shape.period / period_weight_;
  for (Index k = 0; k < count_; ++k)
    all.segment(1 + size_ * k, size_) = shape.nodes[static_cast<std::size_t>(k)].cwiseQuotient(unit_) / node_weight_;
  return all;
}

CycleShape CycleShooting::shape(const Eigen::Ref<const VectorXd>& packed) const {
  CycleShape result{packed[0] * period_weight_, {}, turned_};
  for (Index k = 0; k < count_; ++k)
    result.nodes.emplace_back(node_weight_ * packed.segment(1 + size_ * k, size_).cwiseProduct(unit_));
  return result;
}

void CycleShooting::stay_near(const model::System& system, const CycleShape& shape) {
  reference_ = shape;
  phase_.clear();
  double size = 0.0;
  for (const VectorXd& z : shape.nodes) {
    phase_.emplace_back(model::rate(system, z).cwiseQuotient(unit_));
    size = std::max(size, phase_.back().norm());
  }
  for (VectorXd& rate : phase_) rate /= size;
}

std::optional<CycleArcs> CycleShooting::arcs(const model::System& system, const CycleShape& shape) const {
  if (!(shape.period > 0.0)) return std::nullopt;
  CycleArcs result{follow_arcs(system, shape.nodes, arc_time(shape), tolerance_), {}, {}};
  if (result.flights.empty()) return std::nullopt;
  for (const TangentFlight& flight : result.flights) {
    result.slopes.push_back(in_units(flight.tangents, unit_));
    result.rates.emplace_back(model::rate(system, flight.end).cwiseQuotient(unit_));
  }
  return result;
}

VectorXd CycleShooting::equations(const CycleShape& shape, const CycleArcs& arcs) const {
  VectorXd value(unknowns());
  double phase = 0.0;
  for (Index k = 0; k < count_; ++k) {
    const auto here = static_cast<std::size_t>(k), next = static_cast<std::size_t>((k + 1) % count_);
    value.segment(size_ * k, size_) = (arcs.flights[here].end - shape.nodes[next]).cwiseQuotient(unit_);
    if (next == 0) value.segment(size_ * k, size_) -= turned_.cwiseQuotient(unit_);
    phase += phase_[here].dot((shape.nodes[here] - reference_.nodes[here]).cwiseQuotient(unit_));
  }
  value[size_ * count_] = phase;
  return value;
}

MatrixXd CycleShooting::slopes(const CycleArcs& arcs) const {
  MatrixXd m = MatrixXd::Zero(unknowns(), unknowns());
  for (Index k = 0; k < count_; ++k) {
    const Index row = size_ * k, column = 1 + size_ * k, next = 1 + size_ * ((k + 1) % count_);
    const auto here = static_cast<std::size_t>(k);
    m.block(row, column, size_, size_) = node_weight_ * arcs.slopes[here];
    m.block(row, next, size_, size_).diagonal().array() -= node_weight_;
    m.block(row, 0, size_, 1) = arcs.rates[here] * (period_weight_ / static_cast<double>(count_));
    m.block(size_ * count_, column, 1, size_) = node_weight_ * phase_[here].transpose();
  }
  return m;
}

CycleShooting::Carried CycleShooting::carried(const CycleArcs& arcs, const CycleWeights& weights) const {
  Carried result;
  result.right.push_back(weights.right);
  for (std::size_t k = 0; k + 1 < arcs.slopes.size(); ++k)
    result.right.emplace_back(arcs.slopes[k].cast<std::complex<double>>() * result.right.back());
  result.left.assign(arcs.slopes.size(), weights.left);
  for (std::size_t k = arcs.slopes.size() - 1; k > 0; --k)
    result.left[k - 1] = arcs.slopes[k].transpose().cast<std::complex<double>>() * result.left[k];
  return result;
}

std::optional<CycleShooting::Change> CycleShooting::by_parameter(const model::System& below, const model::System& above,
                                                                 double difference, const CycleShape& shape,
                                                                 const CycleArcs& arcs,
                                                                 const CycleWeights* weights) const {
  Change change{VectorXd::Zero(unknowns()), 0.0};
  if (!weights) {
    for (Index k = 0; k < count_; ++k) {
      const VectorXd& node = shape.nodes[static_cast<std::size_t>(k)];
      const auto low = advance_state(below, node, arc_time(shape), 0.0, tolerance_),
                 high = advance_state(above, node, arc_time(shape), 0.0, tolerance_);
      if (!low || !high) return std::nullopt;
      change.equations.segment(size_ * k, size_) = (*high - *low).cwiseQuotient(unit_) / difference;
    }
    return change;
  }
  const Carried vectors = carried(arcs, *weights);
  for (Index k = 0; k < count_; ++k) {
    const auto here = static_cast<std::size_t>(k);
    MatrixXd start(size_, 2);
    start << unit_.cwiseProduct(vectors.right[here].real()), unit_.cwiseProduct(vectors.right[here].imag());
    const auto low = follow_tangents(below, shape.nodes[here], start, arc_time(shape), tolerance_),
               high = follow_tangents(above, shape.nodes[here], start, arc_time(shape), tolerance_);
    if (!low || !high) return std::nullopt;
    change.equations.segment(size_ * k, size_) = (high->end - low->end).cwiseQuotient(unit_) / difference;
    const MatrixXd bend = unit_.cwiseInverse().asDiagonal() * (high->tangents - low->tangents) / difference;
    change.test += vectors.left[here].real().dot(bend.col(0)) - vectors.left[here].imag().dot(bend.col(1));
    if (k + 1 == count_)
      change.test += weights->of_rate(weights->left)
                         .dot((model::rate(above, high->end) - model::rate(below, low->end)).cwiseQuotient(unit_)) /
                     difference;
  }
  return change;
}

// d(slopes of an arc)/d(its node) along a direction in units.
std::optional<MatrixXd> CycleShooting::bent(const model::System& system, const CycleShape& shape, Index arc,
                                            const VectorXd& along) const {
  const double length = along.norm();
  if (!(length > 0.0)) return MatrixXd(MatrixXd::Zero(size_, size_));
  const VectorXd step = (arc_difference / length) * along.cwiseProduct(unit_);
  const VectorXd& node = shape.nodes[static_cast<std::size_t>(arc)];
  const auto low = follow_derivative(system, node - step, arc_time(shape), tolerance_),
             high = follow_derivative(system, node + step, arc_time(shape), tolerance_);
  if (!low || !high) return std::nullopt;
  return MatrixXd(unit_.cwiseInverse().asDiagonal() * (high->tangents - low->tangents) * unit_.asDiagonal() *
                  (0.5 * length / arc_difference));
}

std::optional<RowVectorXd> CycleShooting::test_slopes(const model::System& system, const CycleShape& shape,
                                                      const CycleArcs& arcs, const CycleWeights& weights) const {
  const Carried vectors = carried(arcs, weights);
  RowVectorXd result = RowVectorXd::Zero(unknowns());
  for (Index k = 0; k < count_; ++k) {
    const auto here = static_cast<std::size_t>(k);
    const VectorXcd &left = vectors.left[here], &right = vectors.right[here];
    const auto real = bent(system, shape, k, right.real()), imaginary = bent(system, shape, k, right.imag());
    if (!real || !imaginary) return std::nullopt;
    RowVectorXd slope = left.real().transpose() * *real - left.imag().transpose() * *imaginary;
    const MatrixXd jacobian = in_units(model::jacobian(system, arcs.flights[here].end), unit_);
    const double by_time = period_weight_ / static_cast<double>(count_);
    const VectorXcd end = arcs.slopes[here].cast<std::complex<double>>() * right;
    result[0] += by_time * (left.real().dot(jacobian * end.real()) - left.imag().dot(jacobian * end.imag()));
    if (k + 1 == count_ && weights.shift != std::complex<double>(0.0)) {
      const RowVectorXd pull = weights.of_rate(left).transpose() * jacobian;
      slope += pull * arcs.slopes[here];
      result[0] += by_time * pull.dot(arcs.rates[here]);
    }
    result.segment(1 + size_ * k, size_) = node_weight_ * slope;
  }
  return result;
}

double CycleShooting::along(const RowVectorXd& test_slopes, const CycleArcs& arcs, VectorXd change,
                            double longer) const {
  double sum = test_slopes[0] * longer / period_weight_;
  for (Index k = 0; k < count_; ++k) {
    const auto here = static_cast<std::size_t>(k);
    sum += test_slopes.segment(1 + size_ * k, size_).dot(change) / node_weight_;
    change = arcs.slopes[here] * change + arcs.rates[here] * (longer / static_cast<double>(count_));
  }
  return sum;
}

VectorXcd CycleShooting::multipliers(const model::System& system, const CycleShape& shape,
                                     const CycleArcs& arcs) const {
  return floquet_multipliers(system, shape.nodes, arcs.flights).tail(size_ - 1);
}

double longest_period(const model::System& system, const CycleShape& shape, double at_birth) {
  const double turn = two_pi / std::max(1.0, std::fabs(system.speed(shape.nodes.front())));
  return std::max(longest_turns * turn, longest_growth * at_birth);
}

double cycle_swing(const model::System& system, const CycleShape& shape) {
  constexpr int parts = 8;  // of an arc: 48 a cycle at least, so that a sine's peak is missed by 0.2 %
  const int balls = system.balls();
  VectorXd low = VectorXd::Constant(balls, INFINITY), high = -low;
  const double step = shape.period / static_cast<double>(shape.nodes.size()) / parts;
  for (VectorXd z : shape.nodes)
    for (int part = 0; part < parts; ++part) {
      for (int i = 0; i < balls; ++i) {
        low[i] = std::min(low[i], z[model::index::phi(i)]);
        high[i] = std::max(high[i], z[model::index::phi(i)]);
      }
      const auto next = advance_state(system, z, step, 0.0, 1e-8);
      if (!next) return NAN;
      z = *next;
    }
  return 0.5 * (high - low).maxCoeff();
}

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
  return fit_borders(matrix(arcs), 4, row_, column_);
}

std::optional<CycleTest::Value> CycleTest::torus(const CycleArcs& arcs) const {
  // Wielandt's deflation: the shift's multiplier becomes 0, all others stay.
  const VectorXd &rate = arcs.rates.back(), share = phase_ / phase_.dot(rate);
  const MatrixXd monodromy = arcs.monodromy() - rate * share.transpose();
  const VectorXcd values = dense::eigenvalues(monodromy);
  const auto near = nearest_pair({values.begin(), values.end()}, {cosine_, 1.0, {}});
  if (!near) return std::nullopt;
  Value found;
  found.value = near->product - 1.0;
  found.cosine = near->mean;
  const std::array pair{values[static_cast<Index>(near->places[1])], values[static_cast<Index>(near->places[0])]};
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
