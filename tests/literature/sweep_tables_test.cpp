// Whole sweeps over Omega and beta next to tables 1 and 2 of Wright and Peng (2019). Every cell is judged by both
// samples' errors, with an allowance for the number of cells.
#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "equipoise/analyses/sweeps/sweep.hpp"
#include "equipoise/analyses/sweeps/sweep_axis.hpp"
#include "equipoise/extras/literature/published_tables.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {
namespace sweep_tables_test {

// Per cell: standard errors of at most 0.8 %, against 0.1 % in print.
#ifdef EQUIPOISE_SANITIZE
constexpr int starts = 300;
#else
constexpr int starts = 4000;
#endif

Study constant_speed(const PublishedRow& row) { return study_of(row, model::SpeedLaw::published); }

// The table's parameters as for --over; constant ones have one value.
std::vector<std::string> over(const PublishedTable& table) {
  std::set<double> speeds, drags;
  for (const PublishedRow& row : table.rows) {
    speeds.insert(constant_speed(row).speed.speed);
    drags.insert(constant_speed(row).parameters.drag[0]);
  }
  return {fmt::format("speed.final={}", fmt::join(speeds, ",")),
          fmt::format("balancer.drag={}", fmt::join(drags, ","))};
}

SweepPlan plan_of(const PublishedTable& table) {
  const StudySource source{
      to_toml(constant_speed(table.rows.front())), "table", {fmt::format("sampling.starts={}", starts)}};
  return SweepPlan(source, sweep_axes(over(table), false, "the table"), {}, "the table");
}

std::size_t cell_of(const SweepPlan& plan, const PublishedRow& row) {
  const Study wanted = constant_speed(row);
  for (std::size_t cell = 0; cell < plan.cells(); ++cell) {
    const Study study = plan.study_of(cell);
    if (study.speed.speed == wanted.speed.speed && study.parameters.drag == wanted.parameters.drag) return cell;
  }
  ADD_FAILURE() << row.label << " is no cell of the sweep";
  return 0;
}

EnsembleResult ensemble_of(const SweepCell& cell) {
  EnsembleResult ensemble;
  ensemble.starts = cell.starts;
  for (const SweepOutcome& outcome : cell.outcomes) ensemble.attractors.push_back(outcome);
  return ensemble;
}

// The table with every row's own cell, or with the cell of the row `shift` places further on.
ReproducedTable judged(const PublishedTable& table, const SweepPlan& plan, const SweepResult& result,
                       std::size_t shift) {
  ReproducedTable reproduced;
  reproduced.published = &table;
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    const SweepCell& cell = *result.cells[cell_of(plan, table.rows[(k + shift) % table.rows.size()])];
    reproduced.rows.push_back({&table.rows[k], ensemble_of(cell), {}, {}, {}, {}});
  }
  judge(reproduced);
  return reproduced;
}

std::string differences(const ReproducedTable& table) {
  std::string text;
  for (const ReproducedRow& row : table.rows)
    for (const ReproducedCell& cell : row.cells)
      if (cell.verdict == Verdict::differs)
        text += fmt::format("{}, {}: printed {}, computed {:.4f} [{:.4f}, {:.4f}], p = {:.2g}\n", row.published->label,
                            cell.published->attractor, cell.published->printed, cell.computed.share, cell.computed.low,
                            cell.computed.high, cell.p_value);
  return text;
}

class SweptTable : public testing::TestWithParam<std::size_t> {};

TEST_P(SweptTable, AgreesWithThePublishedOneCellByCell) {
  const PublishedTable& table = published_tables()[GetParam() - 1];
  const SweepPlan plan = plan_of(table);
  ASSERT_EQ(plan.cells(), table.rows.size());
  const SweepResult result = sweep(plan);
  ASSERT_TRUE(result.complete());
  const ReproducedTable beside = judged(table, plan, result, 0);
  // One in a hundred sweeps without any true difference shows one (Bonferroni).
  EXPECT_EQ(beside.differing, 0) << differences(beside);
  EXPECT_EQ(beside.not_comparable, 0);
  // The parameters matter: no table agrees with the cells of other rows.
  EXPECT_GT(judged(table, plan, result, 1).differing, static_cast<int>(table.rows.size()) / 4);
}

INSTANTIATE_TEST_SUITE_P(Literature, SweptTable, testing::Values(1, 2));

}  // namespace sweep_tables_test
}  // namespace equipoise
