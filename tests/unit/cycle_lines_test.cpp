// Curves of cycles against branches that are followed along one parameter, as "attractors --along" follows them: with
// other equations, and other multipliers.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "equipoise/analyses/continuation/branch_follower.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/extras/curves/cycle_curve.hpp"
#include "../support/charted_plane.hpp"

namespace equipoise {
namespace cycle_lines_test {

// A plane, and where cycles are born that change across it.
struct BirthOfCycles {
  CurveKind change;
  SliceAxis x, y;
  double hopf_x, frequency;  // of the Hopf point, about
  Eigen::Vector2d across;    // in the unit square
};

// One place on the curve, as the chart has it, and the system by place.
class PlaceOnCurve {
 public:
  explicit PlaceOnCurve(const BirthOfCycles& birth) : x_(birth.x.key), y_(birth.y.key) {
    const ChartedPlane charted(birth.x, birth.y);
    for (const ChartCurve& curve : charted.chart.curves) {
      if (curve.kind != CurveKind::hopf || curve.of != of_balance) continue;
      const auto p = std::find_if(curve.points.begin(), curve.points.end(), [&](const CurvePoint& q) {
        return std::fabs(q.x - birth.hopf_x) < 0.01 && std::fabs(q.frequency / birth.frequency - 1.0) < 0.05;
      });
      if (p == curve.points.end()) continue;
      const CycleBranch branch = charted.born_at(*p, birth.across.normalized());
      const StopFlag at_once{true};  // one place is enough
      for (const CycleCrossing& crossing : branch.crossings) {
        if (crossing.change != birth.change || found_) continue;
        CycleCurve place(charted.plane, *charted.plane.system(crossing.near.at), crossing);
        place.follow_from(crossing, &at_once, {});
        if (place.places().empty()) continue;
        found_ = true;
        point_ = place.places().front().point;
      }
    }
  }

  bool found() const { return found_; }
  const CurvePoint& point() const { return point_; }
  double value(bool along_x) const { return along_x ? point_.x : point_.y; }
  // Through the place, `off` to either side.
  ParameterLine line(bool along_x, double off) const {
    const Study study = study_with(charted_rotor(), along_x ? y_ : x_, along_x ? point_.y : point_.x);
    const double at = value(along_x);
    return {study, fmt::format("{}={:.12g}:{:.12g}:{:.12g}", along_x ? x_ : y_, at - off, at + off, 2.0 * off)};
  }
  // States at equal times of the cycle, swung further by a factor.
  std::vector<Eigen::VectorXd> states(const model::System& system, double factor) const {
    constexpr int count = 16;
    const double period = 2.0 * M_PI / point_.frequency;
    std::vector<Eigen::VectorXd> nodes{Eigen::Map<const Eigen::VectorXd>(point_.state.data(), 8)};
    Eigen::VectorXd middle = nodes[0] / count;
    for (int k = 1; k < count; ++k) {
      nodes.push_back(advance_state(system, nodes.back(), period / count).value());
      middle += nodes.back() / count;
    }
    for (Eigen::VectorXd& z : nodes) z = middle + factor * (z - middle);
    return nodes;
  }

 private:
  std::string x_, y_;
  bool found_ = false;
  CurvePoint point_;
};

int outside(const Motion& motion) { return unstable_multipliers(motion.orbit.decays()); }

// The cycle goes on across the curve. The place at which multipliers leave the unit circle, bracketed to 2^-14 of the
// line, is the curve's; they leave it as the curve's kind says.
void crosses(const BirthOfCycles& birth, bool along_x, double off) {
  const PlaceOnCurve place(birth);
  ASSERT_TRUE(place.found());
  const ParameterLine line = place.line(along_x, off);
  const BranchContinuation follower(line, 0, nullptr);
  double low = line.values().front(), high = line.values().back();
  const auto orbit = refine_orbit(line.system_at(low), place.states(line.system_at(place.value(along_x)), 1.0),
                                  2.0 * M_PI / place.point().frequency);
  ASSERT_TRUE(orbit);
  Motion below = describe_orbit(line.system_at(low), *orbit);
  const Advance way = follower.advance(below, low, high);
  ASSERT_TRUE(way.arrived);
  Motion above = way.motion;
  const int pair = birth.change == CurveKind::cycle_torus ? 2 : 1;
  ASSERT_EQ(std::abs(outside(above) - outside(below)), pair);
  EXPECT_EQ(std::min(outside(above), outside(below)), place.point().others);
  if (place.point().others == 0) {
    const auto events = changes_between(follower, {0, low, below}, {1, high, above});
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].cause,
              birth.change == CurveKind::cycle_torus ? BranchCause::neimark_sacker : BranchCause::period_doubling);
    EXPECT_LE(events[0].low, place.value(along_x));
    EXPECT_GE(events[0].high, place.value(along_x));
  }
  const int before = outside(below);
  for (int k = 0; k < 14; ++k) {
    const double middle = 0.5 * (low + high);
    const auto found = follower.refine(below, middle);
    ASSERT_TRUE(found) << middle;
    const bool like_below = outside(*found) == before;
    (like_below ? low : high) = middle;
    (like_below ? below : above) = *found;
  }
  EXPECT_LE(low, place.value(along_x) + 1e-7);
  EXPECT_GE(high, place.value(along_x) - 1e-7);
  std::complex<double> nearest(INFINITY, 0.0);
  for (const std::complex<double>& value : Eigen::VectorXcd(above.orbit.decays()))
    if (std::fabs(std::log(std::abs(value))) < std::fabs(std::log(std::abs(nearest)))) nearest = value;
  if (birth.change == CurveKind::cycle_torus)
    EXPECT_GT(std::fabs(nearest.imag()), 0.01);
  else
    EXPECT_NEAR(nearest.real(), -1.0, 1e-2);
}

