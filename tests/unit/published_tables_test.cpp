// The printed tables as data, the judgement of cells, and the conclusions tested under both laws.
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "equipoise/extras/literature/published_tables.hpp"

namespace equipoise {
namespace published_tables_test {

// The size of the paper's tables: 7 tables, 95 ensembles, 265 cells, 21.1 million starts.
TEST(PublishedTables, AreAllThere) {
  std::map<int, std::size_t> cells;
  std::size_t rows = 0;
  std::uint64_t starts = 0;
  for (const PublishedTable& table : published_tables())
    for (const PublishedRow& row : table.rows) {
      cells[table.number] += row.cells.size();
      ++rows;
      starts += row.cells.front().share.starts;
    }
  EXPECT_EQ(cells, (std::map<int, std::size_t>{{1, 24}, {2, 80}, {3, 39}, {4, 80}, {5, 24}, {6, 14}, {7, 4}}));
  EXPECT_EQ(rows, 95u);
  EXPECT_EQ(starts, 21'100'000u);
}

TEST(PublishedTables, SlipsAreRecognised) {
  std::map<std::string, std::string> slips;
  std::set<std::string> fractions;
  for (const PublishedTable& table : published_tables())
    for (const PublishedRow& row : table.rows) {
      if (!row.slip.empty()) slips[row.study] = row.slip;
      for (const PublishedCell& cell : row.cells)
        if (cell.fraction) fractions.insert(row.study + " " + cell.attractor);
    }
  EXPECT_EQ(slips, (std::map<std::string, std::string>{{"table-3-t0-25", "the printed row sums to 100.07"},
                                                       {"table-5-t0-700", "the printed row sums to 100.46"}}));
  EXPECT_EQ(fractions, (std::set<std::string>{"table-2-omega-3.2 V1", "table-2-omega-4.4 V4", "table-4-omega-4.4 V4"}));
}

TEST(PublishedTables, NumbersAndTheirRoundingAreRead) {
  const PublishedRow& row = published_tables()[1].rows[5];  // table 2, Omega = 3.0
  EXPECT_EQ(row.label, "Omega = 3.0");
  EXPECT_DOUBLE_EQ(row.cells[0].share.share, 0.9832);
  EXPECT_DOUBLE_EQ(row.cells[0].share.rounding, 0.00005);
  EXPECT_EQ(row.cells[1].attractor, "V1");
  EXPECT_NEAR(row.cells[1].share.share, 3e-5, 1e-18);  // printed 0.003 percent; rounding of doubles
  EXPECT_NEAR(row.cells[1].share.rounding, 5e-6, 1e-18);
}

// The studies inside the library are those of the repository; their ramps follow the requested law.
TEST(PublishedTables, StudiesAreTheFiles) {
  for (const PublishedTable& table : published_tables())
    for (const PublishedRow& row : table.rows) {
      const std::string path = std::string(EQUIPOISE_SOURCE_DIR) + "/studies/paper/" + row.study + ".toml";
      const Study file = read_study(path);
      EXPECT_EQ(to_toml(study_of(row, model::SpeedLaw::published)), to_toml(file)) << path;
      const Study kinematic = study_of(row, model::SpeedLaw::kinematic);
      EXPECT_EQ(kinematic.speed.law, model::SpeedLaw::kinematic);
      EXPECT_EQ(file.sampling.starts, row.cells.front().share.starts);
      EXPECT_EQ(table.ramps, file.speed.profile != Profile::constant);
    }
}

EnsembleResult ensemble(std::uint64_t starts, double balanced) {
  EnsembleResult e;
  e.starts = starts;
  const auto count = static_cast<std::uint64_t>(std::llround(balanced * static_cast<double>(starts)));
  e.attractors.push_back({1, "balanced", "", wilson_share(count, starts)});
  e.balanced.assign(starts, false);
  std::fill_n(e.balanced.begin(), count, true);
  return e;
}

// Every row as printed, except for what `change` does to it.
template <class Change>
ReproducedTable as_printed(int number, Change change) {
  ReproducedTable table;
  table.published = &published_tables()[static_cast<std::size_t>(number) - 1];
  for (const PublishedRow& row : table.published->rows) {
    ReproducedRow r{&row, ensemble(20000, row.cells.front().share.share), {}, {}, {}, {}};
    for (std::size_t k = 1; k < row.cells.size(); ++k) {
      const auto count = static_cast<std::uint64_t>(std::llround(20000 * row.cells[k].share.share));
      r.by_published_law->attractors.push_back(
          {2, "named otherwise", row.cells[k].attractor, wilson_share(count, 20000)});
    }
    change(r);
    table.rows.push_back(r);
  }
  judge(table);
  return table;
}

TEST(Judgement, WhatIsPrintedAgreesAndSlipsAreNotJudged) {
  const auto unchanged = [](ReproducedRow&) {};
  const auto table = as_printed(5, unchanged);
  EXPECT_EQ(table.agreeing, 21);
  EXPECT_EQ(table.differing, 0);
  EXPECT_EQ(table.not_comparable, 3);
  EXPECT_DOUBLE_EQ(table.single_limit, 0.01 / 21.0);
  EXPECT_EQ(as_printed(7, unchanged).not_comparable, 4);
}

TEST(Judgement, OneWrongCellIsFound) {
  const auto table = as_printed(6, [](ReproducedRow& row) {
    if (row.published->study == "table-6-release-3-t0-300") row.by_published_law = ensemble(20000, 0.8762);
  });
  EXPECT_EQ(table.differing, 1);  // printed 89.62: two points are seven standard errors
  EXPECT_EQ(table.agreeing, 13);
}

TEST(Judgement, WhatIsNotFinishedIsNotComparable) {
  const auto table = as_printed(6, [](ReproducedRow& row) {
    if (row.published->study == "table-6-release-2-t0-100") row.by_published_law->partial = true;
    if (row.published->study == "table-6-release-2-t0-150") row.by_published_law.reset();
  });
  EXPECT_EQ(table.not_comparable, 2);
  EXPECT_EQ(table.rows[0].cells[0].reason, "stopped before all starts were done");
  EXPECT_EQ(table.rows[1].cells[0].reason, "not computed under the published law");
}

TEST(Conclusions, NameRowsThatExist) {
  std::set<std::string> rows;
  for (const PublishedTable& table : published_tables())
    for (const PublishedRow& row : table.rows) rows.insert(row.study);
  for (const Conclusion& c : conclusions())
    for (const Contrast& contrast : c.contrasts) {
      EXPECT_TRUE(rows.count(contrast.first)) << contrast.first;
      EXPECT_TRUE(rows.count(contrast.second)) << contrast.second;
      EXPECT_NE(contrast.first, contrast.second);
    }
}

// The printed numbers support the conclusions drawn from them; a law under which nothing changes does not.
TEST(Conclusions, HoldOfThePrintedNumbersOnly) {
  std::vector<ReproducedTable> tables;
  for (int number = 2; number <= 7; ++number)
    tables.push_back(as_printed(number, [](ReproducedRow& row) {
      if (!row.published->study.starts_with("table-2")) row.by_kinematic_law = ensemble(20000, 0.7);
    }));
  using Answer = ConclusionResult::Answer;
  for (const ConclusionRow& row : judge_conclusions(tables)) {
    EXPECT_EQ(row.published.answer, Answer::holds) << row.conclusion->text;
    const bool unchanged = row.conclusion->kind == Conclusion::Kind::unchanged;
    if (row.conclusion->table != 4) {
      EXPECT_EQ(row.kinematic.answer, unchanged ? Answer::holds : Answer::open) << row.conclusion->text;
    }
  }
}

TEST(Table7, FittedReadingsAreRead) {
  const auto list = table_7_readings();
  ASSERT_GE(list.size(), 10u);
  EXPECT_EQ(list.front(),
            (Table7Reading{"rise kinematic, fall kinematic, released rising-2.2", "r < 0.00134 for 100 up to t = 730",
                           "98.57, 97.17, 97.64, 93.48", "300000", "23.7", "2"}));
  for (const Table7Reading& reading : list) EXPECT_EQ(reading[5], "2");
}

}  // namespace published_tables_test
}  // namespace equipoise
