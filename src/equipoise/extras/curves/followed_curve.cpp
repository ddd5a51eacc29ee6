// Both ways from the first place, what ends them, and where a curve changes its kind. Equations of the curves of
// balance. The normal form of a Hopf curve.
#include "equipoise/extras/curves/followed_curve.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/core/math/bordered.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/results/commands/explanation.hpp"

namespace equipoise {

using Eigen::VectorXd;

namespace {

constexpr double nearly_there = 1e-5;  // from an edge: ten of the differences by which slopes are taken

bool is_inside(const VectorXd& at) { return at.head(2).minCoeff() >= 0.0 && at.head(2).maxCoeff() <= 1.0; }

// Numbers of the places of a kind of curve, and what a point is at which one of them is 0.
struct TestNumber {
  CurveKind kind;
  SpecialKind special;
  double (*value)(const CurvePlace&);
};
constexpr auto double_zero = [](const CurvePlace& p) { return p.double_zero; };
constexpr std::array<TestNumber, 7> test_numbers{{
    {CurveKind::hopf, SpecialKind::generalised_hopf, [](const CurvePlace& p) { return p.point.lyapunov; }},
    {CurveKind::fold, SpecialKind::bogdanov_takens, double_zero},
    {CurveKind::fold, SpecialKind::cusp, [](const CurvePlace& p) { return p.turn; }},
    {CurveKind::cycle_fold, SpecialKind::resonance_1_1, double_zero},
    {CurveKind::cycle_flip, SpecialKind::resonance_1_2, double_zero},
    {CurveKind::cycle_torus, SpecialKind::resonance_1_3, [](const CurvePlace& p) { return p.pair.mean + 0.5; }},
    {CurveKind::cycle_torus, SpecialKind::resonance_1_4, [](const CurvePlace& p) { return p.pair.mean; }},
}};

}  // namespace

int unstable_besides(const std::vector<std::complex<double>>& rates, const EigenPair& pair) {
  int count = 0;
  for (std::size_t k = 0; k < rates.size(); ++k)
    count += k != pair.places[0] && k != pair.places[1] && rates[k].real() > least_rate;
  return count;
}

FollowedCurve::FollowedCurve(const PlaneStudies& plane, CurveKind kind, const EigenPair& like,
                             const CurveFollower::Limits& limits, std::size_t most)
    : plane_(plane),
      kind_(kind),
      like_(like),
      follower_([this](const VectorXd& at) { return equation(at); }, [this](const VectorXd& at) { return slopes(at); },
                limits),
      most_(most) {}

void FollowedCurve::stay_near(const CurvePlace& place) const {
  like_ = {0.0, place.pair.product, {}};
  if (place.right.size() > 0) row_ = place.right, column_ = place.left;
}

std::optional<CurvePlace> FollowedCurve::at_edge(const VectorXd& inside, const VectorXd& outside) const {
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
  const auto at = follower_.at_plane(guess, VectorXd::Unit(guess.size(), side));
  return at ? described(*at) : std::nullopt;
}

std::optional<CurvePlace> FollowedCurve::between(const CurvePlace& a, const CurvePlace& b, double part) const {
  const VectorXd chord = b.at - a.at;
  stay_near(a);
  like_ = {0.0, a.pair.product + part * (b.pair.product - a.pair.product), {}};
  const auto at = follower_.at_plane(a.at + part * chord, chord / chord.norm());
  return at ? described(*at) : std::nullopt;
}

std::optional<CurvePlace> FollowedCurve::located(const CurvePlace& a, const CurvePlace& b,
                                                 const std::function<bool(const CurvePlace&)>& changed) const {
  double low = 0.0, high = 1.0;
  std::optional<CurvePlace> found;
  for (int k = 0; k < 44; ++k) {
    const double middle = 0.5 * (low + high);
    found = between(a, b, middle);
    if (!found) return std::nullopt;
    (changed(*found) ? high : low) = middle;
  }
  return found;
}

std::optional<CurvePlace> FollowedCurve::zero_of(const CurvePlace& a, const CurvePlace& b,
                                                 const PlaceNumber& value) const {
  const double first = value(a), size = std::max(std::fabs(first), std::fabs(value(b)));
  auto place = located(a, b, [&](const CurvePlace& p) { return value(p) * first < 0.0; });
  // Through infinity, as at resonances with another swing, it changes sign without a zero.
  if (place && !(std::fabs(value(*place)) < 1e-3 * size)) place.reset();
  return place;
}

void FollowedCurve::add_zeros(const CurvePlace& a, const CurvePlace& b, std::vector<SpecialPoint>& found) const {
  for (const TestNumber& test : test_numbers)
    if (test.kind == kind_ && test.value(a) * test.value(b) < 0.0)
      if (const auto place = zero_of(a, b, test.value)) found.push_back(special(test.special, *place));
}

std::optional<CurveEnd> FollowedCurve::end_at(const CurvePlace& before, const CurvePlace& place, Way& way) const {
  if (kind_ != CurveKind::hopf || place.pair.product > 0.0) return std::nullopt;
  const auto end = located(before, place, [](const CurvePlace& p) { return p.pair.product <= 0.0; });
  if (end) way.places.push_back(*end);
  return CurveEnd::no_pair;
}

FollowedCurve::Way FollowedCurve::way(const CurvePlace& from, const VectorXd& towards, const StopFlag* stop) {
  Way way;
  stay_near(from);
  const auto first = follower_.tangent(from.at, towards);
  if (!first) return way;
  CurveFollower::Step here{from.at, *first, 0.0, {}, {}};
  CurvePlace last = from;
  double step = 1e-3, farthest = 0.0;
  while (way.places.size() < most_ && !is_set(stop)) {
    const auto next = follower_.next(here, step);
    if (!next) {
      if (!is_inside(here.point + nearly_there * here.tangent))  // nothing is defined beyond the plane's edge
        way.end = CurveEnd::plane;
      else
        end_inside(here, step, last, way);
      return way;
    }
    if (!is_inside(next->point)) {
      way.end = CurveEnd::plane;
      if (const auto edge = at_edge(here.point, next->point)) way.places.push_back(*edge);
      return way;
    }
    const auto place = described(next->point);
    if (!place) {
      way.end = undescribed();
      return way;
    }
    if (constexpr double fine = 1e-5; too_far(last, *place) && next->length > fine) {
      step = 0.5 * next->length;
      continue;
    }
    if (const auto end = end_at(last, *place, way)) {
      way.end = *end;
      return way;
    }
    way.places.push_back(*place);
    last = *place;
    stay_near(last);
    const VectorXd back = from.at - next->point;
    farthest = std::max(farthest, back.norm());
    if (back.norm() < 1.5 * step && farthest > 6.0 * step && back.dot(next->tangent) > 0.0) {
      way.places.push_back(described(from.at).value_or(from));  // with eigenvectors as they have come round
      way.end = CurveEnd::closed;
      return way;
    }
    here = *next;
  }
  way.end = way.places.size() < most_ ? CurveEnd::stopped : CurveEnd::points;
  return way;
}

bool FollowedCurve::follow(const VectorXd& guess, const StopFlag* stop, const Known& known) {
  const auto at = follower_.nearby(guess);
  if (!at || !is_inside(*at)) return false;
  const auto first = described(*at);
  if (!first || (known && known(*first))) return false;
  VectorXd towards = VectorXd::Zero(guess.size());
  towards.head(2) << 0.8, 0.6;  // of straight curves few run across it
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

void FollowedCurve::add_crossing(const CurvePlace& a, const CurvePlace& b, std::vector<SpecialPoint>& found) const {
  if (a.point.others == b.point.others) return;
  const auto place = located(a, b, [&](const CurvePlace& p) { return p.point.others != a.point.others; });
  if (!place) return;
  const std::complex<double>* nearest = nullptr;
  for (std::size_t i = 0; i < place->point.rates.size(); ++i) {
    const auto& rate = place->point.rates[i];
    if (i == place->pair.places[0] || i == place->pair.places[1]) continue;
    if (!nearest || std::fabs(rate.real()) < std::fabs(nearest->real())) nearest = &rate;
  }
  if (!nearest) return;
  const double frequency = std::fabs(nearest->imag());
  const bool swings = frequency > 1e-6;
  if (kind_ == CurveKind::hopf) {
    found.push_back(special(swings ? SpecialKind::double_hopf : kind_at_zero(*place), *place, frequency));
  } else if (swings) {  // a second real eigenvalue is a zero of double_zero
    found.push_back(special(kind_ == CurveKind::fold ? SpecialKind::fold_hopf : SpecialKind::zero_hopf, *place));
    found.back().frequency = frequency;
  }
}

std::vector<SpecialPoint> FollowedCurve::specials() const {
  std::vector<SpecialPoint> found;
  if (kind_ == CurveKind::zero || kind_ == CurveKind::existence) return found;
  const auto add_end = [&](CurveEnd end, const CurvePlace& place) {
    if (end == CurveEnd::no_pair) found.push_back(special(SpecialKind::bogdanov_takens, place));
    if (end != CurveEnd::no_balance || !std::isnan(place.point.lyapunov)) return;
    constexpr double rounding = 1e-4;  // of the square root of a double zero, which eigenvalues give to 1e-8
    found.push_back(
        special(place.point.frequency < rounding ? SpecialKind::bogdanov_takens : SpecialKind::zero_hopf, place));
  };
  add_end(ends_[0], places_.front());
  for (std::size_t k = 1; k < places_.size(); ++k) {
    const CurvePlace &a = places_[k - 1], &b = places_[k];
    add_zeros(a, b, found);
    if (kind_ != CurveKind::hopf || !std::isnan(a.point.lyapunov + b.point.lyapunov)) add_crossing(a, b, found);
  }
  add_end(ends_[1], places_.back());
  return found;
}

bool FollowedCurve::put_pair(const BalanceSpectrum& at, CurvePlace& place) const {
  const auto pair = nearest_pair(at.rates, like_);
  if (!pair) return false;
  place.pair = *pair;
  place.point.frequency = std::sqrt(std::max(0.0, pair->product));
  place.point.others = unstable_besides(at.rates, *pair);
  place.point.lyapunov = first_lyapunov(at, place.point.frequency).value_or(NAN);
  return true;
}

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
  return put_pair(*spectrum, place) ? std::optional(place) : std::nullopt;
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

namespace {

using Eigen::VectorXcd;
using Complex = std::complex<double>;

constexpr Complex i_unit(0.0, 1.0);

// Derivatives of the equations at a state.
VectorXcd second_along(const BalanceSpectrum& at, const VectorXcd& u, const VectorXcd& v) {
  const VectorXd ur = u.real(), ui = u.imag(), vr = v.real(), vi = v.imag();
  const auto real = [&](const VectorXd& a, const VectorXd& b) {
    return model::second_derivative(at.system, at.state, a, b);
  };
  return (real(ur, vr) - real(ui, vi)).cast<Complex>() + i_unit * (real(ur, vi) + real(ui, vr)).cast<Complex>();
}
// Along q, q and the conjugate of q.
VectorXcd third_along(const BalanceSpectrum& at, const VectorXcd& q) {
  const VectorXd a = q.real(), b = q.imag();
  const auto real = [&](const VectorXd& u, const VectorXd& v, const VectorXd& w) {
    return model::third_derivative(at.system, at.state, u, v, w);
  };
  return (real(a, a, a) + real(a, b, b)).cast<Complex>() + i_unit * (real(a, a, b) + real(b, b, b)).cast<Complex>();
}

}  // namespace

std::optional<double> first_lyapunov(const BalanceSpectrum& at, double frequency) {
  const bool has_derivatives = at.system.plain() || (at.system.tilts() && at.system.prescribed());
  if (at.family || !has_derivatives || !(frequency > 0.0)) return std::nullopt;
  const Eigen::MatrixXd& a = at.jacobian;
  auto q = eigenvector_near(a, Complex(0.0, frequency));
  auto p = eigenvector_near(a.transpose(), Complex(0.0, frequency));  // p^T a = i frequency p^T
  if (!q || !p) return std::nullopt;
  double swing = 0.0;
  for (int k = 0; k < at.system.balls(); ++k) swing = std::max(swing, 2.0 * std::abs((*q)[model::index::phi(k)]));
  if (!(swing > 0.0)) return std::nullopt;
  *q /= swing;  // then the state is w q + its conjugate with |w| the amplitude of the ball that swings most
  const Complex product = (p->transpose() * *q)(0);
  if (!(std::abs(product) > 1e-12 * p->norm() * q->norm())) return std::nullopt;
  *p /= product;
  if (dense::LinearSolver(a).inverse_condition() < 1e-14) return std::nullopt;
  const VectorXcd across = q->conjugate();
  const VectorXcd shift = dense::inverse(a).cast<Complex>() * second_along(at, *q, across);
  Eigen::MatrixXcd twice = -a.cast<Complex>();
  twice.diagonal().array() += Complex(0.0, 2.0 * frequency);
  const VectorXcd overtone = dense::inverse(twice) * second_along(at, *q, *q);
  const VectorXcd cubic = third_along(at, *q) - 2.0 * second_along(at, *q, shift) + second_along(at, across, overtone);
  return 0.5 * (p->transpose() * cubic)(0).real();
}

}  // namespace equipoise
