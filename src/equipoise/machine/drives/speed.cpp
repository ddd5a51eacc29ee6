// Ramp functions and their segments under both speed laws.
#include "equipoise/machine/drives/speed.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "equipoise/core/base/typed_numbers.hpp"

namespace equipoise::model {

namespace {

struct Branch {
  double begin, speed, slope;
};

// The branch of the ramp function that holds at `t` and just after.
Branch branch_at(const SpeedProfile& p, double t) {
  for (std::size_t i = 1; i < p.times.size(); ++i)
    if (t < p.times[i])
      return {p.times[i - 1], p.speeds[i - 1], (p.speeds[i] - p.speeds[i - 1]) / (p.times[i] - p.times[i - 1])};
  return {p.times.back(), p.speeds.back(), 0.0};
}

// Horner's rule over a curve's coefficients, each times factor(k).
template <class Factor>
double sum_of(const std::array<double, SpeedCurve::terms>& by, double u, const Factor& factor) {
  double sum = 0.0;
  for (int k = SpeedCurve::terms - 1; k >= 0; --k) sum = sum * u + by[k] * factor(k);
  return sum;
}

// The polynomial through 16 Chebyshev points of [begin, end], both ends among them, less the line between the ends.
SpeedCurve curve_through(const HillFunction& hill, double begin, double end) {
  constexpr int degree = SpeedCurve::terms;
  const double length = end - begin, from = hill.speed(begin), rise = hill.speed(end) - from;
  const auto angle_at = [](int j) { return std::numbers::pi * j / degree; };
  std::array<double, degree + 1> off{};
  for (int j = 1; j < degree; ++j) {
    const double u = 0.5 - 0.5 * std::cos(angle_at(j));
    off[j] = hill.speed(begin + length * u) - from - rise * u;
  }
  SpeedCurve curve{.rate = 1.0 / length};
  // Chebyshev polynomials of 1 - 2u, by powers of u.
  std::array<double, degree + 1> before{}, now{}, next{};
  before[0] = 1.0;
  now[0] = 1.0;
  now[1] = -2.0;
  for (int k = 1; k <= degree; ++k) {
    double weight = 0.0;
    for (int j = 1; j < degree; ++j) weight += off[j] * std::cos(angle_at(j * k));
    weight *= (k == degree ? 1.0 : 2.0) / degree;
    for (int power = 1; power <= degree; ++power) curve.by[power - 1] += weight * now[power];
    for (int power = 0; power <= degree; ++power)
      next[power] = 2.0 * now[power] - before[power] - (power > 0 ? 4.0 * now[power - 1] : 0.0);
    before = now;
    now = next;
  }
  return curve;
}

bool follows(const SpeedCurve& curve, const HillFunction& hill, double begin, double end) {
  constexpr int points = 37;
  // Of the limit: four roundings, and that of t, which the exponent multiplies.
  const double allowed = 1e-15 + 2e-16 * hill.exponent;
  const double from = hill.speed(begin), rise = hill.speed(end) - from;
  for (int j = 1; j < points; ++j) {
    const double u = static_cast<double>(j) / points, t = begin + (end - begin) * u;
    if (!(std::fabs(from + rise * u + curve.speed((end - begin) * u) - hill.speed(t)) <=
          allowed * std::fabs(hill.limit)))
      return false;
  }
  return true;
}

// Halves until each part is followed; appends where the parts end.
void cut(const HillFunction& hill, double begin, double end, std::vector<double>& ends) {
  constexpr double shortest = 1e-11;  // of the half time: what happens in it no rotor feels
  constexpr double fine = 1e-3;       // of the time so far: no exponent needs shorter parts
  const double length = end - begin;
  if (length > shortest * hill.half_time && length > fine * begin &&
      !follows(curve_through(hill, begin, end), hill, begin, end)) {
    const double middle = 0.5 * (begin + end);
    cut(hill, begin, middle, ends);
    return cut(hill, middle, end, ends);
  }
  ends.push_back(end);
}

}  // namespace

double HillFunction::speed(double t) const { return t > 0.0 ? limit / (1.0 + std::pow(half_time / t, exponent)) : 0.0; }

double HillFunction::slope(double t) const {
  if (!(t > 0.0)) return exponent > 1.0 ? 0.0 : limit / half_time;
  const double share = 1.0 / (1.0 + std::pow(half_time / t, exponent));
  return limit * exponent * share * (1.0 - share) / t;
}

double HillFunction::steepest() const {
  // The slope rises to where t^n/t_half^n = (n - 1)/(n + 1).
  return std::fabs(slope(half_time * std::pow((exponent - 1.0) / (exponent + 1.0), 1.0 / exponent)));
}

double SpeedCurve::speed(double tau) const {
  const double u = rate * tau;
  return u * sum_of(by, u, [](int) { return 1.0; });
}

double SpeedCurve::acceleration(double tau) const {
  return rate * sum_of(by, rate * tau, [](int k) { return k + 1.0; });
}

double SpeedCurve::angle(double tau) const {
  const double u = rate * tau;
  return tau * u * sum_of(by, u, [](int k) { return 1.0 / (k + 2.0); });
}

double SpeedProfile::ramp_function(double t) const {
  if (t <= times.front()) return speeds.front();
  if (hill && t < times[1]) return hill->speed(t);
  const Branch branch = branch_at(*this, t);
  return branch.speed + branch.slope * (t - branch.begin);
}

std::optional<double> SpeedProfile::first_time_at(double speed) const {
  if (same_quantity(speeds.front(), speed)) return times.front();
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double from = speeds[i - 1], to = speeds[i];
    if (same_quantity(speed, to)) return times[i];
    if (hill && i == 1 && from < speed / hill->limit && speed / hill->limit < to / hill->limit)
      return hill->half_time * std::pow(speed / (hill->limit - speed), 1.0 / hill->exponent);
    if ((from < speed && speed < to) || (to < speed && speed < from))
      return times[i - 1] + (times[i] - times[i - 1]) * ((speed - from) / (to - from));
  }
  return std::nullopt;
}

