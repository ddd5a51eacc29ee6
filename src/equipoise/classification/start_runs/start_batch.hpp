// Starts being decided, and what is known of each. Only for the files of StartRunner.
#pragma once

#include <optional>
#include <vector>

#include "equipoise/classification/start_runs/start_runner.hpp"

namespace equipoise {

struct StartRunner::Batch {
  const StartRunner* runner = nullptr;
  SpunUp starts;
  std::vector<FamilyStart> own;   // each start's study if they differ, else empty
  std::vector<std::size_t> cell;  // their cells of the mesh
  bool watched = false;           // transients are gathered, in `table`
  TransientTable table;
  std::vector<Fate> fates;
  std::optional<std::vector<PilotRecord>> records;  // of all starts, if requested
  // Of few starts: what those that were followed look like (`attractor`: their place here), and what they came to.
  std::vector<KnownFeatures> looks;
  std::vector<std::optional<Motion>> came_to;

  const Study& study(std::size_t i) const { return own.empty() ? runner->study_ : own[i].own.study; }
  const model::System& system(std::size_t i) const { return own.empty() ? runner->system_ : starts.rotors[i].system; }
  double end(std::size_t i) const {
    return own.empty() ? runner->source_->settled() + *runner->study_.numerics.horizon : starts.rotors[i].end;
  }
  TransientTable* watched_table() { return watched ? &table : nullptr; }
  const double* state(std::size_t i) const {
    return &starts.states[i * static_cast<std::size_t>(runner->system_.dimension())];
  }
};

}  // namespace equipoise
