// Follows any system's motion as a machine's, with or without events: a drawing needs few of them.
#include "equipoise/report/shown/motion_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/mechanics/frames.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/attractors/periodic_orbits/event_run-inl.hpp"
#include "equipoise/attractors/periodic_orbits/tangent_flow-inl.hpp"
#include "equipoise/core/running/reporting.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;

constexpr double least_turning = 1e-3;
constexpr double path_tolerance = 1e-9;  // far below what a drawing shows

class PathWriter {
 public:
  PathWriter(const model::Parameters& p, MotionPath& path, double place)
      : rest_(model::static_sag(p) + place * model::static_slope(p)), place_(place), path_(path) {
    path_.phi.resize(static_cast<std::size_t>(p.balls));
  }

  // `tilt`: the slopes of a tilting rotor.
  void add(double psi, double x, double y, const std::array<double, 2>& tilt) {
    const double c = std::cos(psi), s = std::sin(psi);
    const auto fixed = model::in_fixed_axes(c, s, x + place_ * tilt[0] - rest_ * s, y + place_ * tilt[1] - rest_ * c);
    path_.psi.push_back(psi);
    path_.x.push_back(fixed[0]);
    path_.y.push_back(fixed[1]);
  }
  void add_ball(std::size_t i, double phi) { path_.phi[i].push_back(phi); }

 private:
  const double rest_, place_;
  MotionPath& path_;
};

// Takes states of the system, step apart, as they come.
class PathTaker {
 public:
  PathTaker(const model::System& system, double step, int count, double place)
      : system_(system), step_(step), count_(count), writer_(system.parameters(), path_, place) {}

  bool done() const { return next_ > count_; }
  double next() const { return next_ * step_; }
  void take(const double* y) {
    turn_on(y);
    const int tilt = system_.layout().tilt;
    writer_.add(psi_, y[model::index::x], y[model::index::y],
                tilt < 0 ? std::array<double, 2>{} : std::array<double, 2>{y[tilt], y[tilt + 1]});
    for (int i = 0; i < system_.balls(); ++i) writer_.add_ball(static_cast<std::size_t>(i), y[model::index::phi(i)]);
    ++next_;
  }
  MotionPath path() { return std::move(path_); }

 private:
  // With a motor and isotropic supports the rotor's angle is not part of the state: integrate it here.
  void turn_on(const double* y) {
    const double now = system_.prescribed() ? system_.speed() : y[system_.layout().speed];
    if (system_.layout().psi >= 0)
      psi_ = y[system_.layout().psi];
    else if (next_ > 0)
      psi_ += 0.5 * step_ * (speed_ + now);
    speed_ = now;
  }

  const model::System& system_;
  const double step_;
  const int count_;
  MotionPath path_;
  PathWriter writer_;
  double psi_ = 0.0, speed_ = 0.0;
  int next_ = 0;
};

template <std::size_t size, class StateAt>
void take_until(double to, StateAt& state_at, PathTaker& taker) {
  std::array<double, size> y{};
  while (!taker.done() && taker.next() <= to) {
    state_at(taker.next(), y.data());
    taker.take(y.data());
  }
}

// Of a tilting rotor, whose balls meet no event.
void follow_tilting(const model::System& system, const Motion& motion, double duration, PathTaker& taker,
                    const StopFlag* stop) {
  constexpr std::size_t size = kernels::TiltSource::dimension;
  std::array<double, size> y{};
  std::copy_n(motion.state.data(), motion.state.size(), y.begin());
  taker.take(y.data());
  kernels::SmoothRun<kernels::TiltSource>(system, 0.0, path_tolerance)
      .advance(
          duration, y.data(), [&](double, double to, auto&& state_at) { take_until<size>(to, state_at, taker); }, stop);
}

MotionPath followed_path(const model::System& system, const Motion& motion, double duration, int count, double place,
                         const StopFlag* stop) {
  PathTaker taker(system, duration / count, count, place);
  if (system.tilts()) {
    follow_tilting(system, motion, duration, taker, stop);
    return taker.path();
  }
  kernels::EventRun run(system, motion.state.data(), 0.0, kernels::event_scale(system, path_tolerance));
  std::array<double, kernels::EventRun::dimension> y{};
  run.state(y.data());
  taker.take(y.data());
  run.advance(
      duration,
      [&](double, double to, auto& state_at) {
        take_until<kernels::EventRun::dimension>(to, state_at, taker);
        return taker.done();
      },
      stop);
  return taker.path();
}

}  // namespace

double turn_time(double speed) { return two_pi / std::max(std::fabs(speed), least_turning); }

double whole_way(const Motion& motion) {
  constexpr double longest = 2000.0;
  const double turn = turn_time(motion.speed);
  const bool rests = motion.kind == MotionKind::equilibrium;
  const double way = rests ? turn : motion.kind == MotionKind::periodic ? std::max(motion.period, 4.0 * turn) : longest;
  return std::min(way, longest);
}

MotionPath motion_path(const model::System& system, const Motion& motion, double duration, int count,
                       const RunOptions& options, double place) {
  return reported(options,
                  [&](const RunOptions& o) { return followed_path(system, motion, duration, count, place, o.stop); });
}

MotionPath motion_path(const model::Parameters& p, const Trajectory& trajectory, std::size_t first, double place) {
  MotionPath path;
  PathWriter writer(p, path, place);
  for (std::size_t k = first; k < trajectory.t.size(); ++k) {
    writer.add(
        trajectory.psi[k], trajectory.x[k], trajectory.y[k],
        trajectory.tilts ? std::array<double, 2>{trajectory.tilt_x[k], trajectory.tilt_y[k]} : std::array<double, 2>{});
    for (std::size_t i = 0; i < trajectory.phi.size(); ++i) writer.add_ball(i, trajectory.phi[i][k]);
  }
  return path;
}

}  // namespace equipoise
