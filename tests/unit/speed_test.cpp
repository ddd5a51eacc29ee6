// The rotor's motion cut into segments: psi and its derivatives under both laws, jumps, clamp and the ramp function.
#include "equipoise/machine/drives/speed.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace speed_test {

using equipoise::model::Segment;
using equipoise::model::segments;
using equipoise::model::SpeedLaw;
using equipoise::model::SpeedProfile;

constexpr double infinity = std::numeric_limits<double>::infinity();
// A few roundings of angles up to 300.
constexpr double rounding = 1e-12;

const std::vector<SpeedProfile>& profiles() {
  static const std::vector<SpeedProfile> all = [] {
    std::vector<SpeedProfile> result;
    for (SpeedLaw law : {SpeedLaw::kinematic, SpeedLaw::published})
      for (double angle : {0.0, -1.3}) {
        result.push_back({{0.0}, {2.4}, law, angle});
        result.push_back({{0.0}, {0.0}, law, angle});
        result.push_back({{0.0, 50.0}, {0.0, 2.4}, law, angle});
        result.push_back({{0.0, 50.0}, {3.0, -1.0}, law, angle});
        result.push_back({{0.0, 25.0, 60.0, 80.0}, {0.5, 3.0, 3.0, 2.4}, law, angle});
        result.push_back({{0.0, 7.5, 12.0, 40.0, 41.0}, {1.0, 1.0, 2.5, 2.0, 2.6}, law, angle});
      }
    return result;
  }();
  return all;
}

// Releases at the start, within pieces, at corners and after the last one.
constexpr double releases[] = {0.0, 3.3, 12.0, 25.0, 30.0, 50.0, 80.0, 123.0};

double omega(const SpeedProfile& p, double t) {  // the ramp function by a separate search
  std::size_t i = 0;
  while (i + 1 < p.times.size() && p.times[i + 1] <= t) ++i;
  if (i + 1 == p.times.size()) return p.speeds[i];
  const double share = (t - p.times[i]) / (p.times[i + 1] - p.times[i]);
  return (1.0 - share) * p.speeds[i] + share * p.speeds[i + 1];
}

double slope(const SpeedProfile& p, double t) {  // of the ramp function, from t on
  const std::size_t i = std::upper_bound(p.times.begin(), p.times.end(), t) - p.times.begin();
  return i == p.times.size() ? 0.0 : (p.speeds[i] - p.speeds[i - 1]) / (p.times[i] - p.times[i - 1]);
}

// Times inside a segment, including its start.
std::vector<double> times_in(const Segment& s) {
  const double length = std::min(s.end - s.begin, 50.0);
  return {s.begin, s.begin + 0.25 * length, s.begin + 0.5 * length, s.begin + 0.9 * length};
}

TEST(Segments, FollowEachOtherWithoutGapsUpToInfinity) {
  for (const auto& profile : profiles())
    for (double release : releases) {
      const auto all = segments(profile, release);
      EXPECT_EQ(all.front().begin, 0.0);
      EXPECT_EQ(all.back().end, infinity);
      for (std::size_t i = 0; i + 1 < all.size(); ++i) {
        EXPECT_EQ(all[i].end, all[i + 1].begin);
        EXPECT_LT(all[i].begin, all[i].end);
      }
    }
}

TEST(Segments, AreCutAtCornersAndAtTheReleaseOnly) {
  for (const auto& profile : profiles())
    for (double release : releases) {
      std::vector<double> expected = profile.times;
      if (std::find(expected.begin(), expected.end(), release) == expected.end()) expected.push_back(release);
      std::sort(expected.begin(), expected.end());
      std::vector<double> begins;
      for (const auto& s : segments(profile, release)) begins.push_back(s.begin);
      EXPECT_EQ(begins, expected);
    }
}

TEST(Segments, AreClampedExactlyUntilTheRelease) {
  for (const auto& profile : profiles())
    for (double release : releases)
      for (const auto& s : segments(profile, release)) EXPECT_EQ(s.clamped, s.begin < release);
}

TEST(Segments, HaveAContinuousAngleThatStartsWhereTold) {
  for (const auto& profile : profiles())
    for (double release : releases) {
      const auto all = segments(profile, release);
      EXPECT_EQ(all.front().psi, profile.initial_angle);
      for (std::size_t i = 0; i + 1 < all.size(); ++i) EXPECT_NEAR(all[i].psi_at(all[i].end), all[i + 1].psi, rounding);
    }
}

TEST(Segments, HaveSpeedAndAccelerationThatAreTheDerivativesOfTheAngle) {
  for (const auto& profile : profiles())
    for (double release : releases)
      for (const auto& s : segments(profile, release))
        for (double t : times_in(s)) {
          // psi is a quadratic, for which central differences are exact but for the rounding of angles.
          const double h = 4.0;
          const double up = s.psi_at(t + h), here = s.psi_at(t), down = s.psi_at(t - h);
          EXPECT_NEAR(s.speed_at(t), (up - down) / (2.0 * h), rounding);
          EXPECT_NEAR(s.acceleration, (up - 2.0 * here + down) / (h * h), rounding);
        }
}

