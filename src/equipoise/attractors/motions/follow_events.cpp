// Follows a trajectory from event to event, and records each one.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "equipoise/attractors/motions/gather_motion.hpp"
#include "equipoise/attractors/motions/motion_statistics.hpp"
#include "equipoise/attractors/periodic_orbits/event_run-inl.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;

// Infers events from the changes at the beginning of the next step.
class EventRecorder {
 public:
  EventRecorder(const model::System& system, const kernels::EventRun& run, EventLog& log)
      : p_(system.parameters()), run_(run), log_(log), senses_(run.senses()), rate_(system.dimension()) {
    log_ = {};
    log_.begin = log_.end = run.mode();
  }

  long seen() const { return seen_; }
  void end_step(const double* y) { std::copy_n(y, rate_.size(), rate_.begin()); }
  // Records the events at `t`, after which the state is `y`.
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
  std::vector<double> rate_;  // last state of the last step
  long seen_ = 0;
};

}  // namespace

IntegrationStatus follow_events(const model::System& system, Eigen::VectorXd& z, double duration, double tolerance,
                                EventLog& log, MotionStatistics* statistics, std::vector<Eigen::VectorXd>* samples,
                                const StopFlag* stop) {
  kernels::EventRun run(system, z.data(), 0.0, kernels::event_scale(system, tolerance));
  Stretch stretch(system, run, z, statistics, samples);
  EventRecorder events(system, run, log);
  double y[most_components];
  const IntegrationStatus status = run.advance(
      duration,
      [&](double from, double to, auto& at) {
        if (run.events() != events.seen()) {
          at(from, y);
          events.enter(from, y);
          stretch.enter(from, at);
        }
        stretch.step(from, to, at);
        at(to, y);
        events.end_step(y);
        return false;
      },
      stop);
  stretch.finish(duration);
  run.state(z.data());
  if (run.events() != events.seen()) events.enter(run.time(), z.data());
  return is_set(stop) ? IntegrationStatus::failed : status;
}

}  // namespace equipoise
