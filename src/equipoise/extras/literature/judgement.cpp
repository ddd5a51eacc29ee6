// Judges cells by both samples' errors, and conclusions by differences on common starts.
#include "equipoise/extras/literature/published_tables.hpp"

#include <algorithm>
#include <map>

namespace equipoise {

namespace {

// One in a hundred tables without any true difference shows a cell that differs (Bonferroni).
constexpr double joint_error = 0.01;
constexpr double difference_confidence = 0.99;

using ByName = std::map<std::string, const ReproducedRow*>;

const EnsembleResult* ensemble(const ByName& rows, const std::string& study, model::SpeedLaw law) {
  const auto at = rows.find(study);
  if (at == rows.end()) return nullptr;
  const ReproducedRow& row = *at->second;
  // At constant speed the two laws are the same.
  const bool kinematic = law == model::SpeedLaw::kinematic && row.by_kinematic_law;
  const bool constant = study.starts_with("table-1-") || study.starts_with("table-2-");
  if (law == model::SpeedLaw::kinematic && !kinematic && !constant) return nullptr;
  const auto& result = kinematic ? row.by_kinematic_law : row.by_published_law;
  return result && !result->partial ? &*result : nullptr;
}

ConclusionResult ask(const Conclusion& conclusion, const ByName& rows, model::SpeedLaw law) {
  using Answer = ConclusionResult::Answer;
  ConclusionResult result;
  const bool rises = conclusion.kind == Conclusion::Kind::rises;
  std::size_t holding = 0, opposed = 0;
  for (const Contrast& contrast : conclusion.contrasts) {
    const EnsembleResult* first = ensemble(rows, contrast.first, law);
    const EnsembleResult* second = ensemble(rows, contrast.second, law);
    if (!first || !second) return {};
    const auto d = paired_difference(compare_starts(first->balanced, second->balanced), difference_confidence);
    result.differences.push_back(d);
    const bool still = d.low > -unchanged_margin && d.high < unchanged_margin;
    holding += rises ? d.low > 0.0 : still;
    opposed += rises ? d.high < 0.0 : d.low > unchanged_margin || d.high < -unchanged_margin;
  }
  const std::size_t all = conclusion.contrasts.size();
  result.answer = holding == all            ? Answer::holds
                  : rises && opposed == all ? Answer::reversed
                  : opposed > 0             ? Answer::contradicted
                                            : Answer::open;
  return result;
}

}  // namespace

const char* name_of(Verdict verdict) {
  return std::array{"agrees", "differs", "not comparable"}[static_cast<std::size_t>(verdict)];
}

const char* name_of(ConclusionResult::Answer answer) {
  constexpr std::array names{"holds", "reversed", "does not hold", "not shown", "not asked"};
  return names[static_cast<std::size_t>(answer)];
}

Share EnsembleResult::share_of(const std::string& attractor) const {
  for (const OutcomeShare& line : attractors)
    if (line.alias == attractor || line.name == attractor) return line.share;
  return wilson_share(0, starts);
}

void judge(ReproducedTable& table) {
  int judged = 0;
  for (ReproducedRow& row : table.rows) {
    row.cells.clear();
    for (const PublishedCell& published : row.published->cells) {
      ReproducedCell cell{&published, {}, 1.0, Verdict::not_comparable, ""};
      const auto& result = row.by_published_law;
      if (result && result->starts > 0) {
        cell.computed = result->share_of(published.attractor);
        cell.p_value = agreement_p_value(cell.computed.count, result->starts, published.share);
      }
      cell.reason = !result                               ? "not computed under the published law"
                    : result->partial                     ? "stopped before all starts were done"
                    : !table.published->unclaimed.empty() ? table.published->unclaimed
                                                          : row.published->slip;
      judged += cell.reason.empty();
      row.cells.push_back(cell);
    }
    if (row.by_published_law && row.by_kinematic_law)
      row.law_difference = paired_difference(
          compare_starts(row.by_published_law->balanced, row.by_kinematic_law->balanced), difference_confidence);
  }
  table.single_limit = joint_error / std::max(1, judged);
  static_cast<CellCounts&>(table) = {};
  for (ReproducedRow& row : table.rows)
    for (ReproducedCell& cell : row.cells) {
      if (cell.reason.empty()) {
        cell.verdict = cell.p_value < table.single_limit ? Verdict::differs : Verdict::agrees;
        table.below_one_percent += cell.p_value < 0.01;
      }
      ++(cell.verdict == Verdict::agrees    ? table.agreeing
         : cell.verdict == Verdict::differs ? table.differing
                                            : table.not_comparable);
    }
}

std::vector<ConclusionRow> judge_conclusions(const std::vector<ReproducedTable>& tables) {
  ByName rows;
  for (const ReproducedTable& table : tables)
    for (const ReproducedRow& row : table.rows) rows[row.published->study] = &row;
  std::vector<ConclusionRow> result;
  for (const Conclusion& conclusion : conclusions())
    result.push_back({&conclusion, ask(conclusion, rows, model::SpeedLaw::published),
                      ask(conclusion, rows, model::SpeedLaw::kinematic)});
  return result;
}

}  // namespace equipoise
