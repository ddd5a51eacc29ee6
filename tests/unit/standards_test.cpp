// Figures of standards: weighting against the standard's printed table, zones at their boundaries, sliding by search.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/standards/hand_arm.hpp"
#include "equipoise/machine/standards/severity.hpp"

namespace equipoise::standards {
namespace standards_test {

TEST(HandArm, WeightingIsThatOfTheStandardsTable) {
  // ISO 5349-1:2001, table A.2: third octaves 10^(n/10) Hz from n = 8, to the digits printed.
  const struct {
    double factor, digit;
  } printed[] = {{0.727, 1e-3},  {0.873, 1e-3},  {0.951, 1e-3},  {0.958, 1e-3},  {0.896, 1e-3},  {0.782, 1e-3},
                 {0.647, 1e-3},  {0.519, 1e-3},  {0.411, 1e-3},  {0.324, 1e-3},  {0.256, 1e-3},  {0.202, 1e-3},
                 {0.160, 1e-3},  {0.127, 1e-3},  {0.101, 1e-3},  {0.0799, 1e-4}, {0.0634, 1e-4}, {0.0503, 1e-4},
                 {0.0398, 1e-4}, {0.0314, 1e-4}, {0.0245, 1e-4}, {0.0186, 1e-4}, {0.0135, 1e-4}, {0.00894, 1e-5}};
  int n = 8;
  for (const auto& [factor, digit] : printed)
    EXPECT_NEAR(hand_arm_weighting(std::pow(10.0, 0.1 * n++)), factor, 0.5001 * digit) << n;
}

TEST(HandArm, ACircleIsItsCentripetalAcceleration) {
  // A grinder at 6600 rpm whose handle goes round a circle of 0.05 mm.
  const double w = two_pi * 110.0, a = hand_arm_acceleration(110.0, 5e-5 * w);
  EXPECT_NEAR(a, hand_arm_weighting(110.0) * 5e-5 * w * w, 1e-12);
  EXPECT_NEAR(a, 3.475, 1e-3);
  EXPECT_NEAR(hours_to_exposure(a, exposure_action_value), 4.14, 0.01);
  EXPECT_NEAR(hours_to_exposure(5.0, exposure_limit_value), 8.0, 1e-12);
  EXPECT_NEAR(hours_to_exposure(10.0, exposure_limit_value), 2.0, 1e-12);  // twice as much: a quarter of the time
}

TEST(Severity, ZonesBeginBeyondTheirBoundaries) {
  const SeverityClass& small = severity_classes[0];
  EXPECT_EQ(zone_of(small, 0.0), Zone::a);
  EXPECT_EQ(zone_of(small, 0.71), Zone::a);
  EXPECT_EQ(zone_of(small, 0.711), Zone::b);
  EXPECT_EQ(zone_of(small, 1.81), Zone::c);
  EXPECT_EQ(zone_of(small, 4.6), Zone::d);
  EXPECT_EQ(zone_of(severity_classes[3], 4.6), Zone::b);
}

TEST(Walking, SlidesWhereSomeDirectionOfTheForceWins) {
  for (const double friction : {0.1, 0.4, 0.9})
    for (const double part : {0.999, 1.001}) {
      const double force = part * sliding_force(70.0, friction);
      double most = -1e9;
      for (double a = 0.0; a < two_pi; a += 1e-4)
        most = std::max(most, force * std::cos(a) - friction * (70.0 * standard_gravity - force * std::sin(a)));
      EXPECT_EQ(most > 0.0, part > 1.0);
    }
}

}  // namespace standards_test
}  // namespace equipoise::standards
