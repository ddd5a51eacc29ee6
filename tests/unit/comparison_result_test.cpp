// Two ensembles compared: pairs, names, bounds, and what cannot be paired.
#include "equipoise/analyses/one_study/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "../support/studies.hpp"

namespace equipoise {
namespace comparison_result_test {

BasinOutcomes ensemble(const std::vector<short>& outcome) {
  BasinOutcomes o;
  o.study = parse_study(constant_speed, "rotor");
  o.outcome = outcome;
  o.names = {
      {1, {"balanced", ""}}, {2, {"co-drifting", "V1"}}, {9, {"wobble", ""}}, {undecided_code, {"undecided", ""}}};
  return o;
}

const ComparedShare& share(const ComparisonResult& r, const std::string& name) {
  for (const ComparedShare& s : r.shares)
    if (s.name == name) return s;
  throw RunError("no outcome " + name);
}

// 1000 starts: of 600 balanced ones 50 are no longer balanced, of the 400 others 150 now are.
std::pair<BasinOutcomes, BasinOutcomes> pair() {
  std::vector<short> before, after;
  for (int i = 0; i < 1000; ++i) {
    before.push_back(i < 600 ? 1 : 2);
    after.push_back(i < 50 ? 2 : i < 600 ? 1 : i < 750 ? 1 : 2);
  }
  return {ensemble(before), ensemble(after)};
}

TEST(Comparison, OfCommonStartsIsOfPairs) {
  const auto [first, second] = pair();
  const ComparisonResult r = compare(first, second);
  EXPECT_TRUE(r.common);
  ASSERT_TRUE(r.changed && r.balanced);
  EXPECT_EQ(r.changed->count, 200u);
  ASSERT_EQ(r.changes.size(), 2u);
  EXPECT_EQ(r.changes[0].from + " " + r.changes[0].to, "co-drifting balanced");
  EXPECT_EQ(r.changes[0].starts, 150u);
  const ShareDifference& d = share(r, "balanced").difference;
  EXPECT_DOUBLE_EQ(d.difference, 0.1);
  const ShareDifference paired = paired_difference({550, 50, 150, 250});
  EXPECT_EQ(d.low, paired.low);
  EXPECT_EQ(d.high, paired.high);
  EXPECT_EQ(r.surely_low, d.low);
  EXPECT_NE(verdict(r).find("more often"), std::string::npos);
  EXPECT_NE(verdict(compare(second, first)).find("less often"), std::string::npos);
  EXPECT_NE(verdict(compare(first, first)).find("No difference"), std::string::npos);
}

TEST(Comparison, OfDifferentSeedsIsOfIndependentSamples) {
  auto [first, second] = pair();
  second.study.sampling.seed = 2;
  const ComparisonResult r = compare(first, second);
  EXPECT_FALSE(r.common);
  EXPECT_FALSE(r.changed);
  EXPECT_NE(r.why_not_common.find("seeds"), std::string::npos);
  const ComparedShare& s = share(r, "balanced");
  EXPECT_EQ(s.difference.low, independent_difference(s.first, s.second).low);
}

// A difference of 10 points with 30 % undecided in the first study is not certain.
TEST(Comparison, UndecidedStartsLeaveItOpen) {
  auto [first, second] = pair();
  for (int i = 700; i < 1000; ++i) first.outcome[static_cast<std::size_t>(i)] = undecided_code;
  const ComparisonResult r = compare(first, second);
  EXPECT_LT(r.surely_low, 0.0);
  EXPECT_GT(share(r, "balanced").difference.low, 0.0);
  EXPECT_NE(verdict(r).find("Open"), std::string::npos);
}

// All starts end balanced in both, but the second's velocity exceeds its limit in 41 of 100.
TEST(Comparison, IsDecidedByLimitsWhereBothStateThem) {
  BasinOutcomes first = ensemble(std::vector<short>(1000, 1));
  for (auto& figures : first.transients) figures.assign(1000, 0.001f);
  first.study.limits.velocity = 0.01;
  BasinOutcomes second = first;
  const auto exceed = [&](float TransientRow::*figure) {
    for (std::size_t i = 0; i < 410; ++i) second.transients[figure_place(figure)][i] = 0.02f;
  };
  exceed(&TransientRow::rms_velocity);
  const ComparisonResult r = compare(first, second);
  ASSERT_TRUE(r.limits);
  EXPECT_EQ(r.limits->first.count, 1000u);
  EXPECT_EQ(r.limits->second.count, 590u);
  EXPECT_TRUE(verdict(r).starts_with("The second keeps every limit less often, by 41.0")) << verdict(r);
  EXPECT_TRUE(verdict(compare(second, first)).starts_with("The second keeps every limit more often, by +41.0"));
  EXPECT_TRUE(verdict(compare(first, first)).starts_with("No difference in starts within all limits is shown"));
  EXPECT_NE(result_text(r).find("starts within all limits"), std::string::npos);
  // Undecided starts may still come below it.
  for (std::size_t i = 0; i < 410; ++i) second.outcome[i] = undecided_code;
  const ComparisonResult open = compare(first, second);
  EXPECT_GE(open.limits->surely_high, 0.0);
  EXPECT_TRUE(verdict(open).starts_with("Open: the difference in starts within all limits is")) << verdict(open);
  // A peak stays exceeded, however these starts end.
  second.study.limits.displacement = first.study.limits.displacement = 0.01;
  exceed(&TransientRow::peak_radial);
  EXPECT_TRUE(verdict(compare(first, second)).starts_with("The second keeps every limit less often"));
  second.study.limits.velocity = 0.03;
  EXPECT_TRUE(verdict(compare(first, second)).starts_with("The second keeps its own limits less often"));
  second.study.limits = {};
  EXPECT_FALSE(compare(first, second).limits);
}

TEST(Comparison, MatchesMotionsByIdentifierElseByName) {
  auto [first, second] = pair();
  second.names[1].name = "balanced, stuck";
  second.names[9].name = "something else";
  second.names[10] = {"wobble", ""};
  first.outcome[0] = 9;
  second.outcome[0] = 10;
  const ComparisonResult r = compare(first, second);
  EXPECT_EQ(share(r, "balanced / balanced, stuck").first.count, 599u);
  EXPECT_EQ(share(r, "wobble").first.count, 1u);
  EXPECT_EQ(share(r, "wobble").second.count, 1u);
  EXPECT_EQ(share(r, "something else").second.count, 0u);
  EXPECT_EQ(r.changed->count, 199u);
}

TEST(Comparison, OfUnequalLengthsGoesAsFarAsBothDo) {
  auto [first, second] = pair();
  second.outcome.resize(100);
  const ComparisonResult r = compare(first, second);
  EXPECT_EQ(r.starts, 100u);
  EXPECT_EQ(share(r, "balanced").first.total, 100u);
}

TEST(Comparison, OfNothingSaysSo) {
  auto [first, second] = pair();
  second.outcome.clear();
  EXPECT_NE(verdict(compare(first, second)).find("nothing to compare"), std::string::npos);
  EXPECT_EQ(result_text(compare(first, second)).find("common starts end"), std::string::npos);
}

TEST(Comparison, RefusesGrids) {
  auto [first, second] = pair();
  second.study.sampling.method = SamplingMethod::grid;
  EXPECT_THROW(compare(first, second), InputError);
  EXPECT_THROW(check_comparable(second.study), InputError);
  EXPECT_NO_THROW(check_comparable(first.study));
}

// Means by hand: of pairs, what both have in common cancels.
TEST(ComparedFigures, ArePairsOfCommonStarts) {
  auto [before, after] = pair();
  std::vector<float>&a = before.transients[0], &b = after.transients[0];
  for (int i = 0; i < 1000; ++i) {
    a.push_back(static_cast<float>(i % 100));
    b.push_back(static_cast<float>(i % 100) + 2.0f + (i % 2 ? 0.5f : -0.5f));
  }
  b[3] = std::numeric_limits<float>::infinity();
  const ComparisonResult r = compare(before, after);
  ASSERT_EQ(r.figures.size(), 1u);
  const ComparedFigure& f = r.figures.front();
  EXPECT_EQ(f.name, "peak_radial");
  EXPECT_EQ(f.mean.first_count, 999u);
  EXPECT_EQ(f.second_open, 1u);
  EXPECT_NEAR(f.mean.difference, 2.0, 1e-3);
  // 1.962 of Student, deviation 0.5 over sqrt(999).
  EXPECT_NEAR(f.mean.high - f.mean.low, 2.0 * 1.962 * 0.5 / std::sqrt(999.0), 1e-4);
  after.study.sampling.seed = 7;
  const ComparedFigure apart = compare(before, after).figures.front();
  // Independent: deviations of 28.9 each.
  EXPECT_NEAR(apart.mean.high - apart.mean.low, 2.0 * 1.961 * 28.9 * std::sqrt(2.0 / 1000.0), 0.02);
  EXPECT_TRUE(holds(result_text(r), "second - first"));
}

TEST(ComparedFigures, NeedTransientsAndOneUnit) {
  auto [before, after] = pair();
  EXPECT_TRUE(compare(before, after).figures.empty());
  EXPECT_FALSE(holds(result_text(compare(before, after)), "second - first"));
  before.transients[0].assign(1000, 1.0f);
  after.transients[0].assign(1000, 2.0f);
  after.study.scales = model::Scales{2.0, 0.1, 50.0};
  EXPECT_TRUE(compare(before, after).figures.empty());  // R and mm
  before.study.scales = model::Scales{2.0, 0.2, 50.0};
  const MeanDifference d = compare(before, after).figures.at(0).mean;
  EXPECT_NEAR(d.first, 200.0, 1e-9);  // mm, each by its own R
  EXPECT_NEAR(d.second, 200.0, 1e-9);
  EXPECT_NEAR(d.difference, 0.0, 1e-9);
}

}  // namespace comparison_result_test
}  // namespace equipoise
