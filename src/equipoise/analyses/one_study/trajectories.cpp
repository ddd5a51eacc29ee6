// Starts are taken from one output time to the next together, on lanes if the lanes have the equations.
#include "equipoise/analyses/one_study/trajectories.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/machine/model/state_layout.hpp"
#include "equipoise/simulation/integrate/clamped.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/kernels/long_call.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "equipoise/simulation/spin_up/start_source.hpp"
#include "equipoise/simulation/trajectory/record.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"

namespace equipoise {

namespace {

// Enough that lanes seldom wait for the last trajectory of a block.
constexpr std::size_t at_once = 256;

bool runs_on_lanes(const Study& study) {
  const model::System system = study.system();
  const bool held_beside_tilt = study.parameters.tilts() && study.release_time() > 0.0;
  return study.parameters.balls > 0 && system.smooth() && system.prescribed() && !held_beside_tilt;
}

// With the tolerance of simulate().
Study as_simulated(Study study) {
  study.numerics.tolerance = study.numerics.tolerance.value_or(default_simulate_tolerance);
  return study;
}

// What the starts of a smooth rotor at a prescribed speed share.
class Lanes {
 public:
  Lanes(const Study& study, const std::vector<double>& times, const StopFlag* stop)
      : study_(study), times_(times), source_(study, stop) {
    if (source_.first_free() == 0) return;
    std::vector<double> z(model::dimension(study.parameters.balls));
    initial_state(study.initial, study.parameters.balls, source_.segments().front().speed, z.data());
    ClampedBasis end;
    const auto keep = [&](double t, const model::Segment& segment, const ClampedBasis& basis) {
      held_.push_back({t, segment, basis});
    };
    integrate_clamped(study.parameters, source_.segments(), {z[0], z[1], z[2], z[3]}, *study.numerics.tolerance, end,
                      times, keep, times.empty() ? 0.0 : times.back(), stop);
  }

  // False if stopped early.
  bool follow(std::span<const InitialState> starts, std::span<Trajectory> runs) const {
    for (const Held& held : held_)
      for (std::size_t i = 0; i < starts.size(); ++i) record_held(runs[i], held, starts[i]);
    return Block(*this, starts, runs).follow(held_.size());
  }

 private:
  struct Held {
    double t;
    model::Segment segment;
    ClampedBasis basis;
  };

  // The starts of a block that are not lost.
  class Block {
   public:
    Block(const Lanes& lanes, std::span<const InitialState> starts, std::span<Trajectory> runs)
        : l_(lanes), runs_(runs), place_(starts.size()) {
      std::iota(place_.begin(), place_.end(), std::size_t{0});
      l_.source_.release(starts, states_);
    }

    // From output time `next` on.
    bool follow(std::size_t next) {
      const std::vector<model::Segment>& segments = l_.source_.segments();
      for (std::size_t k = l_.source_.first_free(); next < l_.times_.size(); ++k) {
        const bool last = k + 1 == segments.size();
        double now = segments[k].begin;
        for (; next < l_.times_.size() && (last || l_.times_[next] < segments[k].end); ++next) {
          if (!advance(k, now, l_.times_[next])) return false;
          now = l_.times_[next];
          record_all(segments[k], now);
        }
        if (last || next == l_.times_.size()) break;
        if (!advance(k, now, segments[k].end)) return false;
        l_.source_.cross(k, states_);
      }
      return true;
    }

   private:
    bool advance(std::size_t segment, double from, double to) {
      if (!(from < to) || place_.empty()) return true;
      BatchTask task = l_.source_.task(segment, states_);
      const std::vector<double> begins(place_.size(), from);
      task.begins = begins.data();
      task.end = to;
      std::vector<Outcome> outcomes(place_.size());
      if (!advance_batch(task, outcomes)) return false;
      drop_lost(outcomes);
      return true;
    }

