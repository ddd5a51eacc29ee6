// Following a trajectory by adaptive DOP853 and gathering what it does from the dense output.
#include "equipoise/motions/motion_statistics.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/integrate/adaptive-inl.hpp"
#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/flow-inl.hpp"
#include "equipoise/model/frames.hpp"
#include "equipoise/model/smooth_flow-inl.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/orbits/event_run-inl.hpp"
#include "equipoise/orbits/tangent_flow-inl.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;
constexpr int most = kernels::SmoothFlow<double, model::any_count>::dimension;

// A state with its rate of change, and what is watched: r^2, the ball rates and a driven rotor's psi', each with its
// derivative.
struct Instant {
  Instant(int balls, int speed_place) : n(balls), speed(speed_place) {}

  int n;      // balls
  int speed;  // place of psi', -1 if it is prescribed
  double t = 0.0;
  double z[most], dz[most];
  double x, y;  // position that r is the length of

  // Of r^2 (0), of phi_i' (i + 1) or of psi' (n + 1). What r is measured from rests in fixed axes, so that (u, v) is
  // its rate of change.
  double half_slope(int watched) const { return watched == 0 ? x * z[2] + y * z[3] : dz[rate_place(watched)]; }
  double value(int watched) const { return watched == 0 ? std::hypot(x, y) : z[rate_place(watched)]; }
  int rate_place(int watched) const { return watched <= n ? 4 + n + watched - 1 : speed; }
  double r_slope() const {
    const double r = value(0);
    return r > 0.0 ? half_slope(0) / r : 0.0;
  }
};

// What a flow's source makes of a system: its equations, and their angle where it is no part of the state.
template <kernels::Terms terms>
struct PlainFlow {
  using Flow = kernels::FreeFlow<double, model::any_count, terms>;
  static constexpr bool sags = terms.gravity;
  static Flow make(const model::System& system) {
    return {system.parameters(), model::Segment{0.0, 0.0, 0.0, system.speed(), 0.0, false}};
  }
};
struct GeneralFlow {
  using Flow = kernels::SmoothFlow<double, model::any_count>;
  static constexpr bool sags = true;
  static Flow make(const model::System& system) { return {system, 0.0}; }
};
struct EventSource {
  using Flow = kernels::EventRun;
  static constexpr bool sags = true;
};

template <class Source>
class Gatherer {
 public:
  using Flow = typename Source::Flow;

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

  // What the equations and the rates are may have changed at the time `t`, where the next step begins.
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
    if constexpr (Source::sags) {
      const double psi = system_.layout().psi < 0 ? system_.speed() * at.t : at.z[system_.layout().psi];
      at.x -= sag_ * std::sin(psi);
      at.y -= sag_ * std::cos(psi);
    }
  }

  // Where a slope changes sign, by false position (Illinois): five evaluations leave the time uncertain by less than
  // 1e-5, to which the extreme is insensitive in first order.
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
  // On equal supports at whatever angle.
  double support_power(const Instant& at) const {
    const double psi = system_.layout().psi < 0 ? 0.0 : at.z[system_.layout().psi];
    const auto [X, Y] = model::in_fixed_axes(std::cos(psi), std::sin(psi), at.z[2], at.z[3]);
    const auto& damping = system_.parameters().damping;
    return damping[0] * X * X + damping[1] * Y * Y;
  }
  double torque(const Instant& at) const {
    const int error = system_.layout().error;
    const model::DriveSegment& motor = system_.drive().motor;
    return motor.torque(motor.begin, at.z[at.speed], error < 0 ? 0.0 : at.z[error]);
  }

  const int n;  // balls
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
    double z[most];
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

  const int n;  // balls
  const double spacing_, before_;
  MotionStatistics& statistics_;
};

// States at equal times from where it begins, if anybody wants them.
class Sampler {
 public:
  Sampler(const Eigen::VectorXd& z, double spacing, std::vector<Eigen::VectorXd>* samples)
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

template <class Source>
IntegrationStatus follow_balls(const model::System& system, Eigen::VectorXd& z, double duration, double tolerance,
                               MotionStatistics* statistics, std::vector<Eigen::VectorXd>* samples,
                               const StopFlag* stop) {
  using Flow = typename Source::Flow;
  kernels::ErrorScale<Flow::dimension> scale;
  scale.tolerance = tolerance;
  kernels::set_system_scale(system, 1, scale);
  const Flow flow = Source::make(system);
  kernels::AdaptiveIntegrator<Flow, Flow::dimension> integrator(flow, scale, system.dimension());
  if (!statistics && !samples)
    return integrator.advance(
        0.0, duration, z.data(), [](double, double, auto&&) {}, stop);
  MotionStatistics unused;
  MotionStatistics& sums = statistics ? *statistics : unused;
  if (sums.spacing == 0.0) sums.spacing = sample_spacing(system, z);
  const double spacing = sums.spacing;
  Gatherer<Source> gatherer(system, flow, sums, z.data());
  Recorder recorder(system.balls(), sums, z.data());
  Sampler sampler(z, spacing, samples);
  const IntegrationStatus status = integrator.advance(
      0.0, duration, z.data(),
      [&](double t, double t_new, auto at) {
        gatherer.step(t, t_new, spacing, at);
        recorder.step(t_new, at);
        sampler.step(t_new, at);
      },
      stop);
  gatherer.finish(duration);
  return status;
}

// Tells events from what changed where the next step begins.
class EventRecorder {
 public:
  EventRecorder(const model::System& system, const kernels::EventRun& run, EventLog& log)
      : p_(system.parameters()), run_(run), log_(log), senses_(run.senses()), rate_(system.dimension()) {
    log_ = {};
    log_.begin = log_.end = run.mode();
  }

