// One trajectory: clamped spin-up by superposition, then the free equations piece by piece; or as a machine from event
// to event.
#include "equipoise/simulation/trajectory/simulate.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/simulation/integrate/adaptive-inl.hpp"
#include "equipoise/simulation/integrate/clamped.hpp"
#include "equipoise/simulation/integrate/event_trajectory-inl.hpp"
#include "equipoise/machine/mechanics/frames.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/flow-inl.hpp"
#include "equipoise/machine/model/state_layout.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/core/running/reporting.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "equipoise/simulation/trajectory/record.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;

void check_overlap(const Study& study) {
  const model::Parameters& p = study.parameters;
  if (!p.balls_collide()) return;
  for (int i = 0; i < p.balls; ++i)
    for (int j = 0; j < i; ++j) {
      const double apart = std::fabs(wrapped(study.initial.phi[i] - study.initial.phi[j]));
      if (apart < p.contact_angle)
        throw InputError(
            study.name, "initial.phi", fmt::format("{}", study.initial.phi[i]),
            fmt::format("balls {} and {} overlap: {} rad apart; must be at least {} apart, as balls are that touch",
                        j + 1, i + 1, apart, p.contact_angle));
    }
}

}  // namespace

// A study as a machine from event to event, from t = 0 on.
class AnyMachine {
 public:
  // The study outlives it.
  explicit AnyMachine(const Study& study) {
    if (study.parameters.tilts())
      begin<true>(study);
    else
      begin<false>(study);
  }

  // Calls f with the trajectory.
  template <class F>
  decltype(auto) with(F&& f) {
    if (auto* plane = std::get_if<Machine<false>>(&run_)) return f(*plane);
    return f(std::get<Machine<true>>(run_));
  }

 private:
  template <bool tilt>
  using Machine = kernels::EventTrajectory<model::any_count, tilt>;

  template <bool tilt>
  void begin(const Study& study) {
    const model::Parameters& p = study.parameters;
    const model::Drive drive = study.drive();
    std::array<double, Machine<tilt>::dimension> z{};
    initial_state(parted(p, study.initial), p.balls, drive.speed, z.data(), tilt ? model::dimension(p.balls) : -1);
    const double tolerance = study.numerics.tolerance.value_or(default_simulate_tolerance);
    run_.emplace<Machine<tilt>>(p, drive, kernels::machine_scale<Machine<tilt>::dimension>(p, tolerance), z.data());
  }

  std::variant<std::monostate, Machine<false>, Machine<true>> run_;
};

namespace {

void record(Trajectory& out, const model::Parameters& p, const model::Segment& segment, double t, const double* z) {
  record(out, p, segment.psi_at(t), segment.speed_at(t), t, z);
}

// Reports rarely: a row takes microseconds.
class RowCount {
 public:
  RowCount(const RunOptions& options, std::size_t total) : options_(options), total_(total) {}

  void report(std::size_t rows, bool last = false) {
    constexpr std::chrono::milliseconds interval{50};
    if (!options_.progress || (!last && std::chrono::steady_clock::now() - last_ < interval)) return;
    last_ = std::chrono::steady_clock::now();
    options_.progress({rows, total_, "rows", {}});
  }

 private:
  const RunOptions& options_;
  std::size_t total_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

struct Task {
  const Study& study;
  double tolerance;
  const std::vector<double>& times;
  const StopFlag* stop;
  RowCount& rows;

