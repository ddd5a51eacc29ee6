// The tables computed again and judged, under either speed law.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/core/statistics/comparison.hpp"
#include "equipoise/extras/literature/published_tables.hpp"
#include "equipoise/results/commands/basin_result.hpp"

namespace equipoise {

/// One row's starts under one law.
struct EnsembleResult : BasinResult {  ///< its times are those of all runs
  std::vector<bool> balanced;          ///< start by start, for comparisons on common starts
  /// Share of the attractor that the paper calls by this name ("balanced", "V1"); of no starts if it was not met.
  Share share_of(const std::string& attractor) const;
};

enum class Verdict { agrees, differs, not_comparable };
/// "agrees", "differs", "not comparable".
const char* name_of(Verdict verdict);

struct ReproducedCell {
  const PublishedCell* published = nullptr;
  Share computed;        ///< 95 % Wilson interval
  double p_value = 1.0;  ///< probability of a difference at least this large by chance
  Verdict verdict = Verdict::not_comparable;
  std::string reason;  ///< why it is not comparable
};

struct ReproducedRow {
  const PublishedRow* published = nullptr;
  std::optional<EnsembleResult> by_published_law, by_kinematic_law;  ///< at constant speed only the first is set
  std::vector<ReproducedCell> cells;                                 ///< judged under the published law
  std::optional<ShareDifference> law_difference;  ///< balanced share, kinematic minus published, 99 %, common starts
  std::string follow_up;                          ///< why more starts than asked were taken; empty if they were not

  /// use(ensemble, law) for each law that was computed.
  template <class Use>
  void for_each_law(const Use& use) const {
    if (by_published_law) use(*by_published_law, model::SpeedLaw::published);
    if (by_kinematic_law) use(*by_kinematic_law, model::SpeedLaw::kinematic);
  }
};

struct CellCounts {
  int agreeing = 0, differing = 0, not_comparable = 0;
  int below_one_percent = 0;  ///< judged cells with p < 0.01 each; chance gives one in a hundred
};

struct ReproducedTable : CellCounts {
  const PublishedTable* published = nullptr;
  std::vector<ReproducedRow> rows;
  double single_limit = 0.0;  ///< a cell differs if its p value is below this: 1 % over all judged cells of the table
};

/// One conclusion tested under one law.
struct ConclusionResult {
  enum class Answer {
    holds,         ///< every difference surely lies where the conclusion says
    reversed,      ///< every difference surely lies on the other side
    contradicted,  ///< at least one surely does
    open,          ///< none does, but not all are sure
    not_asked,
  };
  Answer answer = Answer::not_asked;
  std::vector<ShareDifference> differences;  ///< one per contrast, 99 %, common starts
};
const char* name_of(ConclusionResult::Answer answer);

struct ConclusionRow {
  const Conclusion* conclusion = nullptr;
  ConclusionResult published, kinematic;
  /// Whether either law was asked.
  bool asked() const { return !published.differences.empty() || !kinematic.differences.empty(); }
};

/// Fills in counts and verdicts of a table whose rows are computed.
void judge(ReproducedTable& table);
/// Conclusions from the rows that are available.
std::vector<ConclusionRow> judge_conclusions(const std::vector<ReproducedTable>& tables);

}  // namespace equipoise
