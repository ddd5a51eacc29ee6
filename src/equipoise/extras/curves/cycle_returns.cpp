// Where a curve of cycles comes back to cycles that it had before, at another time of their period. A fold of doubled
// cycles does so at the end that it has on a curve of period doublings: there they are single cycles passed twice, and
// beyond it the same cycles follow, half a period later.
#include <algorithm>
#include <array>
#include <cmath>

#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/extras/curves/cycle_curve.hpp"

namespace equipoise {

using Eigen::Vector3d;
using Eigen::VectorXd;

// What does not depend on the time at which a cycle begins.
Vector3d CycleCurve::timeless(const VectorXd& at) const { return {at[0], at[1], std::log(shape(at).period)}; }

// The last of the first `count` chords of a way that passes through the same cycle: the number of its end.
std::optional<std::size_t> CycleCurve::same_chord(const CurvePlace& place, const std::vector<CurvePlace>& places,
                                                  std::size_t count) const {
  constexpr double beside = 0.2;  // of a chord's length: a curve turns by less than 0.2 radians between two places
  constexpr double same = 1e-7;   // a hundred times what places are off the curve
  const Vector3d here = timeless(place.at);
  for (std::size_t k = count; k >= 1; --k) {
    const CurvePlace &a = places[k - 1], &b = places[k];
    const Vector3d from = timeless(a.at), chord = timeless(b.at) - from;
    const double length = chord.norm();
    const auto part_of = [&](const Vector3d& at) { return (at - from).dot(chord) / (length * length); };
    const double wanted = part_of(here);
    if (!(wanted >= 0.0 && wanted <= 1.0) || (here - from - wanted * chord).norm() > beside * length) continue;
    double part = wanted, slope = 1.0, last_part = 0.0, last = 0.0;
    for (int round = 0; round < 8; ++round) {
      const auto passed = between(a, b, part);
      if (!passed) break;
      const Vector3d there = timeless(passed->at);
      if ((there - here).norm() < same) return k;
      const double now = part_of(there);
      if (std::fabs(now - wanted) * length < 0.1 * same) break;  // it passes by
      if (part != last_part && now != last) slope = (now - last) / (part - last_part);
      last_part = part, last = now;
      part = std::clamp(part + (wanted - now) / slope, 0.0, 1.0);
    }
  }
  return std::nullopt;
}

// From the first state to that half a period later, in units: 0 of a single cycle passed twice.
VectorXd CycleCurve::half_a_period(const CurvePlace& place) const {
  const auto system = plane_.system(place.at);
  const CycleShape cycle = shape(place.at);
  const VectorXd& first = cycle.nodes.front();
  const auto half = system ? advance_state(*system, first, 0.5 * cycle.period, 0.0, 1e-12) : std::nullopt;
  if (!half) return VectorXd::Constant(first.size(), INFINITY);
  return (*half - first).cwiseQuotient(shooting_.unit());
}

// Of the cycle's swing, by half_a_period(). Two curves cross at a single cycle: nearer to it places are less precise.
constexpr double nearest_single = 0.02;

// More places between the last one of the way and one beyond its turn: with each it is four times nearer.
void CycleCurve::come_nearer_to_turn(Way& way, const CurvePlace& beyond) const {
  for (int round = 0; round < 8; ++round) {
    const CurvePlace last = way.places.back();
    const VectorXd apart = half_a_period(last);
    if (!(apart.norm() > 4.0 * nearest_single * last.point.swing)) return;
    const double change = (half_a_period(beyond) - apart).dot(apart) / apart.squaredNorm();
    const auto next = between(last, beyond, std::clamp(-0.75 / change, 0.0, 1.0));
    if (!next || !(half_a_period(*next).norm() < 0.5 * apart.norm())) return;
    way.places.push_back(*next);
  }
}

// The place at which the way's cycles are single ones passed twice, from three places before it: the plane's parameters
// and the period are even in how far the cycles are from that, for beyond it they are the same. False if the way leads
// to none.
bool CycleCurve::add_single_cycle(Way& way) const {
  constexpr double near = 0.2, farther = 1.5;
  const auto is_within = [&](const CurvePlace& place, double part) {
    return half_a_period(place).norm() < part * place.point.swing;
  };
  if (way.places.empty() || !is_within(way.places.back(), near)) return false;
  std::array<double, 3> apart{};
  std::array<const CurvePlace*, 3> places{};
  std::size_t found = 0;
  for (auto place = way.places.rbegin(); place != way.places.rend() && found < 3; ++place) {
    const double here = half_a_period(*place).norm();
    if (found == 0 && here < nearest_single * place->point.swing) continue;
    if (found > 0 && here < apart[found - 1]) return false;
    if (found > 0 && here < farther * apart[found - 1]) continue;
    apart[found] = here;
    places[found++] = &*place;
  }
  if (found < 3) return false;
  VectorXd at = VectorXd::Zero(places[0]->at.size()), even = at;
  for (std::size_t k = 0; k < 3; ++k) {
    const double here = apart[k], other = apart[(k + 1) % 3], third = apart[(k + 2) % 3];
    const double weight = other * third / ((other - here) * (third - here));
    at += weight * places[k]->at;
    even += weight * other * third / ((other + here) * (third + here)) * places[k]->at;
  }
  at.head(3) = even.head(3);  // the parameters and the period; states have odd parts
  stay_near(*places[0]);
  const auto end = described(at);
  if (!end) return false;
  while (is_within(way.places.back(), nearest_single)) way.places.pop_back();
  way.places.push_back(*end);
  return true;
}

// One place may be where a curve crosses itself; of two the order says whether the way goes round or comes back.
std::optional<CurveEnd> CycleCurve::end_of_repeating(const CurvePlace& before, const CurvePlace& place,
                                                     Way& way) const {
  const std::size_t count = way.places.size();  // `before` is the last of them
  if (count < 4) return std::nullopt;
  const auto here = same_chord(place, way.places, count - 1);
  if (!here) return std::nullopt;
  const auto there = same_chord(before, way.places, count - 2);
  if (!there) return std::nullopt;
  if (*there <= *here) return CurveEnd::closed;
  std::size_t turn = *here;  // the first place beyond it
  const VectorXd apart = half_a_period(way.places[turn - 1]);
  while (turn + 1 < count && half_a_period(way.places[turn]).dot(apart) > 0.0) ++turn;
  const CurvePlace beyond = way.places[turn];
  way.places.resize(turn);
  come_nearer_to_turn(way, beyond);
  return add_single_cycle(way) ? CurveEnd::single_cycle : CurveEnd::lost;
}

}  // namespace equipoise
