// Figures of starts that are known only once they go on beyond their decision: mean speeds of undecided rotors over
// their last turns, as a long window may still contain the run-up, and the largest r of known motions.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "equipoise/classification/start_runs/batch.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"

namespace equipoise {

namespace {

// Time for eight turns at the critical speed, over which the speed of an undecided start is averaged.
constexpr double last_turns = 50.0;
// Intervals within last_turns, a quarter turn each. Gravity and anisotropic supports make the speed swing twice a turn
// at most, drifting balls more slowly.
constexpr int watched_parts = 32;

// Mean psi' of driven rotors over last_turns, from `states` (a row each) at time `now`. `task` holds their equations,
// `own` their own rotors, each at its end now, or none. A rotor lost on the way has its speed when lost. Empty if
// stopped early.
std::vector<double> mean_speeds_from(BatchTask task, std::vector<double> states, double now,
                                     std::vector<OwnRotor> own) {
  const auto size = static_cast<std::size_t>(task.dimension());
  const auto place = static_cast<std::size_t>(task.layout().speed);
  const std::size_t count = states.size() / size;
  std::vector<double> begins(count, now), mean(count, 0.0);
  const std::vector<const OwnRotor*> rotors = pointers_to(own);
  for (std::size_t i = 0; i < own.size(); ++i) begins[i] = own[i].end;
  const std::vector<double> from = begins;
  task.take(states, rotors, begins);
  std::vector<Outcome> outcomes(count);
  for (int k = 0; k <= watched_parts; ++k) {
    const double weight = k == 0 || k == watched_parts ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
    for (std::size_t i = 0; i < count; ++i) mean[i] += weight / (3.0 * watched_parts) * states[i * size + place];
    if (k == watched_parts) break;
    const double later = last_turns * (k + 1) / watched_parts;
    task.end = now + later;
    for (std::size_t i = 0; i < own.size(); ++i) own[i].end = from[i] + later;
    if (!advance_batch(task, outcomes)) return {};
    for (std::size_t i = 0; i < count; ++i) begins[i] = from[i] + later;
  }
  return mean;
}

// More would cost more than the outcome did. Deviations that last longer leave the figure missing.
constexpr int lengths = 3;
constexpr double agreement = 0.02;
// Peaks of a periodic motion agree to about 1e-5, the error of steps.
constexpr double noise = 1e-4;

// The largest r of the last windows, the latest first.
constexpr std::size_t most_compared = 8, fewest_compared = 4;
using Peaks = std::array<double, most_compared>;

// Relative to the latest.
double spread(const Peaks& p, std::size_t count) {
  const auto [least, most] = std::minmax_element(p.begin(), p.begin() + count);
  return (*most - *least) / p[0];
}

// Of windows of one length. Whether those that differ show a motion that swings, a torus or chaos, or the end of an
// approach.
bool steady(const Peaks& p, int windows) {
  if (windows >= static_cast<int>(fewest_compared) && spread(p, fewest_compared) <= noise) return true;
  if (windows < static_cast<int>(most_compared) || !(spread(p, most_compared) <= agreement)) return false;
  const double d1 = p[2] - p[1], d2 = p[1] - p[0];
  return d1 * d2 <= 0.0 || has_nearly_arrived(d1, d2, agreement * p[0]);
}

struct Followed {
  std::size_t place = 0;
  Peaks peaks{};
};

// A trajectory with a rotor of its own, at the time at which its outcome was known.
struct KnownTrajectory {
  OwnRotor rotor;
  double time = 0.0;
  double window = 0.0;  // long enough to show how it moves: ClassificationRule::first_long_window
};

// The largest r of the motion that each settles into, to 2 %: it is followed, from `states` (a row each), until windows
// of time agree. Not a number if they never do, or if it is lost. `task` holds the equations. Empty if stopped early.
std::vector<float> steady_radii(BatchTask task, std::vector<double> states, std::vector<KnownTrajectory> known) {
  const auto size = static_cast<std::size_t>(task.dimension());
  std::vector<float> radii(known.size(), std::numeric_limits<float>::quiet_NaN());
  std::vector<Followed> open(known.size());
  for (std::size_t i = 0; i < open.size(); ++i) open[i].place = i;
  constexpr int of_a_length = static_cast<int>(most_compared);
  for (int window = 0; window < lengths * of_a_length && !open.empty(); ++window) {
    // Windows that never agree are too short for slow balls: those that follow are twice as long.
    const bool longer = window > 0 && window % of_a_length == 0;
    std::vector<const OwnRotor*> rotors;
    std::vector<double> begins, here;
    for (const Followed& f : open) {
      KnownTrajectory& k = known[f.place];
      begins.push_back(k.time);
      if (longer) k.window *= 2.0;
      k.time += k.window;
      k.rotor.end = k.time;
      rotors.push_back(&k.rotor);
      here.insert(here.end(), &states[f.place * size], &states[f.place * size] + size);
      task.end = std::max(task.end, k.time);
    }
    TransientTable table;
    table.rows.resize(open.size());
    task.transients = &table;
    task.take(here, rotors, begins);
    std::vector<Outcome> outcomes(open.size());
    if (!advance_batch(task, outcomes)) return {};
    std::vector<Followed> still;
    for (std::size_t k = 0; k < open.size(); ++k) {
      Followed f = open[k];
      std::copy_n(&here[k * size], size, &states[f.place * size]);
      if (outcomes[k].kind == OutcomeKind::diverged || outcomes[k].kind == OutcomeKind::failed) continue;
      std::rotate(f.peaks.begin(), f.peaks.end() - 1, f.peaks.end());
      f.peaks[0] = std::sqrt(table.rows[k].free_peak.square);
      if (steady(f.peaks, window % of_a_length + 1))
        radii[f.place] = static_cast<float>(*std::max_element(f.peaks.begin(), f.peaks.begin() + fewest_compared));
      else
        still.push_back(f);
    }
    open = std::move(still);
  }
  return radii;
}

// Less is a rotor that rests on its axis.
constexpr double no_radius = 1e-9;

}  // namespace

// Means are for starts left open at the horizon. One given up earlier runs away, so its last speed counts.
bool Session::Batch::note_last_speeds() {
  if (s_.system_.prescribed()) return true;
  const std::size_t size = s_.system_.dimension();
  const BatchTask task = s_.source_->last_task();
  std::vector<std::size_t> places;
  std::vector<double> states;
  std::vector<OwnRotor> own;
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    Outcome& outcome = outcomes_[i];
    if (outcome.kind != OutcomeKind::undecided || starts_.is_over(i)) continue;
    outcome.mean_speed = static_cast<float>(state(i)[task.layout().speed]);
    if (!is_left(i)) continue;
    places.push_back(i);
    states.insert(states.end(), state(i), state(i) + size);
    if (!own_.empty()) own.push_back(starts_.rotors[i]);
  }
  if (places.empty()) return true;
  const std::vector<double> speeds = mean_speeds_from(task, std::move(states), horizon(), std::move(own));
  for (std::size_t k = 0; k < speeds.size(); ++k) outcomes_[places[k]].mean_speed = static_cast<float>(speeds[k]);
  return !speeds.empty();
}

// Of listed motions, which other rotors of the family have shown. A start that is followed to its motion has that
// one's.
bool Session::Batch::note_radii() {
  if (!s_.measures_radii_) return true;
  const std::size_t size = s_.system_.dimension();
  std::vector<std::size_t> places;
  std::vector<double> states;
  std::vector<KnownTrajectory> known;
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    Outcome& outcome = outcomes_[i];
    if (outcome.kind != OutcomeKind::attracted || outcome.attractor <= 0 || starts_.is_over(i)) continue;
    if (s_.catalogue().find(outcome.attractor)->motion.r_max < no_radius) {
      outcome.radius = 0.0f;
      continue;
    }
    places.push_back(i);
    states.insert(states.end(), state(i), state(i) + size);
    known.push_back({starts_.rotors[i], outcome.time, cell(i).search.rule.first_long_window});
  }
  if (places.empty()) return true;
  const std::vector<float> radii = steady_radii(s_.source_->last_task(), std::move(states), std::move(known));
  for (std::size_t k = 0; k < radii.size(); ++k) outcomes_[places[k]].radius = radii[k];
  return !radii.empty();
}

}  // namespace equipoise
