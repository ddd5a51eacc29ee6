// Checks stored starts by deciding some again; appends starts with their draws.
#include "equipoise/analyses/ensembles/stored_starts.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/analyses/ensembles/start_arrays.hpp"
#include "equipoise/core/base/error.hpp"

namespace equipoise {

namespace {

bool same(const Outcome& a, const Outcome& b) {
  return a.kind == b.kind && a.attractor == b.attractor && a.by == b.by && a.time == b.time;
}

}  // namespace

// A few are enough: if arithmetic differs, so do most starts' decision times.
void check_stored(const BasinFile& file, const std::string& path, std::uint64_t stored, const std::string& target,
                  const std::function<bool(Chunk&)>& decide) {
  const auto& targets = file.cpu_targets();
  const bool known = std::find(targets.begin(), targets.end(), target) != targets.end();
  const std::uint64_t each = std::min<std::uint64_t>(known ? 4 : 64, stored);
  for (const std::uint64_t first : {std::uint64_t{0}, stored - each}) {
    Chunk chunk;
    chunk.first = first;
    chunk.count = each;
    if (!decide(chunk)) return;
    const StartArrays starts = file.read(first, each);
    for (std::size_t i = 0; i < each; ++i)
      if (!same(*outcome_of(starts, i), chunk.outcomes[i]))
        throw InputError(path, "", "",
                         fmt::format("start {}, computed with {}, has another result in this program with {}; must be "
                                     "a new file, or one that this program and instruction set made",
                                     first + i, fmt::join(targets, ", "), target));
  }
}

void append_starts(BasinFile& file, const Study& study, const Sampler& sampler, const Chunk& chunk,
                   std::pair<std::size_t, std::size_t> part, bool own,
                   const std::function<InitialState(std::uint64_t)>& start_of, const RunTime& so_far) {
  const bool whole = own || !study.sampling.box.empty();
  const auto balls = static_cast<std::size_t>(study.parameters.balls);
  StartArrays starts;
  for (std::size_t i = part.first; i < part.second; ++i) {
    InitialState s = whole ? start_of(chunk.first + i) : InitialState{};
    std::copy_n(chunk.phi.data() + i * balls, balls, s.phi.begin());
    add_start(study, sampler, chunk.first + i, s, own, chunk.outcomes[i], chunk.row(i), starts);
  }
  file.append(starts, so_far);
}

}  // namespace equipoise
