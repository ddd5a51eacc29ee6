// Checks stored starts by deciding some again; appends starts with their draws.
#include "equipoise/analyses/ensembles/stored_starts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"

namespace equipoise {

namespace {

bool same(const Fate& a, const Fate& b) {
  return a.outcome == b.outcome && a.attractor == b.attractor && a.by == b.by && a.time == b.time;
}

}  // namespace

// A few are enough: where arithmetic differs, most starts' decision times differ too.
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
    const std::vector<Fate> fates = file.read(first, each);
    for (std::size_t i = 0; i < each; ++i)
      if (!same(fates[i], chunk.fates[i]))
        throw InputError(path, "", "",
                         fmt::format("start {}, computed with {}, has another result in this program with {}; must be "
                                     "a new file, or one that this program and instruction set made",
                                     first + i, fmt::join(targets, ", "), target));
  }
}

// A chunk does not carry what its starts drew, which follows from their index, so the file makes the draws again.
void append_starts(BasinFile& file, const Study& study, const Sampler& sampler, const Chunk& chunk,
                   std::pair<std::size_t, std::size_t> part, bool own,
                   const std::function<InitialState(std::uint64_t)>& start_of, const RunTime& so_far) {
  std::vector<double> rotor, phi_dot, psi, weight, drawn;
  for (std::size_t i = part.first; i < part.second; ++i) {
    if (sampler.grid()) weight.push_back(sampler.weight(study.sampling.seed, chunk.first + i));
    for (const double v : drawn_values(study, sampler, study.sampling.seed, chunk.first + i)) drawn.push_back(v);
    if (study.sampling.box.empty() && !own) continue;
    const InitialState s = start_of(chunk.first + i);
    psi.push_back(s.psi);
    rotor.insert(rotor.end(), {s.x, s.y, s.x_dot, s.y_dot});
    phi_dot.insert(phi_dot.end(), s.phi_dot.begin(), s.phi_dot.begin() + study.parameters.balls);
  }
  file.append({.count = part.second - part.first,
               .phi = chunk.phi.data() + part.first * static_cast<std::size_t>(study.parameters.balls),
               .fates = chunk.fates.data() + part.first,
               .rotor = rotor.data(),
               .phi_dot = phi_dot.data(),
               .psi = psi.data(),
               .weight = weight.data(),
               .rows = chunk.row(part.first),
               .drawn = drawn.data()},
              so_far);
}

}  // namespace equipoise