  bool stopped() const { return is_set(stop); }
};

void simulate_free(const Task& task, const std::vector<model::Segment>& segments, std::size_t first,
                   std::vector<double>& z, std::size_t next, Trajectory& out) {
  using Flow = kernels::FreeFlow<double, model::any_count, kernels::Terms{}>;
  const model::Parameters& p = task.study.parameters;
  const std::vector<double>& times = task.times;
  const auto scale = kernels::error_scale<Flow::dimension>(p, task.tolerance);
  for (std::size_t k = first; k < segments.size() && next < times.size(); ++k) {
    const model::Segment& segment = segments[k];
    for (; next < times.size() && times[next] == segment.begin; ++next)
      record(out, p, segment, segment.begin, z.data());
    const double end = std::min(segment.end, times.back());
    if (!(segment.begin < end)) continue;
    const Flow flow(p, segment);
    kernels::AdaptiveIntegrator<Flow, Flow::dimension> integrator(flow, scale, flow.size());
    out.status = integrator.advance(
        segment.begin, end, z.data(),
        [&](double, double t_new, auto&& state_at) {
          for (; next < times.size() && times[next] <= t_new && times[next] < segment.end; ++next) {
            double at[Flow::dimension];
            state_at(times[next], at);
            record(out, p, segment, times[next], at);
          }
          task.rows.report(out.t.size());
        },
        task.stop);
    out.stopped = task.stopped();
    if (out.status != IntegrationStatus::done || out.stopped) return;
    if (k + 1 < segments.size())
      model::apply_speed_jump(segments[k + 1].speed - segment.speed_at(segment.end), z.data());
  }
}

void simulate_machine(const Task& task, Trajectory& out) {
  const std::vector<double>& times = task.times;
  if (times.empty()) return;
  AnyMachine run(task.study);
  run.with([&](auto& machine) {
    std::size_t next = 0;
    out.status = machine.advance(
        times.back(),
        [&](double, double to, auto&& state_at) {
          for (; next < times.size() && times[next] < to; ++next) {
            double at[std::remove_reference_t<decltype(machine)>::dimension];
            state_at(times[next], at);
            record(out, task.study, times[next], at);
          }
          task.rows.report(out.t.size());
          return false;
        },
        task.stop);
    out.stopped = task.stopped();
    if (out.status != IntegrationStatus::done || out.stopped) return;
    machine.enter();
    record(out, task.study, times.back(), machine.state());
  });
}

Trajectory followed(const Task& task) {
  const Study& study = task.study;
  const std::vector<double>& times = task.times;
  const model::Parameters& p = study.parameters;
  Trajectory out;
  out.phi.resize(p.balls);
  out.phi_dot.resize(p.balls);
  out.tilts = p.tilts();
  if (out.tilts) {
    out.bearing_radial.resize(study.bearings.size());
    out.bearing_force.resize(study.each_bearing().size());
  }
  // FreeFlow sums the rotor's forces up with its first ball.
  if (!study.system().simple() || p.balls == 0) {
    check_overlap(study);
    simulate_machine(task, out);
    return out;
  }
  const double release = study.release_time();
  const auto segments = model::segments(study.speed_profile(), release);
  const InitialState start = parted(p, study.initial);
  const double* phi = start.phi.data();

  std::vector<double> z(model::dimension(p.balls));
  initial_state(start, p.balls, segments.front().speed, z.data());

  std::size_t free_from = 0;
  while (segments[free_from].clamped) ++free_from;
  std::size_t next = 0;
  if (free_from > 0) {
    ClampedBasis basis;
    std::vector<double> at = z;
    const auto observe = [&](double t, const model::Segment& segment, const ClampedBasis& there) {
      there.centre(p, phi, at.data());
      record(out, p, segment, t, at.data());
    };
    out.status = integrate_clamped(p, segments, {z[0], z[1], z[2], z[3]}, task.tolerance, basis, times, observe,
                                   times.empty() ? 0.0 : times.back(), task.stop);
    next = out.t.size();
    out.stopped = task.stopped();
    if (out.status != IntegrationStatus::done || out.stopped) return out;
    basis.centre(p, phi, z.data());
  }
  simulate_free(task, segments, free_from, z, next, out);
  return out;
}

}  // namespace

void check_output_times(const std::vector<double>& times) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || times[i] < 0.0)
      throw InputError("output times", fmt::format("time {}", i + 1), fmt::format("{}", times[i]),
                       "must be a finite number, 0 or more");
    if (i > 0 && !(times[i] > times[i - 1]))
      throw InputError("output times", fmt::format("time {}", i + 1), fmt::format("{}", times[i]),
                       fmt::format("times out of order: must be later than the time before it, {}", times[i - 1]));
  }
}

Trajectory simulate(const Study& study, const std::vector<double>& times, const RunOptions& options) {
  check(study);
  check_output_times(times);
  return reported(options, [&](const RunOptions& o) {
    RowCount rows(o, times.size());
    Trajectory out =
        followed({study, study.numerics.tolerance.value_or(default_simulate_tolerance), times, o.stop, rows});
    rows.report(out.t.size(), true);
    return out;
  });
}

std::vector<double> output_times(const Study& study, std::optional<double> asked_until,
                                 std::optional<double> asked_every) {
  check(study);
  const auto reject = [](const char* key, double value, const std::string& problem) {
    throw InputError("output times", key, fmt::format("{}", value), problem);
  };
  const model::Drive drive = study.drive();
  const double last_branch = std::max(drive.pieces.back().begin, study.speed.driven() ? 0.0 : drive.release_time);
  const double until = asked_until.value_or(last_branch + 100.0);
  if (!(until >= 0.0 && until <= last_output_time)) reject("until", until, "must be a number from 0 to 1e9");
  const double every = asked_every.value_or(until > 0.0 ? until / 100.0 : 1.0);
  if (!(every > 0.0 && every <= last_output_time))
    reject("every", every, "must be a number greater than 0, at most 1e9");
  if (until / every > most_output_rows)
    reject("every", every,
           fmt::format("makes more than {:.0f} rows; must be at least {}", most_output_rows, until / most_output_rows));
  std::vector<double> times;
  const auto rows = static_cast<std::size_t>(std::floor(until / every * (1.0 + 1e-12)));
  for (std::size_t k = 0; k <= rows; ++k) times.push_back(static_cast<double>(k) * every);
  return times;
}

struct FollowedRun::State {
  explicit State(Study given) : study(std::move(given)), run(study) {}

  const Study study;
  AnyMachine run;
};

FollowedRun::FollowedRun(const Study& study) : FollowedRun(study, study.initial) {}

FollowedRun::FollowedRun(const Study& study, const InitialState& start) {
  Study own = study;
  own.initial = start;
  check(own);
  check_overlap(own);
  state_ = std::make_unique<State>(std::move(own));
}

FollowedRun::~FollowedRun() = default;

double FollowedRun::time() const {
  return state_->run.with([](const auto& machine) { return machine.time(); });
}

IntegrationStatus FollowedRun::advance(double until) {
  if (!(until > time())) return IntegrationStatus::done;
  return state_->run.with([&](auto& machine) {
    const IntegrationStatus status = machine.advance(until, [](double, double, auto&&) { return false; });
    if (status == IntegrationStatus::done) machine.enter();
    return status;
  });
}

void FollowedRun::record(Trajectory& out) const {
  equipoise::record(out, study(), time(), state_->run.with([](const auto& machine) { return machine.state(); }));
}

bool FollowedRun::clamped() const {
  return state_->run.with([](const auto& machine) { return machine.clamped(); });
}

const Study& FollowedRun::study() const { return state_->study; }

}  // namespace equipoise