std::vector<Segment> segments(const SpeedProfile& profile, double release_time) {
  std::vector<double> cuts = profile.times;
  if (std::find(cuts.begin(), cuts.end(), release_time) == cuts.end()) cuts.push_back(release_time);
  std::sort(cuts.begin(), cuts.end());
  const double curved_until = profile.hill ? profile.times[1] : 0.0;
  if (profile.hill) {
    std::vector<double> finer{0.0};
    for (std::size_t i = 1; i < cuts.size(); ++i)
      if (cuts[i] <= curved_until)
        cut(*profile.hill, cuts[i - 1], cuts[i], finer);
      else
        finer.push_back(cuts[i]);
    cuts = std::move(finer);
  }

  std::vector<Segment> result;
  double psi = profile.initial_angle;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const double begin = cuts[i];
    const bool last = i + 1 == cuts.size();
    const double end = last ? std::numeric_limits<double>::infinity() : cuts[i + 1];
    const double omega = profile.ramp_function(begin);
    const double slope =
        branch_at(profile, begin).slope;  // of the whole branch: over a short piece digits would cancel
    Segment segment{begin, end, psi, omega, slope, begin < release_time};
    if (end <= curved_until) {
      segment.acceleration = (profile.hill->speed(end) - omega) / (end - begin);
      segment.curve = curve_through(*profile.hill, begin, end);
    }
    if (profile.law == SpeedLaw::published) {  // psi = t Omega(t): psi' = Omega + t Omega', psi'' = 2 Omega'
      segment.psi = profile.initial_angle + begin * omega;
      segment.speed = omega + begin * slope;
      segment.acceleration = 2.0 * slope;
    }
    result.push_back(segment);
    if (!last) psi = segment.psi_at(end);
  }
  return result;
}

}  // namespace equipoise::model