TEST(CycleLines, ABranchAlongSpeedEndsWhereTheCurveOfFoldsIs) {
  const PlaceOnCurve place({CurveKind::cycle_fold,
                            {"speed.final", 1.84, 2.0, 16},
                            {"balancer.drag", 0.008, 0.03, 16},
                            1.93,
                            0.66,
                            {1.0, 0.0}});
  ASSERT_TRUE(place.found());
  const ParameterLine line = place.line(true, 2e-5);  // nearer than the Hopf curve
  const BranchContinuation follower(line, 0, nullptr);
  // On one side there is a stable cycle, which trajectories come to.
  int compared = 0;
  for (const bool rising : {true, false}) {
    const double from = rising ? line.values().front() : line.values().back(),
                 to = rising ? line.values().back() : line.values().front();
    for (const double factor : {1.05, 1.1, 1.2, 1.4}) {
      const auto orbit = refine_orbit(line.system_at(from), place.states(line.system_at(place.value(true)), factor),
                                      2.0 * M_PI / place.point().frequency);
      if (!orbit || !orbit->stable()) continue;
      const Advance way = follower.advance(describe_orbit(line.system_at(from), *orbit), from, to);
      EXPECT_FALSE(way.arrived);
      // It ends with the curve's swing, at a multiplier of 1: near balance, but not in it.
      EXPECT_EQ(cause_of_end(follower, way), BranchCause::fold);
      EXPECT_NEAR(cycle_swing(line.system_at(way.value), {way.motion.orbit.period, way.motion.orbit.nodes}),
                  place.point().swing, 0.05 * place.point().swing);
      EXPECT_GT(place.point().swing, 0.02);
      const Eigen::VectorXcd left = way.motion.orbit.decays();
      EXPECT_LT((left.array() - 1.0).abs().minCoeff(), 0.05);
      EXPECT_LE(std::min(way.value, way.refused), place.value(true) + 1e-7);
      EXPECT_GE(std::max(way.value, way.refused), place.value(true) - 1e-7);
      EXPECT_LT(std::fabs(way.value - way.refused), 1e-6);
      ++compared;
      break;
    }
  }
  EXPECT_EQ(compared, 1);
}

// Beyond a soft loss of balance a stable cycle grows out of it: followed back, it ends in balance.
TEST(CycleLines, ACycleThatShrinksToBalanceEndsInAHopfBifurcation) {
  const Study study = parse_study(R"([rotor]
eccentricity = 0.03
damping = 0.05
[balancer]
balls = 1
mass = 0.03
drag = 0.05
[speed]
profile = "constant"
speed = 1.485
)",
                                  "one ball");
  const ParameterLine line(study, "speed.final=1.485:1.495:0.01");
  const BranchContinuation follower(line, 0, nullptr);
  const model::System system = line.system_at(1.485);
  Eigen::VectorXd z = Eigen::VectorXd::Zero(6);
  z[4] = M_PI + 0.1;  // the ball next to the light side, from where it ends in the cycle
  z = advance_state(system, z, 4000.0).value();
  const double period = 2.0 * M_PI / 0.4;  // of the pair that crosses
  constexpr int count = 16;
  std::vector<Eigen::VectorXd> nodes{z};
  for (int k = 1; k < count; ++k) nodes.push_back(advance_state(system, nodes.back(), period / count).value());
  const auto orbit = refine_orbit(system, nodes, period);
  ASSERT_TRUE(orbit && orbit->stable());
  const Advance way = follower.advance(describe_orbit(system, *orbit), 1.485, 1.495);
  EXPECT_FALSE(way.arrived);
  EXPECT_NEAR(way.value, 1.48994, 1e-4);  // where the pair crosses: balance is stable beyond
  EXPECT_EQ(cause_of_end(follower, way), BranchCause::hopf);
}

TEST(CycleLines, ABranchAlongDragBecomesATorusWhereTheCurveOfToriIs) {
  crosses({CurveKind::cycle_torus,
           {"speed.final", 2.05, 2.15, 16},
           {"balancer.drag", 0.001, 0.004, 16},
           2.108,
           0.0712,
           {0.0, 1.0}},
          false, 2e-5);
}

TEST(CycleLines, ABranchAlongSpeedDoublesItsPeriodWhereTheCurveOfDoublingsIs) {
  crosses({CurveKind::cycle_flip,
           {"speed.final", 1.1, 1.6, 16},
           {"rotor.eccentricity", 0.005, 0.05, 16},
           1.54,
           0.205,
           {0.8, -0.6}},
          true, 1e-4);
}

}  // namespace cycle_lines_test
}  // namespace equipoise
