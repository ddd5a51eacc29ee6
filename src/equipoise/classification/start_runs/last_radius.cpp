// Follows all trajectories window by window, and leaves out those that are steady.
#include "equipoise/classification/start_runs/last_radius.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "equipoise/results/types/fate.hpp"
#include "equipoise/results/types/transient_table.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"

namespace equipoise {

namespace {

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

}  // namespace

std::vector<float> steady_radii(BatchTask task, std::vector<double> states, std::vector<KnownTrajectory> known) {
  const auto size = static_cast<std::size_t>(task.dimension());
  std::vector<float> radii(known.size(), std::numeric_limits<float>::quiet_NaN());
  std::vector<Followed> open(known.size());
  for (std::size_t i = 0; i < open.size(); ++i) open[i].place = i;
  task.transients = nullptr;
  task.radius = nullptr;
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
    task.count = open.size();
    task.states = here.data();
    task.begins = begins.data();
    task.own = rotors.data();
    std::vector<Fate> fates(open.size());
    if (!advance_batch(task, fates)) return {};
    std::vector<Followed> still;
    for (std::size_t k = 0; k < open.size(); ++k) {
      Followed f = open[k];
      std::copy_n(&here[k * size], size, &states[f.place * size]);
      if (fates[k].outcome == Outcome::diverged || fates[k].outcome == Outcome::failed) continue;
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

}  // namespace equipoise