TEST(KinematicLaw, TurnsTheRotorAtTheRampFunction) {
  for (const auto& profile : profiles())
    if (profile.law == SpeedLaw::kinematic)
      for (double release : releases)
        for (const auto& s : segments(profile, release))
          for (double t : times_in(s)) {
            EXPECT_NEAR(s.speed_at(t), omega(profile, t), rounding);
            EXPECT_NEAR(s.acceleration, slope(profile, t), rounding);
          }
}

TEST(KinematicLaw, HasNoJumpOfSpeed) {
  for (const auto& profile : profiles())
    if (profile.law == SpeedLaw::kinematic)
      for (double release : releases) {
        const auto all = segments(profile, release);
        for (std::size_t i = 0; i + 1 < all.size(); ++i)
          EXPECT_NEAR(all[i].speed_at(all[i].end), all[i + 1].speed, rounding);
      }
}

TEST(PublishedLaw, HasAngleTTimesTheRampFunction) {
  for (const auto& profile : profiles())
    if (profile.law == SpeedLaw::published)
      for (double release : releases)
        for (const auto& s : segments(profile, release))
          for (double t : times_in(s)) {
            EXPECT_NEAR(s.psi_at(t), profile.initial_angle + t * omega(profile, t), rounding);
            EXPECT_NEAR(s.speed_at(t), omega(profile, t) + t * slope(profile, t), rounding);
            EXPECT_NEAR(s.acceleration, 2.0 * slope(profile, t), rounding);
          }
}

TEST(PublishedLaw, JumpsAtCornersByTTimesTheChangeOfSlopeAndNowhereElse) {
  for (const auto& profile : profiles())
    if (profile.law == SpeedLaw::published)
      for (double release : releases) {
        const auto all = segments(profile, release);
        for (std::size_t i = 0; i + 1 < all.size(); ++i) {
          const double t = all[i].end;
          const bool corner = std::find(profile.times.begin(), profile.times.end(), t) != profile.times.end();
          const double change = corner ? slope(profile, t) - slope(profile, std::nextafter(t, 0.0)) : 0.0;
          EXPECT_NEAR(all[i + 1].speed - all[i].speed_at(t), t * change, rounding);
        }
      }
}

TEST(PublishedLaw, DoublesARampFromRestAndDropsAtItsEnd) {
  const SpeedProfile ramp{{0.0, 50.0}, {0.4, 2.4}, SpeedLaw::published, 0.0};
  const auto all = segments(ramp, 50.0);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_NEAR(all[0].speed_at(50.0), 2.0 * 2.4 - 0.4, rounding);
  EXPECT_EQ(all[1].speed, 2.4);
  EXPECT_EQ(all[1].acceleration, 0.0);
}

TEST(PublishedLaw, ReversesTheRotorInThePapersTrapezoid) {
  const SpeedProfile trapezoid{{0.0, 50.0, 400.0, 500.0}, {0.0, 3.0, 3.0, 2.0}, SpeedLaw::published, 0.0};
  const auto all = segments(trapezoid, 50.0);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_NEAR(all[2].speed, -1.0, rounding);
  EXPECT_NEAR(all[2].speed_at(500.0), -3.0, rounding);
}

SpeedProfile hill(double exponent, double limit = 3.6, double half_time = 200.0) {
  const equipoise::model::HillFunction function{limit, half_time, exponent};
  const double until = 4.0 * half_time, speed = function.speed(until);
  return {{0.0, until, until + (limit - speed) / function.slope(until)},
          {0.0, speed, limit},
          SpeedLaw::kinematic,
          0.4,
          function};
}

// psi by quadrature over the function itself, and speed and acceleration by its own formulas.
TEST(HillFunction, IsFollowedByTheSegments) {
  using Quadrature = boost::math::quadrature::gauss_kronrod<double, 61>;
  for (const double limit : {3.6, -2.4})
    for (const double n : {1.0, 1.5, 2.0, 3.0, 8.0, 50.0})
      for (const double release : {0.0, 30.0, 150.0, 1e6}) {
        const SpeedProfile p = hill(n, limit);
        const auto omega_at = [&](double t) {
          return t > 0.0 ? limit * std::pow(t / 200.0, n) / (1.0 + std::pow(t / 200.0, n)) : 0.0;
        };
        double psi = 0.4;
        for (const Segment& s : segments(p, release)) {
          EXPECT_NEAR(s.psi, psi, 1e-12 * (1.0 + std::fabs(psi)));
          if (s.begin >= p.times[1]) break;
          EXPECT_EQ(s.clamped, s.begin < release);
          // A rounding of t is one of the exponent's power.
          const double allowed = 2e-15 * (1.0 + n) * std::fabs(limit);
          for (const double part : {0.0, 0.23, 0.5, 0.77, 1.0}) {
            const double t = s.begin + part * (s.end - s.begin), x = std::pow(t / 200.0, n);
            EXPECT_NEAR(s.speed_at(t), omega_at(t), allowed) << n << " at " << t;
            // A polynomial's slope is less exact than itself by the square of its degree over its length.
            if (t > 0.0) {
              EXPECT_NEAR(s.acceleration_at(t), limit * n * x / (t * (1.0 + x) * (1.0 + x)),
                          225.0 * allowed / (s.end - s.begin))
                  << n << " at " << t;
            }
          }
          psi += Quadrature::integrate(omega_at, s.begin, s.end, 3, 1e-14);
          EXPECT_NEAR(s.psi_at(s.end), psi, 1e-12 * (1.0 + std::fabs(psi)));
        }
      }
}

