// Chooses two starts, follows them and the bare rotor, and reduces each run to time stretches a pixel or two wide.
#include "equipoise/report/shown/shown_runs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/simulation/spin_up/held_run.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"

namespace equipoise {

namespace {

constexpr double run_tolerance = 1e-10;
constexpr std::size_t stretches = 480;
constexpr double longest_run = 20000.0;  // undecided starts have no end
constexpr double most_looks = 60000.0;

double weight_of(const StartArrays& starts, std::size_t i) { return starts.weight.empty() ? 1.0 : starts.weight[i]; }

double last_branch(const Study& study) {
  const model::Drive drive = study.drive();
  const double release = std::isfinite(drive.release_time) ? drive.release_time : 0.0;
  return std::max(drive.pieces.back().begin, release);
}

// Sixteen samples per turn at the final speed show the largest displacement to 2 %.
double look_step(const Study& study, double until) {
  const double pace = std::max(1.0, std::fabs(study.system().pace()));
  return std::max(two_pi / (16.0 * pace), until / most_looks);
}

// Time from which a figure stays below `level`.
double below_from(const std::vector<double>& t, const std::vector<double>& figure, double level) {
  std::size_t k = t.size() - 1;
  while (k > 0 && figure[k - 1] <= level) --k;
  return t[k];
}

// Time from which the run is steady. The displacement has come within a fiftieth of the way from its peak to its range
// in the last tenth of the run, and the speed within a twentieth of its final value.
double steady_from(const Trajectory& run) {
  const std::size_t n = run.t.size();
  if (n < 2) return 0.0;
  const auto last_tenth = run.radial.begin() + static_cast<std::ptrdiff_t>(n - 1 - n / 10);
  const double end = *std::max_element(last_tenth, run.radial.end());
  const double peak = *std::max_element(run.radial.begin(), run.radial.end());
  std::vector<double> missing;
  for (const double speed : run.psi_dot) missing.push_back(std::fabs(speed - run.psi_dot.back()));
  return std::max(below_from(run.t, run.radial, end + 0.02 * (peak - end)),
                  below_from(run.t, missing, 0.05 * std::fabs(run.psi_dot.back())));
}

ShownRun reduced(const Trajectory& run) {
  ShownRun shown;
  const std::size_t n = run.t.size(), each = std::max<std::size_t>(1, n / stretches);
  for (std::size_t first = 0; first < n; first += each) {
    const std::size_t end = std::min(n, first + each);
    const auto [low, high] = std::minmax_element(run.radial.begin() + static_cast<std::ptrdiff_t>(first),
                                                 run.radial.begin() + static_cast<std::ptrdiff_t>(end));
    shown.t.push_back(0.5 * (run.t[first] + run.t[end - 1]));
    shown.r_low.push_back(*low);
    shown.r_high.push_back(*high);
    const auto speeds = run.psi_dot.begin();
    shown.speed.push_back(
        std::accumulate(speeds + static_cast<std::ptrdiff_t>(first), speeds + static_cast<std::ptrdiff_t>(end), 0.0) /
        static_cast<double>(end - first));
    shown.again = std::max(shown.again, *high);
  }
  const auto last_tenth = shown.r_high.end() - static_cast<std::ptrdiff_t>((shown.r_high.size() + 9) / 10);
  shown.at_end = *std::max_element(last_tenth, shown.r_high.end());
  return shown;
}

// The study of one start, with what it draws.
Study study_of_start(const Study& study, std::uint64_t index) {
  if (study.parameters.balls == 0) return study;
  Study one = study.uncertain.empty()
                  ? study
                  : drawn_study(study, drawn_values(study, sampler_of(study), study.sampling.seed, index));
  one.initial = start_of(study, index);
  return one;
}

Trajectory followed(Study study, double until, double step, const StopFlag* stop) {
  study.numerics.tolerance = run_tolerance;
  std::vector<double> times;
  const auto count = static_cast<std::size_t>(std::ceil(until / step));
  for (std::size_t k = 0; k <= count; ++k) times.push_back(static_cast<double>(k) * step);
  RunOptions options;
  options.stop = stop;
  Trajectory run = simulate(study, times, options);
  // Of a tilting rotor, displacements are those at its bearings.
  if (!run.bearing_radial.empty()) run.radial = run.bearing_radial.front();
  for (const std::vector<double>& radial : run.bearing_radial)
    for (std::size_t k = 0; k < run.radial.size(); ++k) run.radial[k] = std::max(run.radial[k], radial[k]);
  return run;
}

}  // namespace

std::vector<std::uint64_t> median_and_worst(const StartArrays& starts) {
  const std::vector<float>& peak = *starts.transient("peak_radial");
  std::vector<std::uint64_t> order;
  double all = 0.0;
  for (std::size_t i = 0; i < peak.size(); ++i) {
    if (!std::isfinite(peak[i])) continue;
    order.push_back(i);
    all += weight_of(starts, i);
  }
  if (order.empty()) return {};
  std::sort(order.begin(), order.end(),
            [&](std::uint64_t a, std::uint64_t b) { return peak[a] != peak[b] ? peak[a] < peak[b] : a < b; });
  // As a summary gives quantiles (core/statistics/quantile.hpp).
  const auto at = [&](double share) {
    const double wanted = share * all * (1.0 - 1e-12);
    double below = 0.0;
    for (const std::uint64_t i : order)
      if ((below += weight_of(starts, i)) >= wanted) return i;
    return order.back();
  };
  const std::uint64_t median = at(0.5), worst = at(0.99);
  return median == worst ? std::vector{median} : std::vector{median, worst};
}

Trajectory start_run(const Study& study, std::uint64_t index, double until, double step, const StopFlag* stop) {
  return followed(study_of_start(study, index), until, step, stop);
}

Trajectory bare_run(const Study& study, std::uint64_t index, double until, double step, const StopFlag* stop) {
  Study one = study_of_start(study, index);
  InitialState start = one.initial;
  take_balls_off(one, start);
  one.initial = start;
  one.parameters.balls = 0;
  return followed(std::move(one), until, step, stop);
}

std::vector<ShownRun> shown_runs(const Study& study, const StartArrays& starts,
                                 const std::vector<std::uint64_t>& indices, const StopFlag* stop) {
  const std::vector<float>& end_of = *starts.transient("followed_until");
  const std::vector<float>& peak = *starts.transient("peak_radial");
  const double begin = last_branch(study);
  constexpr double least = 30.0, margin = 1.25, longest_alone = 1000.0, longest_beside = 1.5;
  double until = std::max(least, 1.05 * begin);
  for (const std::uint64_t i : indices) {
    const double end = std::clamp(static_cast<double>(end_of[i]), until, begin + longest_run);
    until = std::max(until, std::min(end, margin * steady_from(start_run(study, i, end, look_step(study, end), stop))));
  }
  // Whose rotor is shown without balls.
  const std::uint64_t rotor = indices.empty() ? 0 : indices.front();
  const double end = indices.empty() ? until + longest_alone : longest_beside * until;
  until =
      std::max(until, std::min(end, margin * steady_from(bare_run(study, rotor, end, look_step(study, end), stop))));
  std::vector<ShownRun> runs;
  const auto add = [&](const Trajectory& run, RunOf of, std::uint64_t index) {
    if (run.stopped || run.t.size() < 2) return false;
    runs.push_back(reduced(run));
    runs.back().of = of;
    runs.back().index = index;
    return true;
  };
  const double step = look_step(study, until);
  if (add(bare_run(study, rotor, until, step, stop), RunOf::bare, rotor)) runs.back().peak = runs.back().again;
  for (const std::uint64_t i : indices) {
    const RunOf of = i == indices.front() ? RunOf::median : RunOf::worst_in_hundred;
    if (!add(start_run(study, i, until, step, stop), of, i)) continue;
    runs.back().code = starts.outcome[i];
    runs.back().peak = peak[i];
  }
  return runs;
}

}  // namespace equipoise