  long seen() const { return seen_; }
  void end_step(const double* y) { std::copy_n(y, rate_.size(), rate_.begin()); }
  // After which the state is `y`.
  void enter(double t, const double* y) {
    const model::BallMode mode = run_.mode();
    const auto senses = run_.senses();
    log_.count += run_.events() - seen_;
    seen_ = run_.events();
    pairs(t, mode, y);
    for (int i = 0; i < p_.balls; ++i) {
      if (mode.held[i] != log_.end.held[i]) {
        add({t, mode.held[i] ? BallEventKind::stick : BallEventKind::slip, i});
      } else if (senses[i] * senses_[i] < 0) {
        add({t, BallEventKind::turn, i});
        log_.reverses = true;
      }
    }
    log_.end = mode;
    senses_ = senses;
  }

 private:
  void pairs(double t, const model::BallMode& mode, const double* y) {
    const int n = p_.balls;
    for (int k = 0; k < n && n > 1; ++k) {
      const int a = mode.order[k], b = mode.order[(k + 1) % n];
      const auto apart = [&](const double* z) { return z[model::index::q(b, n)] - z[model::index::q(a, n)]; };
      constexpr double touching = 1e-7;
      const double gap = wrapped(y[model::index::phi(b)] - y[model::index::phi(a)] - p_.contact_angle);
      if (mode.joined[k] != log_.end.joined[k])
        add({t, mode.joined[k] ? BallEventKind::press : BallEventKind::part, a, b});
      else if (!mode.joined[k] && p_.balls_collide() && std::fabs(gap) < touching && apart(rate_.data()) < 0.0 &&
               apart(y) >= 0.0)
        add({t, BallEventKind::strike, a, b});
    }
  }
  void add(const BallEvent& e) {
    constexpr std::size_t most_events = 1000;
    if (log_.events.size() < most_events) log_.events.push_back(e);
  }

  const model::Parameters& p_;
  const kernels::EventRun& run_;
  EventLog& log_;
  std::array<int, model::max_balls> senses_;
  std::vector<double> rate_;  // the last step's last state
  long seen_ = 0;
};

}  // namespace

IntegrationStatus follow_events(const model::System& system, Eigen::VectorXd& z, double duration, double tolerance,
                                EventLog& log, MotionStatistics* statistics, std::vector<Eigen::VectorXd>* samples,
                                const StopFlag* stop) {
  kernels::EventRun run(system, z.data(), 0.0, kernels::event_scale(system, tolerance));
  MotionStatistics unused;
  MotionStatistics& sums = statistics ? *statistics : unused;
  if (sums.spacing == 0.0) sums.spacing = sample_spacing(system, z);
  const double spacing = sums.spacing;
  Gatherer<EventSource> gatherer(system, run, sums, z.data());
  Recorder recorder(system.balls(), sums, z.data());
  EventRecorder events(system, run, log);
  Sampler sampler(z, spacing, samples);
  double y[most];
  const IntegrationStatus status = run.advance(
      duration,
      [&](double from, double to, auto& at) {
        if (run.events() != events.seen()) {
          at(from, y);
          events.enter(from, y);
          gatherer.enter(from, at);
        }
        if (statistics) {
          gatherer.step(from, to, spacing, at);
          recorder.step(to, at);
        }
        sampler.step(to, at);
        at(to, y);
        events.end_step(y);
        return false;
      },
      stop);
  if (statistics) gatherer.finish(duration);
  run.state(z.data());
  if (run.events() != events.seen()) events.enter(run.time(), z.data());
  return is_set(stop) ? IntegrationStatus::failed : status;
}

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
  using Autonomous = PlainFlow<kernels::Terms{false, false, false}>;
  using Strobed = PlainFlow<kernels::Terms{false, true, true}>;
  const auto by = [&]<class Source>(Source) {
    return follow_balls<Source>(system, state, duration, tolerance, statistics, samples, stop);
  };
  const IntegrationStatus status = !system.plain()       ? by(GeneralFlow{})
                                   : system.autonomous() ? by(Autonomous{})
                                                         : by(Strobed{});
  return is_set(stop) ? IntegrationStatus::failed : status;
}

}  // namespace equipoise