    void drop_lost(const std::vector<Outcome>& outcomes) {
      const std::size_t size = states_.size() / place_.size();
      std::size_t kept = 0;
      for (std::size_t i = 0; i < place_.size(); ++i) {
        if (outcomes[i].kind == OutcomeKind::diverged || outcomes[i].kind == OutcomeKind::failed) {
          runs_[place_[i]].status =
              outcomes[i].kind == OutcomeKind::diverged ? IntegrationStatus::diverged : IntegrationStatus::failed;
          continue;
        }
        std::copy_n(&states_[i * size], size, &states_[kept * size]);
        place_[kept++] = place_[i];
      }
      place_.resize(kept);
      states_.resize(kept * size);
    }

    void record_all(const model::Segment& segment, double t) {
      const model::StateLayout machine = model::machine_layout(l_.study_.parameters);
      const model::StateLayout layout = l_.source_.last_task().layout();
      std::vector<double> z(static_cast<std::size_t>(machine.size));
      for (std::size_t i = 0; i < place_.size(); ++i) {
        model::copy_state(layout, &states_[i * static_cast<std::size_t>(layout.size)], machine, z.data());
        z[machine.psi] = segment.psi_at(t);
        z[machine.speed] = segment.speed_at(t);
        record(runs_[place_[i]], l_.study_, t, z.data());
      }
    }

    const Lanes& l_;
    std::span<Trajectory> runs_;
    std::vector<std::size_t> place_;
    std::vector<double> states_;
  };

  void record_held(Trajectory& run, const Held& held, const InitialState& start) const {
    const int balls = study_.parameters.balls;
    std::vector<double> z(model::dimension(balls));
    initial_state(start, balls, 0.0, z.data());
    held.basis.centre(study_.parameters, start.phi.data(), z.data());
    record(run, study_.parameters, held.segment.psi_at(held.t), held.segment.speed_at(held.t), held.t, z.data());
  }

  const Study& study_;
  const std::vector<double>& times_;
  const StartSource source_;
  std::vector<Held> held_;  // at the output times before the release
};

Trajectory without_rows(const Study& study) {
  Trajectory run;
  run.tilts = study.parameters.tilts();
  run.phi.resize(study.parameters.balls);
  run.phi_dot.resize(study.parameters.balls);
  if (!run.tilts) return run;
  run.bearing_radial.resize(study.bearings.size());
  run.bearing_force.resize(study.each_bearing().size());
  return run;
}

Trajectories followed(const Study& study, std::span<const InitialState> starts, const std::vector<double>& times,
                      const RunOptions& options) {
  Trajectories result{times, std::vector<Trajectory>(starts.size(), without_rows(study)), false};
  const std::vector<InitialState> given = parted(study.parameters, starts);
  std::optional<Lanes> lanes;
  if (runs_on_lanes(study)) lanes.emplace(study, times, options.stop);
  const std::size_t block = lanes ? at_once : 1;
  std::atomic<std::size_t> done{0};
  in_parallel(thread_count(options.threads), (starts.size() + block - 1) / block, [&](std::size_t b) {
    if (is_set(options.stop)) return;
    const std::size_t first = b * block, count = std::min(block, starts.size() - first);
    if (lanes) {
      lanes->follow(std::span(given).subspan(first, count), std::span(result.runs).subspan(first, count));
    } else {
      Study own = study;
      own.initial = given[first];
      RunOptions alone;
      alone.stop = options.stop;
      result.runs[first] = simulate(own, times, alone);
    }
    const std::size_t now = done += count;
    if (options.progress) options.progress({now, starts.size(), "trajectories", {}});
  });
  result.stopped = is_set(options.stop);
  return result;
}

}  // namespace

Trajectories simulate(const Study& study, std::span<const InitialState> starts, const std::vector<double>& times,
                      const RunOptions& options) {
  check(study);
  check_output_times(times);
  check_given_starts(study, starts);
  const Study tight = as_simulated(study);
  return long_call(options, [&](const RunOptions& o) { return followed(tight, starts, times, o); });
}

std::vector<InitialState> drawn_starts(const Study& study) {
  return starts_of(study, sampler_of(study), study.sampling.seed, 0, study.sampling.starts);
}

}  // namespace equipoise
