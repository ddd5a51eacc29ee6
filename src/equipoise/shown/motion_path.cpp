// Follows any system's motion as a machine's, with or without events: a drawing needs few of them.
#include "equipoise/shown/motion_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "equipoise/base/angles.hpp"
#include "equipoise/mechanics/frames.hpp"
#include "equipoise/model/stroboscopic_section.hpp"
#include "equipoise/periodic_orbits/event_run-inl.hpp"
#include "equipoise/running/reporting.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;

constexpr double least_turning = 1e-3;
constexpr double path_tolerance = 1e-9;  // far below what a drawing shows

class PathWriter {
 public:
  PathWriter(const model::Parameters& p, MotionPath& path) : p_(p), path_(path) {
    path_.phi.resize(static_cast<std::size_t>(p.balls));
  }

  void add(double psi, double x, double y) {
    const std::array<double, 2> rest = model::rest_position(p_, psi);
    const auto fixed = model::in_fixed_axes(std::cos(psi), std::sin(psi), x - rest[0], y - rest[1]);
    path_.psi.push_back(psi);
    path_.x.push_back(fixed[0]);
    path_.y.push_back(fixed[1]);
  }
  void add_ball(std::size_t i, double phi) { path_.phi[i].push_back(phi); }

 private:
  const model::Parameters& p_;
  MotionPath& path_;
};

MotionPath followed_path(const model::System& system, const Motion& motion, double duration, int count,
                         const StopFlag* stop) {
  MotionPath path;
  const model::Parameters& p = system.parameters();
  PathWriter writer(p, path);
  kernels::EventRun run(system, motion.state.data(), 0.0, kernels::event_scale(system, path_tolerance));
  std::array<double, kernels::EventRun::dimension> y{};
  const double step = duration / count;
  double psi = 0.0, speed = 0.0;
  int next = 0;
  // With a motor and isotropic supports the rotor's angle is not part of the state: integrate it here.
  const auto turn_on = [&] {
    const double now = system.prescribed() ? system.speed() : y[static_cast<std::size_t>(system.layout().speed)];
    if (system.layout().psi >= 0)
      psi = y[static_cast<std::size_t>(system.layout().psi)];
    else if (next > 0)
      psi += 0.5 * step * (speed + now);
    speed = now;
  };
  const auto take = [&] {
    turn_on();
    writer.add(psi, y[model::index::x], y[model::index::y]);
    for (int i = 0; i < p.balls; ++i)
      writer.add_ball(static_cast<std::size_t>(i), y[static_cast<std::size_t>(model::index::phi(i))]);
    ++next;
  };
  run.state(y.data());
  take();
  run.advance(
      duration,
      [&](double, double to, auto& state_at) {
        while (next <= count && next * step <= to) {
          state_at(next * step, y.data());
          take();
        }
        return next > count;
      },
      stop);
  return path;
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
                       const RunOptions& options) {
  return reported(options, [&](const RunOptions& o) { return followed_path(system, motion, duration, count, o.stop); });
}

MotionPath motion_path(const model::Parameters& p, const Trajectory& trajectory, std::size_t first) {
  MotionPath path;
  PathWriter writer(p, path);
  for (std::size_t k = first; k < trajectory.t.size(); ++k) {
    writer.add(trajectory.psi[k], trajectory.x[k], trajectory.y[k]);
    for (std::size_t i = 0; i < trajectory.phi.size(); ++i) writer.add_ball(i, trajectory.phi[i][k]);
  }
  return path;
}

}  // namespace equipoise
