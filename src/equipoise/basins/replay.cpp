// One start of an ensemble decided alone.
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "equipoise/basins/basin.hpp"
#include "equipoise/fates/runner.hpp"
#include "equipoise/spin_up/initial_state.hpp"

namespace equipoise {

StartReplay replay_start(const Study& study, std::uint64_t index, const BasinOptions& options) {
  check_runnable(study);
  const Sampler sampler = sampler_of(study);
  if (sampler.grid() && index >= sampler.grid()->starts())
    throw InputError(study.name, "start index", fmt::format("{}", index),
                     fmt::format("must be below {}, the starts of this grid", sampler.grid()->starts()));
  const std::unique_ptr<Runner> runner = make_runner(
      study, {thread_count(options.threads), options.stop, options.seeds, options.discoveries}, options.transients);
  std::vector<double> phi;
  std::vector<Fate> fates;
  std::vector<UnlistedStart> unlisted;
  std::vector<TransientRow> rows;
  StartReplay replay;
  replay.index = index;
  if (runner->stopped() || !runner->run(index, 1, phi, fates, unlisted, options.transients ? &rows : nullptr))
    throw RunError("stopped before the start was decided");
  replay.start = start_of(study, study.sampling.seed, index);
  replay.fate = fates.front();
  if (!rows.empty()) replay.transients = rows.front();
  if (!unlisted.empty()) settle(*runner, unlisted.front(), replay.fate);
  if (const Attractor* a = runner->catalogue().find(replay.fate.attractor)) replay.name = a->name;
  return replay;
}

}  // namespace equipoise
