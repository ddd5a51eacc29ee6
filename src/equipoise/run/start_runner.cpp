// One study's starts, from index to fate.
#include "equipoise/run/start_runner.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "equipoise/attractors/pilot.hpp"
#include "equipoise/ensemble/lane_task.hpp"
#include "equipoise/ensemble/starts.hpp"
#include "equipoise/run/initial_state.hpp"
#include "equipoise/run/lane_kernels.hpp"

namespace equipoise {

namespace {

// Pilot starts are drawn from a seed of their own, so the decision rule depends on the study but not on its seed. A
// motion that 2048 starts miss is still decided by stationarity, only later.
constexpr std::uint64_t pilot_seed = 0x9e3779b97f4a7c15;
constexpr std::size_t pilot_starts = 2048, pilot_chunk = 256;
// Long windows end at 1, 2, 4, 8 and 16 times the first: four comparisons, of which two in a
// row must agree.
constexpr double pilot_windows = 16.0;

DecisionRule rule_for(const Study& study, const BalancedAnalysis& balanced, double final_speed) {
  DecisionRule rule;
  rule.balls = study.parameters.balls;
  rule.interchangeable = study.parameters.equal_balls();
  rule.traps = balanced.traps;
  rule.family = balanced.family;
  // Slow rotors move slowly: a window holds several revolutions of every motion met between 1.4 and 6.5 critical
  // speeds.
  rule.window = std::max(16.0, 32.0 / std::max(std::fabs(final_speed), 0.1));
  rule.first_long_window = std::max(100.0, 6.0 * rule.window);
  if (balanced.slowest_rate < 0.0) {
    // Long enough that whatever is only on its slow way to balance shrinks visibly from one window to the next.
    rule.first_long_window = std::max(rule.first_long_window, 1.0 / -balanced.slowest_rate);
    rule.first_long_window = std::min(rule.first_long_window, study.numerics.horizon / 8.0);
    rule.sameness = std::min(rule.sameness, 0.2 * -balanced.slowest_rate * rule.first_long_window);
  }
  return rule;
}

}  // namespace

void check_decidable(const Study& study) {
  check(study);
  const model::Parameters& p = study.parameters;
  if (!p.isotropic()) {
    const bool stiffness = p.stiffness[0] != p.stiffness[1];
    const auto& v = stiffness ? p.stiffness : p.damping;
    throw InputError(study.name, stiffness ? "rotor.stiffness" : "rotor.damping", fmt::format("[{}, {}]", v[0], v[1]),
                     "basins need equal values in x and y (simulate takes both)");
  }
  if (p.gravity != 0.0)
    throw InputError(study.name, "rotor.gravity", fmt::format("{}", p.gravity),
                     "basins need gravity 0 (simulate takes any)");
}

StartRunner::StartRunner(const Study& study, int threads, const StopFlag* stop)
    : study_(study), stop_(stop), tolerance_(study.numerics.tolerance.value_or(default_basin_tolerance)) {
  segments_ = model::segments(study.speed_profile(), study.release_time());
  while (segments_[first_free_].clamped) ++first_free_;
  if (first_free_ > 0) {
    double z[max_dimension];
    initial_state(study, segments_.front().speed, study.initial.phi.data(), z);
    // The spin-up is shared by all starts, so its accuracy costs nothing: as tight as a single trajectory's.
    const auto status =
        integrate_clamped(study.parameters, segments_, {z[0], z[1], z[2], z[3]}, default_simulate_tolerance, basis_);
    if (status != IntegrationStatus::done) throw RunError("the clamped spin-up could not be integrated");
  }
  const double final_speed = segments_.back().speed;
  balanced_ = analyse_balanced(study.parameters, final_speed);
  rule_ = rule_for(study, balanced_, final_speed);
  run_pilot(threads);
}

void StartRunner::run_pilot(int threads) {
  std::vector<PilotRecord> records(pilot_starts);
  const double horizon = std::min(study_.numerics.horizon, pilot_windows * rule_.first_long_window);
  std::atomic<bool> complete{true};
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, pilot_starts / pilot_chunk, [&](std::size_t chunk) {
      std::vector<double> phi;
      std::vector<Fate> fates;
      std::vector<PilotRecord> part(pilot_chunk);
      if (!run_seeded(pilot_seed, chunk * pilot_chunk, pilot_chunk, horizon, phi, fates, &part)) complete = false;
      std::copy(part.begin(), part.end(), records.begin() + static_cast<std::ptrdiff_t>(chunk * pilot_chunk));
    });
  });
  stopped_ = !complete;
  rule_.boxes = boxes_from_pilot(records, rule_);
}

bool StartRunner::run(std::uint64_t first, std::size_t count, std::vector<double>& phi,
                      std::vector<Fate>& fates) const {
  return run_seeded(study_.sampling.seed, first, count, study_.numerics.horizon, phi, fates, nullptr);
}

bool StartRunner::run_seeded(std::uint64_t seed, std::uint64_t first, std::size_t count, double horizon,
                             std::vector<double>& phi, std::vector<Fate>& fates,
                             std::vector<PilotRecord>* pilot) const {
  const model::Parameters& p = study_.parameters;
  const std::size_t n = static_cast<std::size_t>(p.balls), size = model::dimension(p.balls);
  std::vector<double> states(count * size);
  phi.resize(count * n);
  fates.assign(count, Fate{});
  for (std::size_t i = 0; i < count; ++i) {
    start_angles(seed, first + i, p.balls, &phi[i * n]);
    initial_state(study_, segments_.front().speed, &phi[i * n], &states[i * size]);
    if (first_free_ > 0) basis_.centre(p, &phi[i * n], &states[i * size]);
  }

  LaneTask task;
  task.parameters = &p;
  task.tolerance = tolerance_;
  task.count = count;
  task.states = states.data();
  task.stop = stop_;
  for (std::size_t k = first_free_; k + 1 < segments_.size(); ++k) {
    task.segment = segments_[k];
    task.end = segments_[k].end;
    if (!advance_lanes(task, fates)) return false;
    const double jump = segments_[k + 1].speed - segments_[k].speed_at(segments_[k].end);
    for (std::size_t i = 0; i < count; ++i) apply_speed_jump(jump, &states[i * size]);
  }
  task.segment = segments_.back();
  task.end = task.segment.begin + horizon;
  std::vector<Fate> decided(count);
  if (!decide_lanes(task, rule_, decided, pilot)) return false;
  for (std::size_t i = 0; i < count; ++i)  // a trajectory lost on an earlier branch stays lost
    if (fates[i].outcome == Outcome::undecided) fates[i] = decided[i];
  return true;
}

}  // namespace equipoise
