// Ramp functions and their segments under both speed laws.
#include "equipoise/drives/speed.hpp"

#include <algorithm>
#include <cstddef>

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

}  // namespace

double SpeedProfile::ramp_function(double t) const {
  if (t <= times.front()) return speeds.front();
  const Branch branch = branch_at(*this, t);
  return branch.speed + branch.slope * (t - branch.begin);
}

std::optional<double> SpeedProfile::first_time_at(double speed) const {
  if (speeds.front() == speed) return times.front();
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double from = speeds[i - 1], to = speeds[i];
    if (speed == to) return times[i];
    if ((from < speed && speed < to) || (to < speed && speed < from))
      return times[i - 1] + (times[i] - times[i - 1]) * ((speed - from) / (to - from));
  }
  return std::nullopt;
}

std::vector<Segment> segments(const SpeedProfile& profile, double release_time) {
  std::vector<double> cuts = profile.times;
  if (std::find(cuts.begin(), cuts.end(), release_time) == cuts.end()) cuts.push_back(release_time);
  std::sort(cuts.begin(), cuts.end());

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
