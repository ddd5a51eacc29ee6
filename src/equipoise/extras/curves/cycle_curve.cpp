// Equations with derivatives, ends, special points of curves of cycles.
#include "equipoise/extras/curves/cycle_curve.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/core/base/angles.hpp"

namespace equipoise {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

namespace {

constexpr double curve_tolerance = 1e-12;  // of a step of the integrations
// What a thousand such steps leave, magnified by multipliers.
constexpr CurveFollower::Limits cycle_limits{CurveFollower::longest_step, 1e-9, 0.08, 0.2, true};
constexpr double cycle_difference = 1e-6;  // in the unit square
constexpr double smallest_swing = 0.005;   // radians; a smaller cycle is taken to shrink to a state at rest

// The multipliers that a curve is about: nearest to 1, -1, or the pair.
std::vector<Index> own_multipliers(const VectorXcd& all, CurveKind change, const EigenPair& pair) {
  Index first = 0;
  if (change != CurveKind::cycle_torus) {
    (all.array() - (change == CurveKind::cycle_fold ? 1.0 : -1.0)).abs().minCoeff(&first);
    return {first};
  }
  const double beside = pair.product - pair.mean * pair.mean;
  const std::complex<double> value(pair.mean, std::sqrt(std::max(0.0, beside)));
  (all.array() - value).abs().minCoeff(&first);
  Index second = first == 0 ? 1 : 0;
  for (Index k = 0; k < all.size(); ++k)
    if (k != first && std::abs(all[k] - std::conj(value)) < std::abs(all[second] - std::conj(value))) second = k;
  return {first, second};
}

}  // namespace

CycleCurve::CycleCurve(const PlaneStudies& plane, const model::System& system, const CycleCrossing& crossing)
    : FollowedCurve(plane, crossing.change, {crossing.cosine, 1.0, {}}, cycle_limits, most_cycle_points),
      birth_period_(crossing.birth_period),
      shooting_(system, crossing.near.shape, curve_tolerance),
      test_(crossing.change, crossing.cosine) {}

bool CycleCurve::follow_from(const CycleCrossing& crossing, const StopFlag* stop, const Known& known) {
  const auto system = plane_.system(crossing.near.at);
  const auto arcs = system ? shooting_.arcs(*system, crossing.near.shape) : std::nullopt;
  if (!arcs) return false;
  shooting_.stay_near(*system, crossing.near.shape);
  if (!test_.begin(*arcs, shooting_.phase())) return false;
  VectorXd guess(2 + shooting_.unknowns());
  guess << crossing.near.at, shooting_.packed(crossing.near.shape);
  return follow(guess, stop, known);
}

bool CycleCurve::look_at(const VectorXd& at) const {
  if (seen_.at.size() == at.size() && seen_.at == at) return seen_.value.has_value();
  seen_ = {at, plane_.system(at), shape(at), {}, {}, {}};
  if (seen_.system) seen_.arcs = shooting_.arcs(*seen_.system, seen_.shape);
  if (seen_.arcs) seen_.value = test_.at(*seen_.arcs);
  return seen_.value.has_value();
}

bool CycleCurve::look_closer() const {
  if (!seen_.test_slopes)
    seen_.test_slopes = shooting_.test_slopes(*seen_.system, seen_.shape, *seen_.arcs, seen_.value->weights);
  return seen_.test_slopes.has_value();
}

std::optional<VectorXd> CycleCurve::equation(const VectorXd& at) const {
  if (!look_at(at)) return std::nullopt;
  VectorXd value(shooting_.unknowns() + 1);
  value << shooting_.equations(seen_.shape, *seen_.arcs), seen_.value->value;
  return value;
}

std::optional<MatrixXd> CycleCurve::slopes(const VectorXd& at) const {
  if (!look_at(at)) return std::nullopt;
  if (!look_closer()) return std::nullopt;
  const Index n = shooting_.unknowns();
  MatrixXd slope(n + 1, n + 2);
  slope.topRightCorner(n, n) = shooting_.slopes(*seen_.arcs);
  slope.bottomRightCorner(1, n) = *seen_.test_slopes;
  for (Index k = 0; k < 2; ++k) {
    const VectorXd step = cycle_difference * VectorXd::Unit(at.size(), k);
    const auto above = plane_.system(at + step), below = plane_.system(at - step);
    const auto change = above && below ? shooting_.by_parameter(*below, *above, 2.0 * cycle_difference, seen_.shape,
                                                                *seen_.arcs, &seen_.value->weights)
                                       : std::nullopt;
    if (!change) return std::nullopt;
    slope.col(k) << change->equations, change->test;
  }
  return slope;
}

std::optional<CurvePlace> CycleCurve::described(const VectorXd& at) const {
  if (!look_at(at)) return std::nullopt;
  CurvePlace place = place_at(at);
  place.point.frequency = two_pi / seen_.shape.period;
  place.point.swing = cycle_swing(*seen_.system, seen_.shape);
  const VectorXd& first = seen_.shape.nodes.front();
  place.point.state.assign(first.begin(), first.end());
  const VectorXcd multipliers = shooting_.multipliers(*seen_.system, seen_.shape, *seen_.arcs);
  if (!(multipliers.array().abs().maxCoeff() < largest_cycle_multiplier)) return std::nullopt;
  place.point.rates.assign(multipliers.begin(), multipliers.end());
  place.pair = {seen_.value->cosine, seen_.value->value + 1.0, {}};
  place.point.others = unstable_multipliers(multipliers);
  for (const Index k : own_multipliers(multipliers, kind_, place.pair))
    place.point.others -= std::abs(multipliers[k]) > 1.0;
  if (kind_ == CurveKind::cycle_torus) return place;
  place.right = seen_.value->right;
  place.left = seen_.value->left;
  const Index n = shooting_.dimension();
  place.double_zero = place.left.head(n).dot(place.right.head(n));
  return place;
}

// The fold's second derivative, which costs as much as the curve's slopes.
double CycleCurve::turn_at(const CurvePlace& place) const {
  stay_near(place);
  if (!look_at(place.at) || !look_closer()) return NAN;
  return shooting_.along(*seen_.test_slopes, *seen_.arcs, place.right.head(shooting_.dimension()),
                         place.right[shooting_.dimension()]);
}

// Between places k - 1 and k the curve may turn back in the plane. Behind the last place of a closed curve come those
// behind the first.
bool CycleCurve::may_turn(std::size_t k) const {
  const auto count = static_cast<long>(places_.size()) - 1;
  const bool closed = ends_[0] == CurveEnd::closed;
  const auto chord = [&](long to) {
    const auto end = static_cast<std::size_t>(closed ? (to - 1 + count) % count + 1 : to);
    return VectorXd((places_[end].at - places_[end - 1].at).head(2));
  };
  const auto here = static_cast<long>(k);
  for (long a = closed ? here - 2 : std::max(here - 2, 1L); a <= here; ++a)
    for (long b = std::max(a + 1, here); b <= (closed ? a + 2 : std::min(a + 2, count)); ++b)
      if (chord(a).dot(chord(b)) < 0.0) return true;
  return false;
}

void CycleCurve::stay_near(const CurvePlace& place) const {
  const auto system = plane_.system(place.at);
  if (!system) return;
  shooting_.stay_near(*system, shape(place.at));
  test_.stay_near(place.right, place.left, place.pair.mean);
  test_.set_phase(shooting_.phase());
  seen_ = {};
}

// A torus's pair turns with the period, once for every further swing of the faster of two.
bool CycleCurve::too_far(const CurvePlace& before, const CurvePlace& place) const {
  constexpr double farthest = 0.35;  // radians: a fifth of what lies between resonances of 1:2 and 1:4
  if (kind_ != CurveKind::cycle_torus) return false;
  const auto angle = [](const CurvePlace& p) { return std::acos(std::clamp(p.pair.mean, -1.0, 1.0)); };
  return std::fabs(angle(before) - angle(place)) > farthest;
}

// The secant's rule that halves the weight of an end that stays.
std::optional<CurvePlace> CycleCurve::zero_of(const CurvePlace& a, const CurvePlace& b,
                                              const PlaceNumber& value) const {
  // Values of a turn have errors of 1e-9, which may be more than the least: then places no longer differ. A pole, at
  // which a value also changes its sign, is not a zero.
  constexpr double least = 1e-7, pole = 1e-3;
  double low = 0.0, high = 1.0, at_low = value(a), at_high = value(b), last = INFINITY;
  const double size = std::max(std::fabs(at_low), std::fabs(at_high)), length = (b.at - a.at).norm();
  int side = 0;
  for (int k = 0; k < 24; ++k) {
    const double part = low + (high - low) * at_low / (at_low - at_high);
    auto place = between(a, b, part);
    if (!place) place = between(b, a, 1.0 - part);
    if (!place) return std::nullopt;
    const double here = value(*place);
    const bool stays = std::fabs(part - last) * length < cycle_limits.precise;
    last = part;
    if (std::fabs(here) < (stays ? pole : least) * size) return place;
    if (here * at_low > 0.0) {
      low = part, at_low = here;
      if (side == -1) at_high *= 0.5;
      side = -1;
    } else {
      high = part, at_high = here;
      if (side == 1) at_low *= 0.5;
      side = 1;
    }
  }
  return std::nullopt;
}

std::optional<CurveEnd> CycleCurve::end_at(const CurvePlace& before, const CurvePlace& place, Way& way) const {
  // Beyond a cycle of size 0 the same cycles come again, half a period later.
  const CycleShape a = shape(before.at), b = shape(place.at);
  VectorXd middle_a = VectorXd::Zero(shooting_.dimension()), middle_b = middle_a;
  for (std::size_t k = 0; k < a.nodes.size(); ++k) middle_a += a.nodes[k], middle_b += b.nodes[k];
  const double count = static_cast<double>(a.nodes.size());
  double alike = 0.0;
  for (std::size_t k = 0; k < a.nodes.size(); ++k)
    alike += (a.nodes[k] - middle_a / count)
                 .cwiseQuotient(shooting_.unit())
                 .dot((b.nodes[k] - middle_b / count).cwiseQuotient(shooting_.unit()));
  if (alike < 0.0 || (place.point.swing < smallest_swing && place.point.swing < before.point.swing))
    return CurveEnd::vanishes;
  if (const auto end = end_of_repeating(before, place, way)) return end;
  if (b.period > longest_period(*plane_.system(place.at), b, birth_period_)) return CurveEnd::long_period;
  if (kind_ == CurveKind::cycle_torus && std::fabs(place.pair.mean) >= 1.0) {
    const double end = place.pair.mean > 0.0 ? 1.0 : -1.0;
    if (auto last = zero_of(before, place, [&](const CurvePlace& p) { return p.pair.mean - end; }))
      way.places.push_back(*std::move(last));
    return CurveEnd::resonance;
  }
  return std::nullopt;
}

// Towards a state at rest the equations become singular: at its end two multipliers are 1. They also do where doubled
// cycles become single ones: the curve on which single ones double their period passes there.
void CycleCurve::end_inside(const CurveFollower::Step&, double, const CurvePlace& before, Way& way) const {
  if (add_single_cycle(way)) {
    way.end = CurveEnd::single_cycle;
    return;
  }
  const double swing = before.point.swing;
  const bool shrinks = way.places.size() > 1 && swing < way.places.front().point.swing && swing < 2.0 * smallest_swing;
  way.end = shrinks ? CurveEnd::vanishes : CurveEnd::lost;
}

void CycleCurve::add_changed_others(const CurvePlace& a, const CurvePlace& b, std::vector<SpecialPoint>& found) const {
  if (a.point.others == b.point.others) return;
  // The multiplier, or pair, that crosses: how far it is outside.
  const auto all_at = [](const CurvePlace& p) {
    return VectorXcd(Eigen::Map<const VectorXcd>(p.point.rates.data(), static_cast<Index>(p.point.rates.size())));
  };
  const auto crossing = [&](const CurvePlace& p) {
    const VectorXcd all = all_at(p);
    const auto own = own_multipliers(all, kind_, p.pair);
    std::complex<double> nearest(INFINITY, 0.0);
    for (Index k = 0; k < all.size(); ++k)
      if (std::find(own.begin(), own.end(), k) == own.end() &&
          std::fabs(std::log(std::abs(all[k]))) < std::fabs(std::log(std::abs(nearest))))
        nearest = all[k];
    return nearest;
  };
  const auto place = zero_of(a, b, [&](const CurvePlace& p) { return std::log(std::abs(crossing(p))); });
  if (!place) return;
  const std::complex<double> at = crossing(*place);
  const bool complex = at.imag() != 0.0;
  // Rounding turns a double real multiplier, the curve's own and this, into a pair: also a zero of double_zero.
  if (const VectorXcd all = all_at(*place);
      complex && kind_ != CurveKind::cycle_torus && all[own_multipliers(all, kind_, place->pair)[0]] == std::conj(at))
    return;
  std::optional<SpecialKind> kind;
  if (complex)
    kind = kind_ == CurveKind::cycle_fold   ? SpecialKind::fold_torus
           : kind_ == CurveKind::cycle_flip ? SpecialKind::flip_torus
                                            : SpecialKind::double_torus;
  else if (kind_ == CurveKind::cycle_torus)
    kind = at.real() > 0.0 ? SpecialKind::fold_torus : SpecialKind::flip_torus;
  else if ((kind_ == CurveKind::cycle_fold) == (at.real() < 0.0))
    kind = SpecialKind::fold_flip;
  if (kind) found.push_back(special(*kind, *place));  // else the same multiplier twice: a zero of double_zero
}

std::vector<SpecialPoint> CycleCurve::specials() const {
  std::vector<SpecialPoint> found;
  for (std::size_t k = 1; k < places_.size(); ++k) {
    const CurvePlace &a = places_[k - 1], &b = places_[k];
    const auto turn = [&](const CurvePlace& p) { return turn_at(p); };
    if (kind_ == CurveKind::cycle_fold && may_turn(k) && turn(a) * turn(b) < 0.0)
      if (const auto place = zero_of(a, b, turn)) found.push_back(special(SpecialKind::cycle_cusp, *place));
    add_zeros(a, b, found);
    add_changed_others(a, b, found);
  }
  constexpr double located = 1e-8;  // of a cosine: zero_of() leaves less of 0.35 radians, a step without it more
  for (const auto& [end, place] : {std::pair{ends_[0], &places_.front()}, {ends_[1], &places_.back()}})
    if (end == CurveEnd::single_cycle && kind_ == CurveKind::cycle_fold)
      found.push_back(special(SpecialKind::generalised_flip, *place));
    else if (end == CurveEnd::resonance && std::fabs(std::fabs(place->pair.mean) - 1.0) < located)
      found.push_back(
          special(place->pair.mean > 0.0 ? SpecialKind::resonance_1_1 : SpecialKind::resonance_1_2, *place));
  return found;
}

}  // namespace equipoise
