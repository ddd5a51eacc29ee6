// Test functions with their derivatives.
#include "equipoise/extras/curves/locked_states.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/core/math/bordered.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/results/commands/explanation.hpp"

namespace equipoise {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr double difference = 1e-6;    // in the unit square, and of scaled states
constexpr double natural_size = 10.0;  // of a state's scale; then steps are limited by the plane, not by the state

}  // namespace

VectorXd LockedCurve::state(const VectorXd& at) const {
  return symmetry_.whole(natural_size * symmetry_.scale().cwiseProduct(at.tail(symmetry_.size())));
}

std::optional<double> LockedCurve::test(const MatrixXd& jacobian) const {
  if (kind_ == CurveKind::fold) return bordered(symmetry_.reduced(jacobian), row_, column_).value;
  if (kind_ == CurveKind::pitchfork) {
    const auto& parting = symmetry_.partings().front();
    return jacobian.row(symmetry_.parting_place(parting)).dot(symmetry_.parting_direction(parting));
  }
  const auto pair = nearest_pair(symmetry_.rates(jacobian), like_);
  return pair ? std::optional(pair->mean) : std::nullopt;
}

std::optional<LockedCurve::Weights> LockedCurve::weights(const MatrixXd& jacobian) const {
  const Index n = jacobian.rows();
  const auto whole_right = [&](const VectorXcd& small) {
    return VectorXcd(symmetry_.whole(small.real()) + std::complex<double>(0.0, 1.0) * symmetry_.whole(small.imag()));
  };
  if (kind_ == CurveKind::pitchfork) {
    const auto& parting = symmetry_.partings().front();
    return Weights{symmetry_.parting_direction(parting), VectorXd::Unit(n, symmetry_.parting_place(parting))};
  }
  const MatrixXd small = symmetry_.reduced(jacobian);
  if (kind_ == CurveKind::fold) {
    const Bordered b = bordered(small, row_, column_);
    return Weights{whole_right(b.right), symmetry_.whole_left(-b.left)};
  }
  const auto rates = symmetry_.rates(jacobian);
  const auto pair = nearest_pair(rates, like_);
  // Where the two are real or nearly meet, their mean has a slope and each of them has none.
  if (!pair || !(pair->product - pair->mean * pair->mean > 1e-6)) return std::nullopt;
  const std::complex<double> value(pair->mean, std::sqrt(pair->product - pair->mean * pair->mean));
  const auto right = eigenvector_near(small, value), left = eigenvector_near(small.transpose(), value);
  if (!right || !left) return std::nullopt;
  return Weights{whole_right(*right), symmetry_.whole_left(*left / (left->transpose() * *right)(0))};
}

double LockedCurve::bend(const model::System& system, const VectorXd& z, const Weights& w,
                         const VectorXd& along) const {
  if (!system.plain())
    return w.of(model::jacobian(system, z + difference * along) - model::jacobian(system, z - difference * along)) /
           (2.0 * difference);
  const VectorXd real = w.right.real(), imaginary = w.right.imag();
  double change = w.left.real().dot(model::second_derivative(system, z, along, real));
  if (!imaginary.isZero(0.0)) change -= w.left.imag().dot(model::second_derivative(system, z, along, imaginary));
  return change;
}

std::optional<VectorXd> LockedCurve::equation(const VectorXd& at) const {
  const auto system = plane_.system(at);
  if (!system) return std::nullopt;
  const VectorXd z = state(at);
  const auto last = test(model::jacobian(*system, z));
  if (!last) return std::nullopt;
  VectorXd value(symmetry_.size() + 1);
  value << symmetry_.reduced(model::rate(*system, z)), *last;
  return value;
}

std::optional<MatrixXd> LockedCurve::slopes(const VectorXd& at) const {
  const auto system = plane_.system(at);
  if (!system) return std::nullopt;
  const VectorXd z = state(at), unit = natural_size * symmetry_.scale();
  const MatrixXd jacobian = model::jacobian(*system, z);
  const auto w = weights(jacobian);
  if (!w) return follower_.differences(at);
  const Index n = symmetry_.size();
  MatrixXd slope(n + 1, n + 2);
  slope.topRightCorner(n, n) = symmetry_.reduced(jacobian) * unit.asDiagonal();
  for (Index k = 0; k < n; ++k) slope(n, k + 2) = bend(*system, z, *w, unit[k] * symmetry_.direction(k));
  for (Index k = 0; k < 2; ++k) {
    const VectorXd step = difference * VectorXd::Unit(at.size(), k);
    const auto above = plane_.system(at + step), below = plane_.system(at - step);
    if (!above || !below) return std::nullopt;
    slope.col(k).head(n) =
        symmetry_.reduced(VectorXd(model::rate(*above, z) - model::rate(*below, z))) / (2.0 * difference);
    slope(n, k) = w->of(model::jacobian(*above, z) - model::jacobian(*below, z)) / (2.0 * difference);
  }
  return slope;
}

std::optional<CurvePlace> LockedCurve::described(const VectorXd& at) const {
  const auto system = plane_.system(at);
  if (!system) return std::nullopt;
  const BalanceSpectrum here = locked_spectrum(*system, symmetry_, state(at));
  CurvePlace place = place_at(at);
  put_state(here, place.point);
  if (kind_ == CurveKind::hopf) return put_pair(here, place) ? std::optional(place) : std::nullopt;
  place.point.frequency = 0.0;
  const auto smaller = [](const auto& a, const auto& b) { return std::abs(a) < std::abs(b); };
  const auto zero =
      static_cast<std::size_t>(std::min_element(here.rates.begin(), here.rates.end(), smaller) - here.rates.begin());
  place.pair.places = {zero, zero};
  place.point.others = unstable_besides(here.rates, place.pair);
  if (kind_ != CurveKind::fold) return place;
  const Bordered b = bordered(symmetry_.reduced(here.jacobian), row_, column_);
  place.right = b.right / b.right.norm();
  place.left = b.left / b.left.norm();
  place.double_zero = place.left.dot(place.right);
  place.turn = bend(here.system, here.state, {symmetry_.whole(place.right), symmetry_.whole_left(place.left)},
                    symmetry_.whole(place.right));
  return place;
}

SpecialKind LockedCurve::kind_at_zero(const CurvePlace& place) const {
  const VectorXd z = state(place.at);
  const bool centred = z.head(2).norm() < 1e-6 * symmetry_.scale()[0];  // alike balls part there
  return centred ? SpecialKind::zero_hopf : SpecialKind::fold_hopf;
}

bool LockedCurve::follow_from(const VectorXd& at, const VectorXd& z, const StopFlag* stop, const Known& known) {
  VectorXd guess(2 + symmetry_.size());
  guess << at, symmetry_.reduced(z).cwiseQuotient(natural_size * symmetry_.scale());
  if (kind_ == CurveKind::fold) {
    const auto system = plane_.system(at);
    if (!system) return false;
    const MatrixXd small = symmetry_.reduced(model::jacobian(*system, z));
    if (!fit_borders(small, 3, row_, column_)) return false;
  }
  return follow(guess, stop, known);
}

}  // namespace equipoise
