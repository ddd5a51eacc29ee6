// Equations of the curves, both ways from the first place, what ends them.
#include "equipoise/curves/balance_curve.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/curves/hopf_form.hpp"
#include "equipoise/math/dense.hpp"
#include "equipoise/results/explanation.hpp"

namespace equipoise {

using Eigen::VectorXd;

namespace {

constexpr std::size_t most_places = 20000;
constexpr double nearly_there = 1e-5;  // from an edge: ten of the differences by which slopes are taken

bool is_inside(const VectorXd& at) { return at.minCoeff() >= 0.0 && at.maxCoeff() <= 1.0; }

VectorXd one_equation(double value) { return VectorXd::Constant(1, value); }

// The real eigenvalue nearest to 0.
std::optional<double> real_rate(const std::vector<std::complex<double>>& rates) {
  std::optional<double> nearest;
  for (const auto& rate : rates)
    if (rate.imag() == 0.0 && (!nearest || std::fabs(rate.real()) < std::fabs(*nearest))) nearest = rate.real();
  return nearest;
}

int unstable_besides(const std::vector<std::complex<double>>& rates, const EigenPair& pair) {
  int count = 0;
  for (std::size_t k = 0; k < rates.size(); ++k)
    count += k != pair.places[0] && k != pair.places[1] && rates[k].real() > least_rate;
  return count;
}

}  // namespace

BalanceCurve::BalanceCurve(const BalancePlane& plane, CurveKind kind, const EigenPair& like)
    : plane_(plane), kind_(kind), like_(like), follower_([this](const VectorXd& at) { return equation(at); }) {}

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
  CurvePlace place{at, {}, {}};
  place.point.x = plane_.x(at);
  place.point.y = plane_.y(at);
  if (kind_ == CurveKind::existence) return place;
  const auto spectrum = plane_.spectrum(at);
  if (!spectrum) return std::nullopt;
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
  if (const auto form = hopf_form(*spectrum, place.point.frequency)) place.point.lyapunov = form->lyapunov;
  return place;
}

std::optional<CurvePlace> BalanceCurve::at_edge(const VectorXd& inside, const VectorXd& outside) const {
  double part = 1.0;
  Eigen::Index side = 0;
  for (Eigen::Index k = 0; k < 2; ++k)
    for (const double edge : {0.0, 1.0})
      if ((outside[k] - edge) * (inside[k] - edge) < 0.0) {
        const double here = (edge - inside[k]) / (outside[k] - inside[k]);
        if (here < part) part = here, side = k;
      }
  VectorXd guess = inside + part * (outside - inside);
  guess[side] = std::round(guess[side]);
  const auto at = follower_.at_plane(guess, VectorXd::Unit(2, side));
  return at ? described(*at) : std::nullopt;
}

std::optional<CurvePlace> BalanceCurve::between(const CurvePlace& a, const CurvePlace& b, double part) const {
  const VectorXd chord = b.at - a.at;
  like_ = {0.0, a.pair.product + part * (b.pair.product - a.pair.product), {}};
  const auto at = follower_.at_plane(a.at + part * chord, chord / chord.norm());
  return at ? described(*at) : std::nullopt;
}

// Where `changed` turns from false, at a, to true, at b.
template <class Changed>
std::optional<CurvePlace> BalanceCurve::located(const CurvePlace& a, const CurvePlace& b,
                                                const Changed& changed) const {
  double low = 0.0, high = 1.0;
  std::optional<CurvePlace> found;
  for (int k = 0; k < 44; ++k) {
    const double middle = 0.5 * (low + high);
    const auto place = between(a, b, middle);
    if (!place) return std::nullopt;
    (changed(*place) ? high : low) = middle;
    found = place;
  }
  return found;
}

