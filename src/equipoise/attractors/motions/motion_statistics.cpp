// Follows a trajectory by adaptive DOP853; compares two stretches.
#include "equipoise/attractors/motions/motion_statistics.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/attractors/motions/gather_motion.hpp"
#include "equipoise/attractors/periodic_orbits/tangent_flow-inl.hpp"

namespace equipoise {

namespace kernels = HWY_NAMESPACE;

void AngleHistory::add_distance(double angle) {
  const double distance = std::fabs(angle - two_pi * std::floor(angle / two_pi + 0.5));  // faster than wrapped()
  farthest = std::max(farthest, distance);
}

void AngleHistory::add(double angle) {
  const long from = static_cast<long>(std::floor(last_ / pi)), to = static_cast<long>(std::floor(angle / pi));
  for (long k = from; k != to;) {
    const long crossed = to > from ? ++k : k--;
    if (crossed % 2 != 0) ++passed_pi;
  }
  add_distance(last_ = angle);
}

bool similar(const MotionStatistics& a, const MotionStatistics& b, int n, double share_of_extremes,
             double share_of_means) {
  const auto close = [](double f, double g, double within) { return std::fabs(f - g) <= within; };
  double rate = 0.0;
  for (int i = 0; i < n; ++i) rate = std::max({rate, std::fabs(b.rate_min[i]), std::fabs(b.rate_max[i])});
  bool same = close(a.r_max, b.r_max, share_of_extremes * b.r_max) &&
              close(a.r_min, b.r_min, share_of_extremes * b.r_max) &&
              close(a.r_mean(), b.r_mean(), share_of_means * b.r_mean());
  double slowest_a = 0.0, slowest_b = 0.0, fastest_a = 0.0, fastest_b = 0.0, drift_a = 0.0, drift_b = 0.0;
  for (int i = 0; i < n; ++i) {
    slowest_a = std::min(slowest_a, a.rate_min[i]);
    slowest_b = std::min(slowest_b, b.rate_min[i]);
    fastest_a = std::max(fastest_a, a.rate_max[i]);
    fastest_b = std::max(fastest_b, b.rate_max[i]);
    drift_a += a.turned[i] / (a.duration * n);
    drift_b += b.turned[i] / (b.duration * n);
  }
  same = same && close(slowest_a, slowest_b, share_of_extremes * rate) &&
         close(fastest_a, fastest_b, share_of_extremes * rate) &&
         close(drift_a, drift_b, share_of_means * rate + two_pi / a.duration);
  // psi' of a driven rotor.
  if (!(b.drive.speed_max >= b.drive.speed_min)) return same;
  const double fastest = std::max(std::fabs(b.drive.speed_min), std::fabs(b.drive.speed_max));
  return same && close(a.drive.speed_min, b.drive.speed_min, share_of_extremes * fastest) &&
         close(a.drive.speed_max, b.drive.speed_max, share_of_extremes * fastest) &&
         close(a.speed_mean(), b.speed_mean(), share_of_means * fastest);
}

double sample_spacing(const model::System& system, const Eigen::VectorXd& state) {
  return 0.2 / std::max({1.0, std::fabs(system.pace()), std::fabs(system.speed(state))});
}

IntegrationStatus follow(const model::System& system, Eigen::VectorXd& state, double duration, double tolerance,
                         MotionStatistics* statistics, std::vector<Eigen::VectorXd>* samples, const StopFlag* stop) {
  if (!system.smooth()) {
    EventLog log;
    return follow_events(system, state, duration, tolerance, log, statistics, samples, stop);
  }
  const IntegrationStatus status = kernels::with_source(system, [&]<class Source>(Source) {
    const kernels::SmoothRun<Source> run(system, 0.0, tolerance);
    if (!statistics && !samples) return run.advance(duration, state.data(), kernels::unobserved, stop);
    Stretch stretch(system, run.flow(), state, statistics, samples);
    const IntegrationStatus ended = run.advance(
        duration, state.data(), [&](double from, double to, auto&& at) { stretch.step(from, to, at); }, stop);
    stretch.finish(duration);
    return ended;
  });
  return is_set(stop) ? IntegrationStatus::failed : status;
}

}  // namespace equipoise
