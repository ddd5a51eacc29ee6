// An even grid of output times.
#include "equipoise/simulation/trajectory/output_times.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/simulation/words/runs.hpp"

namespace equipoise {

std::vector<double> output_times(const Study& study, std::optional<double> asked_until,
                                 std::optional<double> asked_every) {
  check(study);
  const auto reject = [](const char* key, double value, const std::string& problem) {
    throw InputError("output times", key, fmt::format("{}", value), problem);
  };
  const model::Drive drive = study.drive();
  const double last_branch = std::max(drive.pieces.back().begin, study.speed.driven() ? 0.0 : drive.release_time);
  const double until = asked_until.value_or(last_branch + 100.0);
  if (!(until >= 0.0 && until <= last_output_time)) reject("until", until, words::runs::time_range);
  const double every = asked_every.value_or(until > 0.0 ? until / 100.0 : 1.0);
  if (!(every > 0.0 && every <= last_output_time)) reject("every", every, words::runs::step_range);
  if (until / every > most_output_rows)
    reject("every", every, fmt::format(words::runs::too_many_rows, most_output_rows, until / most_output_rows));
  std::vector<double> times;
  const auto rows = static_cast<std::size_t>(std::floor(until / every * (1.0 + 1e-12)));
  for (std::size_t k = 0; k <= rows; ++k) times.push_back(static_cast<double>(k) * every);
  return times;
}

}  // namespace equipoise
