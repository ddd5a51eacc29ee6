// Pilot starts on lanes.
#include "equipoise/discovery/pilot_run.hpp"

#include <algorithm>
#include <atomic>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "equipoise/base/angles.hpp"
#include "equipoise/kernels/lane_kernels.hpp"
#include "equipoise/orbits/stroboscopic.hpp"

namespace equipoise {

namespace {

// Pilot starts are drawn from a seed of their own, so the decision rule depends on the study but not on its seed.
constexpr std::uint64_t pilot_seed = 0x9e3779b97f4a7c15;
constexpr std::size_t chunk = 256;

}  // namespace

bool PilotRun::make() {
  const int balls = system_.balls();
  std::vector<double> phi, states;
  std::vector<Fate> fates;
  const auto append = [&] { begin_.insert(begin_.end(), states.begin(), states.end()); };
  if (!source_.make(pilot_seed, 0, random_scouts, phi, states, fates)) return false;
  append();
  phi.clear();
  for (std::size_t k = 0; k < coincident_scouts; ++k)
    phi.insert(phi.end(), balls, two_pi * static_cast<double>(k) / coincident_scouts);
  if (!source_.follow(phi, states, fates)) return false;
  append();
  if (!source_.make(pilot_seed, random_scouts, random_starts - random_scouts, phi, states, fates)) return false;
  append();
  fates_.resize(begin_.size() / system_.dimension());
  records_.resize(fates_.size());
  return true;
}

bool PilotRun::follow(std::size_t count, const DecisionRule& rule, double horizon, int threads, const StopFlag* stop,
                      StageProgress& stages) {
  const int size = system_.dimension();
  followed_ = count;
  states_ = begin_;
  std::atomic<bool> complete{true};
  stages.begin("pilot trajectories", count);
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, (count + chunk - 1) / chunk, [&](std::size_t k) {
      const std::size_t first = k * chunk, length = std::min(chunk, count - first);
      LaneTask task;
      task.parameters = &system_.parameters();
      task.segment = source_.last_segment();
      task.end = task.segment.begin + horizon;
      task.tolerance = source_.tolerance();
      task.count = length;
      task.states = &states_[first * size];
      task.stop = stop;
      std::vector<Fate> fates(length);
      std::vector<PilotRecord> records(length);
      if (decide_lanes(task, rule, fates, &records))
        stages.add(length);
      else
        complete = false;
      std::copy(fates.begin(), fates.end(), fates_.begin() + static_cast<std::ptrdiff_t>(first));
      std::copy(records.begin(), records.end(), records_.begin() + static_cast<std::ptrdiff_t>(first));
    });
  });
  return complete;
}

Eigen::Map<const Eigen::VectorXd> PilotRun::state(std::size_t i) const {
  const int size = system_.dimension();
  return {&states_[i * size], size};
}

Eigen::VectorXd PilotRun::state_at_strobe(std::size_t i) const {
  return at_next_strobe(system_, state(i), source_.last_segment().psi_at(fates_[i].time)).value_or(state(i));
}

}  // namespace equipoise
