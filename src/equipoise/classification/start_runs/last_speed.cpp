// Samples speeds and takes their mean by Simpson's rule.
#include "equipoise/classification/start_runs/last_speed.hpp"

#include <cstddef>

#include "equipoise/results/types/fate.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"

namespace equipoise {

namespace {
// Intervals within last_turns, a quarter turn each. Gravity and anisotropic supports make the speed swing twice a turn
// at most, drifting balls more slowly.
constexpr int watched_parts = 32;
}  // namespace

std::vector<double> mean_speeds_from(BatchTask task, std::vector<double> states, double now,
                                     std::vector<OwnRotor> own) {
  const auto size = static_cast<std::size_t>(task.dimension());
  const auto place = static_cast<std::size_t>(task.layout().speed);
  const std::size_t count = states.size() / size;
  std::vector<double> begins(count, now), mean(count, 0.0);
  const std::vector<const OwnRotor*> rotors = pointers_to(own);
  for (std::size_t i = 0; i < own.size(); ++i) begins[i] = own[i].end;
  const std::vector<double> from = begins;
  if (!own.empty()) task.own = rotors.data();
  task.count = count;
  task.states = states.data();
  task.begins = begins.data();
  task.transients = nullptr;
  task.radius = nullptr;
  std::vector<Fate> fates(count);
  for (int k = 0; k <= watched_parts; ++k) {
    const double weight = k == 0 || k == watched_parts ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
    for (std::size_t i = 0; i < count; ++i) mean[i] += weight / (3.0 * watched_parts) * states[i * size + place];
    if (k == watched_parts) break;
    const double later = last_turns * (k + 1) / watched_parts;
    task.end = now + later;
    for (std::size_t i = 0; i < own.size(); ++i) own[i].end = from[i] + later;
    if (!advance_batch(task, fates)) return {};
    for (std::size_t i = 0; i < count; ++i) begins[i] = from[i] + later;
  }
  return mean;
}

}  // namespace equipoise
