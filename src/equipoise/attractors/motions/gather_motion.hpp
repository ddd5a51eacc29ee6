// Adds an integrator's dense output to the statistics of a motion, for flows with or without events.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/attractors/motions/motion_statistics.hpp"
#include "equipoise/machine/mechanics/energy.hpp"
#include "equipoise/machine/mechanics/frames.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/smooth_flow-inl.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"

namespace equipoise {

inline constexpr int most_components = HWY_NAMESPACE::SmoothFlow<double, model::any_count, true>::dimension;

// A state with its rate of change. Watched are r^2, the ball rates and a driven rotor's psi', each with its derivative.
struct Instant {
  Instant(int balls, int speed_place) : n(balls), speed(speed_place) {}

  int n;
  int speed;  // place of psi', -1 if it is prescribed
  double t = 0.0;
  double z[most_components], dz[most_components];
  double x, y;  // position whose length is r

  // Half the derivative of r^2 (0), or that of phi_i' (i + 1) or psi' (n + 1). The point from which r is measured rests
  // in fixed axes, so (u, v) is its rate of change.
  double half_slope(int watched) const { return watched == 0 ? x * z[2] + y * z[3] : dz[rate_place(watched)]; }
  double value(int watched) const { return watched == 0 ? std::hypot(x, y) : z[rate_place(watched)]; }
  int rate_place(int watched) const { return watched <= n ? 4 + n + watched - 1 : speed; }
  double r_slope() const {
    const double r = value(0);
    return r > 0.0 ? half_slope(0) / r : 0.0;
  }
};

// r is measured from the sag under gravity.
template <class Flow>
class Gatherer {
 public:
  Gatherer(const model::System& system, const Flow& flow, MotionStatistics& statistics, const double* z)
      : n(system.balls()),
        system_(system),
        flow_(flow),
        sag_(model::static_sag(system.parameters())),
        statistics_(statistics),
        last_(n, system.layout().speed) {
    std::copy(z, z + system.dimension(), last_.z);
    complete(last_);
    const bool fresh = statistics.duration == 0.0;
    for (int i = 0; i < n; ++i) {
      start_[i] = z[4 + i];
      if (fresh) statistics.rate_min[i] = statistics.rate_max[i] = z[4 + n + i];
      for (int j = i + 1; fresh && j < n; ++j) statistics.pair[i][j].begin(z[4 + i] - z[4 + j]);
    }
    take_extremes(last_);
  }

  // Adds one accepted step of the integrator.
  template <class StateAt>
  void step(double begin, double end, double spacing, StateAt& state_at) {
    const int parts = std::max(1, static_cast<int>(std::ceil((end - begin) / spacing)));
    const int watched_last = driven() ? n + 1 : n;
    for (int k = 1; k <= parts; ++k) {
      Instant now = instant(begin + (end - begin) * k / parts, state_at);
      for (int watched = 0; watched <= watched_last; ++watched)
        if (last_.half_slope(watched) * now.half_slope(watched) < 0.0)
          take_extremes(turning_point(watched, last_, now, state_at));
      if (driven()) add_drive(instant(0.5 * (last_.t + now.t), state_at), now);
      add_interval(now);
      last_ = now;
    }
  }

  // The equations and rates may have changed at time `t`, where the next step begins.
  template <class StateAt>
  void enter(double t, StateAt& state_at) {
    last_ = instant(t, state_at);
    take_extremes(last_);
  }

  void finish(double duration) {
    statistics_.duration += duration;
    for (int i = 0; i < n; ++i) statistics_.turned[i] += last_.z[4 + i] - start_[i];
  }

 private:
  bool driven() const { return last_.speed >= 0; }

  template <class StateAt>
  Instant instant(double t, StateAt& state_at) const {
    Instant result(n, last_.speed);
    result.t = t;
    state_at(t, result.z);
    complete(result);
    return result;
  }

  void complete(Instant& at) const {
    flow_(at.t, at.z, at.dz);
    at.x = at.z[0];
    at.y = at.z[1];
    if (sag_ != 0.0) {
      const double psi = system_.layout().psi < 0 ? system_.speed() * at.t : at.z[system_.layout().psi];
      at.x -= sag_ * std::sin(psi);
      at.y -= sag_ * std::cos(psi);
    }
  }

  // Finds where a slope changes sign by false position (Illinois). Five evaluations leave the time uncertain by under
  // 1e-5, which changes the extreme in second order only.
  template <class StateAt>
  Instant turning_point(int watched, const Instant& from, const Instant& to, StateAt& state_at) const {
    double a = from.t, b = to.t, fa = from.half_slope(watched), fb = to.half_slope(watched);
    Instant middle = to;
    for (int k = 0; k < 5 && fa != fb; ++k) {
      middle = instant(a + (b - a) * fa / (fa - fb), state_at);
      const double f = middle.half_slope(watched);
      if (f * fb < 0.0) {
        a = b;
        fa = fb;
      } else {
        fa *= 0.5;
      }
      b = middle.t;
      fb = f;
      if (f == 0.0) break;
    }
    return middle;
  }

  void take_extremes(const Instant& at) {
    statistics_.r_min = std::min(statistics_.r_min, at.value(0));
    statistics_.r_max = std::max(statistics_.r_max, at.value(0));
    for (int i = 0; i < n; ++i) {
      statistics_.rate_min[i] = std::min(statistics_.rate_min[i], at.value(i + 1));
      statistics_.rate_max[i] = std::max(statistics_.rate_max[i], at.value(i + 1));
    }
    if (!driven()) return;
    statistics_.drive.speed_min = std::min(statistics_.drive.speed_min, at.z[at.speed]);
    statistics_.drive.speed_max = std::max(statistics_.drive.speed_max, at.z[at.speed]);
  }