TEST(HillFunction, GoesOnAlongItsTangentToItsLimit) {
  const SpeedProfile p = hill(3.0);
  const auto all = segments(p, 0.0);
  const Segment &tangent = all[all.size() - 2], &last = all.back();
  EXPECT_EQ(last.speed, 3.6);
  EXPECT_EQ(last.acceleration, 0.0);
  EXPECT_FALSE(last.curve.present());
  EXPECT_FALSE(tangent.curve.present());
  EXPECT_NEAR(tangent.acceleration, all[all.size() - 3].acceleration_at(tangent.begin), 1e-14);
  EXPECT_NEAR(tangent.speed_at(tangent.end), 3.6, rounding);
}

TEST(HillFunction, IsHalfAtItsHalfTimeAndSteepestWhereItSays) {
  const SpeedProfile p = hill(3.0);
  EXPECT_NEAR(p.ramp_function(200.0), 1.8, rounding);
  EXPECT_NEAR(p.first_time_at(1.8).value(), 200.0, 1e-10);
  EXPECT_NEAR(p.first_time_at(p.ramp_function(77.0)).value(), 77.0, 1e-10);
  EXPECT_EQ(p.first_time_at(3.7), std::nullopt);
  const double last = p.speeds.back();
  EXPECT_EQ(p.first_time_at(last * (1.0 + 1e-14)), p.first_time_at(last));  // in other units
  EXPECT_EQ(p.first_time_at(last * (1.0 + 1e-6)), std::nullopt);
  double most = 0.0;
  for (double t = 0.0; t < 800.0; t += 0.1) most = std::max(most, p.hill->slope(t));
  EXPECT_NEAR(p.hill->steepest(), most, 1e-8);
  EXPECT_GE(p.hill->steepest(), most);
}

TEST(SpeedProfile, HasTheRampFunctionOfItsPoints) {
  for (const auto& profile : profiles())
    for (double t = 0.0; t < 130.0; t += 0.7) EXPECT_NEAR(profile.ramp_function(t), omega(profile, t), rounding);
  const SpeedProfile ramp{{0.0, 50.0}, {0.0, 2.4}, SpeedLaw::kinematic, 0.0};
  EXPECT_EQ(ramp.ramp_function(25.0), 1.2);
  EXPECT_EQ(ramp.ramp_function(50.0), 2.4);
  EXPECT_EQ(ramp.ramp_function(1e6), 2.4);
  EXPECT_EQ(ramp.final_speed(), 2.4);
  EXPECT_EQ(ramp.settled_time(), 50.0);
}

TEST(FirstTimeAt, IsTheFirstTimeTheRampFunctionHasTheSpeed) {
  const SpeedProfile p{{0.0, 10.0, 20.0, 30.0}, {1.0, 3.0, 2.0, 2.5}, SpeedLaw::kinematic, 0.0};
  EXPECT_EQ(p.first_time_at(1.0), 0.0);
  EXPECT_EQ(p.first_time_at(2.0), 5.0);  // on the way up, not on the way down
  EXPECT_EQ(p.first_time_at(2.5), 7.5);
  EXPECT_EQ(p.first_time_at(3.0), 10.0);  // a corner
  EXPECT_EQ(p.first_time_at(0.9), std::nullopt);
  EXPECT_EQ(p.first_time_at(3.1), std::nullopt);
  const SpeedProfile falling{{0.0, 10.0}, {2.0, -2.0}, SpeedLaw::published, 0.0};
  EXPECT_EQ(falling.first_time_at(0.0), 5.0);  // a rule on the ramp function, whatever the law
  const SpeedProfile constant{{0.0}, {2.4}, SpeedLaw::kinematic, 0.0};
  EXPECT_EQ(constant.first_time_at(2.4), 0.0);
  EXPECT_EQ(constant.first_time_at(2.0), std::nullopt);
  const SpeedProfile waiting{{0.0, 5.0, 9.0}, {1.0, 1.0, 2.0}, SpeedLaw::kinematic, 0.0};
  EXPECT_EQ(waiting.first_time_at(1.0), 0.0);
  EXPECT_EQ(waiting.first_time_at(1.5), 7.0);
}

}  // namespace speed_test
