// What a pilot must have seen before a box may decide.
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/simulation/rule/pilot.hpp"

namespace equipoise {
namespace pilot_test {

constexpr int own = 4, other = 2;

struct Audit {
  std::vector<Outcome> outcomes;
  std::vector<PilotRecord> records;

  void add(int count, int attractor, int run) {
    Outcome outcome;
    outcome.kind = OutcomeKind::attracted;
    outcome.attractor = static_cast<short>(attractor);
    PilotRecord record;
    record.longest_run[0] = run;
    outcomes.insert(outcomes.end(), count, outcome);
    records.insert(records.end(), count, record);
  }
  int hits() const { return hits_from_audit(outcomes, records, 0, own, false); }
};

TEST(Pilot, ABoxAsksForMoreThanTwiceTheLongestStayThatEndedElsewhere) {
  Audit audit;
  audit.add(500, own, 200);
  audit.add(3000, other, 0);
  EXPECT_EQ(audit.hits(), 3);
  audit.add(7, other, 4);
  EXPECT_EQ(audit.hits(), 9);
  audit.add(1, other, 40);
  EXPECT_EQ(audit.hits(), 0);  // 81 half windows: long windows decide as soon
}

// The few stays of a rare attractor, even if all are right, do not show that the next will be.
TEST(Pilot, ABoxThatFewStayedInDecidesNothing) {
  Audit audit;
  audit.add(4000, other, 0);
  audit.add(11, own, 200);
  EXPECT_EQ(audit.hits(), 0);
  audit.add(89, own, 200);
  EXPECT_EQ(audit.hits(), 3);
}

// Stays shorter than a decision are no evidence: a box would not have decided them.
TEST(Pilot, OnlyStaysThatWouldHaveDecidedAreEvidence) {
  Audit audit;
  audit.add(4000, own, 8);
  audit.add(50, own, 9);
  audit.add(20, other, 4);
  EXPECT_EQ(audit.hits(), 0);
  audit.add(50, own, 9);
  EXPECT_EQ(audit.hits(), 9);
}

}  // namespace pilot_test
}  // namespace equipoise
