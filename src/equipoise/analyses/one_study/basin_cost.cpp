// Times an attractor search and some hundred starts.
#include "equipoise/analyses/one_study/basin_cost.hpp"

#include <algorithm>

#include "equipoise/analyses/ensembles/ensemble_runner.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/core/running/deadline.hpp"
#include "equipoise/core/running/run_info.hpp"
#include "equipoise/simulation/kernels/long_call.hpp"

namespace equipoise {

namespace {

// At first as many starts as a block of lanes takes at once. A few undecided starts may cost more than all others, so
// the number then grows until shares of one in a thousand are met.
constexpr std::uint64_t first_starts = 512, most_starts = 8192;
constexpr double enough = 0.5;  // seconds of CPU on starts

}  // namespace

BasinCost measure_cost(const Study& asked, const RunOptions& options, double patience) {
  return long_call(options, [&](const RunOptions& o) {
    const bool gathers = gathers_transients(asked, {});
    check_runnable(asked, gathers);
    const Study study = as_sampled(asked);
    BasinCost cost;
    cost.starts = study.sampling.starts;
    StopFlag stop{is_set(o.stop)};
    const Deadline deadline(stop, patience);
    const double begin = cpu_seconds();
    const Session session(study, {.threads = 1, .stop = &stop, .progress = o.progress}, gathers);
    cost.search = cpu_seconds() - begin;
    cost.search_ended = !session.stopped();
    const double searched = cpu_seconds();
    for (std::uint64_t next = first_starts; cost.search_ended && cost.measured < std::min(cost.starts, most_starts);) {
      const std::uint64_t count = std::min(next, std::min(cost.starts, most_starts) - cost.measured);
      Decided decided;
      if (!session.decide(cost.measured, count, decided)) break;
      cost.measured += count;
      const double taken = cpu_seconds() - searched;
      cost.a_start = taken / static_cast<double>(cost.measured);
      if (taken > enough) break;
      next = cost.measured;
    }
    return cost;
  });
}

}  // namespace equipoise
