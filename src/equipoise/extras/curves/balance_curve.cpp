// Equations of the curves of balance, and where they end with it.
#include "equipoise/extras/curves/followed_curve.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/core/math/dense.hpp"

namespace equipoise {

using Eigen::VectorXd;

namespace {

VectorXd one_equation(double value) { return VectorXd::Constant(1, value); }

// The real eigenvalue nearest to 0.
std::optional<double> real_rate(const std::vector<std::complex<double>>& rates) {
  std::optional<double> nearest;
  for (const auto& rate : rates)
    if (rate.imag() == 0.0 && (!nearest || std::fabs(rate.real()) < std::fabs(*nearest))) nearest = rate.real();
  return nearest;
}

}  // namespace

std::optional<VectorXd> BalanceCurve::equation(const VectorXd& at) const {
  if (kind_ == CurveKind::existence) {
    const auto margin = plane_.margin(at);
    return margin ? std::optional(one_equation(*margin)) : std::nullopt;
  }
  const auto spectrum = plane_.spectrum(at);
  if (!spectrum) return std::nullopt;
  if (kind_ == CurveKind::zero) {
    const auto rate = real_rate(spectrum->rates);
    return rate ? std::optional(one_equation(*rate)) : std::nullopt;
  }
  const auto pair = nearest_pair(spectrum->rates, like_);
  return pair ? std::optional(one_equation(pair->mean)) : std::nullopt;
}

std::optional<CurvePlace> BalanceCurve::described(const VectorXd& at) const {
  CurvePlace place = place_at(at);
  if (kind_ == CurveKind::existence) return place;
  const auto spectrum = plane_.spectrum(at);
  if (!spectrum) return std::nullopt;
  put_state(*spectrum, place.point);
  if (kind_ == CurveKind::zero) {
    place.point.frequency = 0.0;
    place.point.others = spectrum->unstable();
    return place;
  }
  const auto pair = nearest_pair(spectrum->rates, like_);
  if (!pair) return std::nullopt;
  place.pair = *pair;
  place.point.frequency = std::sqrt(std::max(0.0, pair->product));
  place.point.others = unstable_besides(spectrum->rates, *pair);
  place.point.lyapunov = first_lyapunov(*spectrum, place.point.frequency).value_or(NAN);
  return place;
}

// Margin and growth of the pair vanish together: Newton's method with the balls in line, where both are smooth.
std::optional<CurvePlace> BalanceCurve::at_balance_end(const CurvePlace& before) const {
  const auto value = [&](const VectorXd& at) -> std::optional<VectorXd> {
    const auto margin = plane_.margin(at);
    const auto spectrum = plane_.in_line(at);
    const auto pair = spectrum ? nearest_pair(spectrum->rates, {0.0, before.pair.product, {}}) : std::nullopt;
    if (!margin || !pair) return std::nullopt;
    return VectorXd(Eigen::Vector2d(*margin, pair->mean));
  };
  VectorXd at = before.at;
  for (int round = 0; round < 20; ++round) {
    const auto here = value(at);
    Eigen::MatrixXd slope(2, 2);
    for (Eigen::Index k = 0; k < 2; ++k) {
      constexpr double step = 1e-6;
      const auto up = value(at + step * VectorXd::Unit(2, k)), down = value(at - step * VectorXd::Unit(2, k));
      if (!here || !up || !down) return std::nullopt;
      slope.col(k) = (*up - *down) / (2.0 * step);
    }
    const VectorXd change = -dense::LinearSolver(slope).solve(*here);
    at += change;
    if (!((at - before.at).norm() < 1e-3)) return std::nullopt;
    if (change.norm() >= CurveFollower::precision) continue;
    const auto spectrum = plane_.in_line(at);
    const auto pair = nearest_pair(spectrum->rates, {0.0, before.pair.product, {}});
    CurvePlace place = before;
    place.at = at;
    place.pair = *pair;
    put_state(*spectrum, place.point);
    place.point.x = plane_.x(at);
    place.point.y = plane_.y(at);
    place.point.frequency = std::sqrt(std::max(0.0, pair->product));
    place.point.lyapunov = NAN;
    return place;
  }
  return std::nullopt;
}

CurveEnd BalanceCurve::reason_beyond(const CurveFollower::Step& last, double step) const {
  for (double reach = std::max(step, 1e-7); reach < 2e-3; reach *= 2.0)
    if (!plane_.spectrum(last.point + reach * last.tangent)) return CurveEnd::no_balance;
  return CurveEnd::lost;
}

void BalanceCurve::end_inside(const CurveFollower::Step& last, double step, const CurvePlace& before, Way& way) const {
  way.end = kind_ == CurveKind::existence ? CurveEnd::lost : reason_beyond(last, step);
  const auto end = way.end == CurveEnd::no_balance && kind_ == CurveKind::hopf ? at_balance_end(before) : std::nullopt;
  if (end) way.places.push_back(*end);
}

}  // namespace equipoise