std::optional<CurvePlace> BalanceCurve::at_vanishing_pair(const CurvePlace& before, const VectorXd& after) const {
  const auto beyond = described(after);
  if (!beyond || beyond->pair.product > 0.0) return std::nullopt;
  return located(before, *beyond, [](const CurvePlace& p) { return p.pair.product <= 0.0; });
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

BalanceCurve::Way BalanceCurve::way(const CurvePlace& from, const VectorXd& towards, const StopFlag* stop) {
  Way way;
  const auto first = follower_.tangent(from.at, towards);
  if (!first) return way;
  CurveFollower::Step here{from.at, *first};
  CurvePlace last = from;
  double step = 1e-3;
  like_ = {0.0, from.pair.product, {}};
  while (way.places.size() < most_places && !is_set(stop)) {
    const auto next = follower_.next(here, step);
    if (!next) {
      if (!is_inside(here.point + nearly_there * here.tangent)) {  // nothing is defined beyond the plane's edge
        way.end = CurveEnd::plane;
        return way;
      }
      way.end = kind_ == CurveKind::existence ? CurveEnd::lost : reason_beyond(here, step);
      const auto end =
          way.end == CurveEnd::no_balance && kind_ == CurveKind::hopf ? at_balance_end(last) : std::nullopt;
      if (end) way.places.push_back(*end);
      return way;
    }
    if (!is_inside(next->point)) {
      way.end = CurveEnd::plane;
      if (const auto edge = at_edge(here.point, next->point)) way.places.push_back(*edge);
      return way;
    }
    const auto place = described(next->point);
    if (!place) return way;
    if (kind_ == CurveKind::hopf && place->pair.product <= 0.0) {
      way.end = CurveEnd::no_pair;
      if (const auto end = at_vanishing_pair(last, next->point)) way.places.push_back(*end);
      return way;
    }
    way.places.push_back(*place);
    last = *place;
    like_ = {0.0, place->pair.product, {}};
    const VectorXd back = from.at - next->point;
    if (way.places.size() > 20 && back.norm() < 1.5 * step && back.dot(next->tangent) > 0.0) {
      way.places.push_back(from);
      way.end = CurveEnd::closed;
      return way;
    }
    here = *next;
  }
  return way;
}

bool BalanceCurve::follow(const VectorXd& guess, const StopFlag* stop) {
  const auto at = follower_.nearby(guess);
  if (!at || !is_inside(*at)) return false;
  const auto first = described(*at);
  if (!first) return false;
  const VectorXd towards = Eigen::Vector2d(0.8, 0.6);  // of straight curves few run across it
  const Way forwards = way(*first, towards, stop);
  places_ = {*first};
  places_.insert(places_.end(), forwards.places.begin(), forwards.places.end());
  ends_ = {forwards.end, forwards.end};
  if (forwards.end == CurveEnd::closed) return true;
  const Way backwards = way(*first, -towards, stop);
  places_.insert(places_.begin(), backwards.places.rbegin(), backwards.places.rend());
  ends_[0] = backwards.end;
  return places_.size() > 1;
}

std::vector<SpecialPoint> BalanceCurve::specials() const {
  std::vector<SpecialPoint> found;
  if (kind_ != CurveKind::hopf) return found;
  const auto add = [&](SpecialKind kind, const CurvePlace& p, double second) {
    found.push_back({kind, 0, p.point.x, p.point.y, p.point.frequency, second});
  };
  const auto add_end = [&](CurveEnd end, const CurvePlace& place) {
    if (end == CurveEnd::no_pair) add(SpecialKind::bogdanov_takens, place, 0.0);
    if (end != CurveEnd::no_balance || !std::isnan(place.point.lyapunov)) return;
    constexpr double rounding = 1e-4;  // of the square root of a double zero, which eigenvalues give to 1e-8
    add(place.point.frequency < rounding ? SpecialKind::bogdanov_takens : SpecialKind::zero_hopf, place, 0.0);
  };
  add_end(ends_[0], places_.front());
  for (std::size_t k = 1; k < places_.size(); ++k) {
    const CurvePlace &a = places_[k - 1], &b = places_[k];
    if (a.point.lyapunov * b.point.lyapunov < 0.0) {
      const auto changed = [&](const CurvePlace& p) { return p.point.lyapunov * a.point.lyapunov < 0.0; };
      const auto place = located(a, b, changed);
      const double size = std::max(std::fabs(a.point.lyapunov), std::fabs(b.point.lyapunov));
      // Through infinity, as at resonances with another swing, it changes sign without a zero.
      if (place && std::fabs(place->point.lyapunov) < 1e-3 * size) add(SpecialKind::generalised_hopf, *place, 0.0);
    }
    if (a.point.others != b.point.others && !std::isnan(a.point.lyapunov + b.point.lyapunov)) {
      const auto changed = [&](const CurvePlace& p) { return p.point.others != a.point.others; };
      const auto place = located(a, b, changed);
      const auto spectrum = place ? plane_.spectrum(place->at) : std::nullopt;
      if (!spectrum) continue;
      const std::complex<double>* nearest = nullptr;
      for (std::size_t i = 0; i < spectrum->rates.size(); ++i) {
        const auto& rate = spectrum->rates[i];
        if (i == place->pair.places[0] || i == place->pair.places[1]) continue;
        if (!nearest || std::fabs(rate.real()) < std::fabs(nearest->real())) nearest = &rate;
      }
      if (!nearest) continue;
      const bool swings = std::fabs(nearest->imag()) > 1e-6;
      add(swings ? SpecialKind::double_hopf : SpecialKind::zero_hopf, *place, std::fabs(nearest->imag()));
    }
  }
  add_end(ends_[1], places_.back());
  return found;
}

}  // namespace equipoise
