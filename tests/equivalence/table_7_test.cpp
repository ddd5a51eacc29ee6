// A protocol for table 7, and a test of balance at a finite time.
#include <limits>

#include <gtest/gtest.h>

#include "../literature/table_7_protocol.hpp"

namespace equipoise {
namespace table_7_test {

TEST(Table7, DefaultProtocolIsTheStudyFiles) {
  for (const Table7Row& row : table_7_rows)
    for (BranchLaw law : {BranchLaw::kinematic, BranchLaw::published}) {
      Table7Protocol protocol;
      protocol.rise = protocol.fall = law;
      Study study = protocol.study(row);
      study.speed.law = law == BranchLaw::published ? model::SpeedLaw::published : model::SpeedLaw::kinematic;
      const auto expected = model::segments(study.speed_profile(), study.release_time());
      const auto made = protocol.segments(row);
      ASSERT_EQ(made.size(), expected.size());
      for (std::size_t k = 0; k < made.size(); ++k) {
        EXPECT_EQ(made[k].begin, expected[k].begin);
        EXPECT_EQ(made[k].end, expected[k].end);
        EXPECT_EQ(made[k].clamped, expected[k].clamped);
        EXPECT_NEAR(made[k].speed, expected[k].speed, 1e-12);  // a few roundings of numbers up to 5
        EXPECT_NEAR(made[k].acceleration, expected[k].acceleration, 1e-15);
      }
    }
}

TEST(Table7, CallsBalancedWhatStaysBelowInEveryWindow) {
  Observation o;
  o.starts = 4;
  o.windows = 3;
  o.window = 10.0;
  const float never = std::numeric_limits<float>::quiet_NaN(), lost = std::numeric_limits<float>::infinity();
  o.largest = {4.0f, 0.5f, 0.5f, 0.5f, 4.0f, 0.5f, never, 0.5f, 0.5f, 0.5f, 0.5f, lost};
  o.at_end = {1.0f, 0.5f, 0.4f, 0.3f, 4.0f, 0.3f, never, 0.5f, 0.2f, 0.5f, 0.5f, lost};
  EXPECT_EQ(called_balanced(o, {20.0, 30.0, 1.0}), 3u);
  EXPECT_EQ(called_balanced(o, {10.0, 30.0, 1.0}), 2u);
  EXPECT_EQ(called_balanced(o, {0.0, 20.0, 1.0}), 1u);
  EXPECT_EQ(called_balanced(o, {30.0, 30.0, 0.6}), 2u);  // r^2 below 0.36
}

TEST(Table7, LeadIsReadFromAsManyStartsAsAsked) {
  const auto one = observe_table_7_lead(300, 1), two = observe_table_7_lead(300, 2);
  ASSERT_EQ(one.size(), table_7_rows.size());
  for (std::size_t row = 0; row < one.size(); ++row) {
    EXPECT_EQ(one[row].balanced.total, 300u);
    EXPECT_EQ(one[row].balanced.count, two[row].balanced.count);
    // Four standard errors of 300 starts at a share of 97 %, more than the lead's deviation from the printed shares.
    EXPECT_NEAR(100.0 * one[row].balanced.share, one[row].row.printed, 5.0);
  }
}

}  // namespace table_7_test
}  // namespace equipoise