  void add_interval(const Instant& now) {
    take_extremes(now);
    const double h = now.t - last_.t;  // trapezium with end correction: fourth order
    statistics_.r_integral +=
        0.5 * h * (last_.value(0) + now.value(0)) + h * h / 12.0 * (last_.r_slope() - now.r_slope());
    for (int i = 0; i < n; ++i) {
      for (int j = i + 1; j < n; ++j) statistics_.pair[i][j].add(now.z[4 + i] - now.z[4 + j]);
    }
  }

  // By Simpson's rule.
  void add_drive(const Instant& middle, const Instant& now) {
    const auto integral = [&](auto&& value) {
      return (now.t - last_.t) / 6.0 * (value(last_) + 4.0 * value(middle) + value(now));
    };
    const auto speed = [&](const Instant& at) { return at.z[at.speed]; };
    DriveStatistics& drive = statistics_.drive;
    drive.speed_integral += integral(speed);
    drive.torque_integral += integral([&](const Instant& at) { return torque(at); });
    drive.work += integral([&](const Instant& at) { return torque(at) * speed(at); });
    drive.support_work += integral([&](const Instant& at) { return support_power(at); });
  }
  // With isotropic supports any angle will do.
  double support_power(const Instant& at) const {
    const double psi = system_.layout().psi < 0 ? 0.0 : at.z[system_.layout().psi];
    const auto [X, Y] = model::in_fixed_axes(std::cos(psi), std::sin(psi), at.z[2], at.z[3]);
    const auto& damping = system_.parameters().damping;
    const double of_centre = damping[0] * X * X + damping[1] * Y * Y;
    const int tilt = system_.layout().tilt;
    if (tilt < 0) return of_centre;
    return of_centre + model::power_taken_from_tilt(system_.parameters(), psi, at.z, &at.z[tilt]);
  }
  double torque(const Instant& at) const {
    const int error = system_.layout().error;
    const model::DriveSegment& motor = system_.drive().motor;
    return motor.motor_torque(motor.begin, at.z[at.speed], error < 0 ? 0.0 : at.z[error]);
  }

  const int n;
  const model::System& system_;
  const Flow& flow_;
  const double sag_;
  MotionStatistics& statistics_;
  Instant last_;
  double start_[model::max_balls];
};

// Takes angles at equally spaced times, which run on from one stretch to the next.
class Recorder {
 public:
  Recorder(int balls, MotionStatistics& statistics, const double* z)
      : n(balls), spacing_(4.0 * statistics.spacing), before_(statistics.duration), statistics_(statistics) {
    if (statistics.recorded > 0) return;
    statistics.angle.fill(AngleRecord(spacing_));
    take(z);
  }

  // Up to time `end` of this stretch.
  template <class StateAt>
  void step(double end, StateAt& state_at) {
    double z[most_components];
    for (double t; (t = static_cast<double>(statistics_.recorded) * spacing_ - before_) <= end;) {
      state_at(t, z);
      take(z);
    }
  }

 private:
  void take(const double* z) {
    for (int i = 0; i < n; ++i) statistics_.angle[i].add(z[4 + i]);
    ++statistics_.recorded;
  }

  const int n;
  const double spacing_, before_;
  MotionStatistics& statistics_;
};

// Takes states at equal times from the beginning of a stretch, if asked to.
class StateSampler {
 public:
  StateSampler(const Eigen::VectorXd& z, double spacing, std::vector<Eigen::VectorXd>* samples)
      : size_(z.size()), spacing_(spacing), samples_(samples) {
    if (samples_) samples_->assign(1, z);
  }

  // A step that ends at t.
  template <class StateAt>
  void step(double t, StateAt& at) {
    for (; samples_ && static_cast<double>(next_) * spacing_ <= t; ++next_) {
      samples_->emplace_back(size_);
      at(static_cast<double>(next_) * spacing_, samples_->back().data());
    }
  }

 private:
  const Eigen::Index size_;
  const double spacing_;
  std::vector<Eigen::VectorXd>* const samples_;
  std::size_t next_ = 1;
};

// What is requested of one stretch from state `z` on: statistics, samples, both or neither.
template <class Flow>
class Stretch {
 public:
  Stretch(const model::System& system, const Flow& flow, const Eigen::VectorXd& z, MotionStatistics* statistics,
          std::vector<Eigen::VectorXd>* samples)
      : spacing_(statistics && statistics->spacing > 0.0 ? statistics->spacing : sample_spacing(system, z)),
        sampler_(z, spacing_, samples) {
    if (!statistics) return;
    statistics->spacing = spacing_;
    gatherer_.emplace(system, flow, *statistics, z.data());
    recorder_.emplace(system.balls(), *statistics, z.data());
  }

  template <class StateAt>
  void enter(double t, StateAt& at) {
    if (gatherer_) gatherer_->enter(t, at);
  }
  template <class StateAt>
  void step(double from, double to, StateAt& at) {
    if (gatherer_) {
      gatherer_->step(from, to, spacing_, at);
      recorder_->step(to, at);
    }
    sampler_.step(to, at);
  }
  void finish(double duration) {
    if (gatherer_) gatherer_->finish(duration);
  }

 private:
  const double spacing_;
  std::optional<Gatherer<Flow>> gatherer_;
  std::optional<Recorder> recorder_;
  StateSampler sampler_;
};

}  // namespace equipoise
