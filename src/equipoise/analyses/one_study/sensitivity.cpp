// Runs the rows of a pick-freeze design as chunks of starts.
#include "equipoise/analyses/one_study/sensitivity.hpp"

#include <algorithm>
#include <vector>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/ensembles/chunks.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/simulation/kernels/long_call.hpp"

namespace equipoise {

namespace {

class PickFreeze {
 public:
  PickFreeze(const Study& study, const SensitivityOptions& options)
      : options_(options),
        session_(at_random(study), {.threads = thread_count(options.threads), .stop = options.stop}),
        keys_(study.uncertain.values.size() + 1) {
    rows_.inputs = keys_;
  }

  SensitivityResult run(const Study& study) {
    const ChunkWork work{.decide = [&](Chunk& chunk) { return decide(chunk); },
                         .threads = thread_count(options_.threads),
                         .stop = options_.stop};
    take_chunks(work, 0, options_.rows, [&](Chunk& chunk) {
      take(chunk);
      return true;
    });
    result_.rows = rows_.rows();
    result_.evaluations = rows_.outcomes.size();
    result_.partial = result_.rows < options_.rows;
    if (result_.rows > 0) result_.balanced = wilson_share(balanced_, 2 * result_.rows);
    name_indices(study);
    return std::move(result_);
  }

 private:
  static Study at_random(Study study) {
    study.sampling.method = SamplingMethod::random;
    return study;
  }

  // Row i: starts 2 i and 2 i + 1, then the first with one input of the second. The last input is where it begins.
  bool decide(Chunk& chunk) const {
    std::vector<DrawnStart> drawn;
    for (std::uint64_t row = chunk.first; row < chunk.first + chunk.count; ++row) {
      const std::uint64_t a = 2 * row, b = a + 1;
      const std::vector<double> of_a = session_.fractions_of(a), of_b = session_.fractions_of(b);
      drawn.push_back({a, of_a});
      drawn.push_back({b, of_b});
      for (std::size_t k = 0; k < of_a.size(); ++k) {
        drawn.push_back({a, of_a});
        drawn.back().fractions[k] = of_b[k];
      }
      drawn.push_back({b, of_a});
    }
    if (session_.stopped() || !session_.decide(drawn, chunk)) return false;
    for (const UnlistedStart& u : chunk.unlisted)
      if (u.motion && u.motion->stable) chunk.outcomes[u.place].attractor = static_cast<short>(u.name.id);
    return true;
  }

  void take(const Chunk& chunk) {
    for (std::size_t i = 0; i < chunk.outcomes.size(); ++i) {
      const Outcome& outcome = chunk.outcomes[i];
      const bool balanced = outcome.kind == OutcomeKind::attracted && outcome.attractor == balanced_id;
      rows_.outcomes.push_back(balanced ? 1.0 : 0.0);
      if (i % (keys_ + 2) < 2) balanced_ += balanced;
      result_.undecided += outcome.kind == OutcomeKind::undecided;
    }
    if (options_.progress) options_.progress({rows_.rows(), options_.rows, "rows of the sensitivity", {}});
  }

  void name_indices(const Study& study) {
    const std::vector<SobolIndices> indices = sobol_indices(rows_, study.sampling.seed);
    for (std::size_t k = 0; k < indices.size(); ++k) {
      const bool value = k < study.uncertain.values.size();
      result_.inputs.push_back({value ? study.uncertain.values[k].key : start_input, indices[k]});
    }
    std::stable_sort(result_.inputs.begin(), result_.inputs.end(),
                     [](const auto& a, const auto& b) { return a.indices.total.value > b.indices.total.value; });
  }

  const SensitivityOptions& options_;
  const Session session_;
  std::size_t keys_;  // number of inputs
  PickFreezeRows rows_;
  SensitivityResult result_;
  std::uint64_t balanced_ = 0;
};

}  // namespace

void check_sensitivity(const Study& study) {
  if (study.uncertain.empty())
    throw InputError(study.name, "", "",
                     "has no uncertain value; the sensitivity is that to values such as rotor.eccentricity = { uniform "
                     "= [0.005, 0.015] }");
  check_runnable(study, false);
}

SensitivityResult sensitivity(const Study& study, const SensitivityOptions& options) {
  check_sensitivity(study);
  return long_call(options, [&](const SensitivityOptions& o) { return PickFreeze(study, o).run(study); });
}

}  // namespace equipoise
