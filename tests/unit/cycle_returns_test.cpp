// Curves of cycles that come back to cycles that they had before, at another time of their period.
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/extras/curves/cycle_curve.hpp"
#include "../support/charted_plane.hpp"

namespace equipoise {
namespace cycle_returns_test {

// Heavier balls in a rotor with more unbalance and damping than the paper's.
Study heavier() {
  Study study = charted_rotor();
  study.parameters.eccentricity = 0.02;
  study.parameters.damping = {0.08, 0.08};
  study.parameters.mass = {0.025, 0.025};
  return study;
}

// The first crossing that fits, of cycles born where a Hopf curve of `of` is nearest to this place, across the curve.
std::optional<CycleCrossing> crossing_of(const ChartedPlane& charted, const std::string& of, double speed, double drag,
                                         const std::function<bool(const CycleCrossing&)>& fits) {
  for (const ChartCurve& curve : charted.chart.curves) {
    if (curve.kind != CurveKind::hopf || curve.of != of) continue;
    const Eigen::VectorXd place = charted.plane.place(speed, drag);
    const auto nearer = [&](const CurvePoint& p, const CurvePoint& q) {
      return (charted.plane.place(p.x, p.y) - place).norm() < (charted.plane.place(q.x, q.y) - place).norm();
    };
    const auto p = std::min_element(curve.points.begin() + 1, curve.points.end() - 1, nearer);
    const Eigen::VectorXd along =
        (charted.plane.place(p[1].x, p[1].y) - charted.plane.place(p[-1].x, p[-1].y)).normalized();
    const CycleBranch branch = charted.born_at(*p, {-along[1], along[0]});
    const auto found = std::find_if(branch.crossings.begin(), branch.crossings.end(), fits);
    if (found != branch.crossings.end()) return *found;
  }
  return std::nullopt;
}

// Where the fold of doubled cycles ends, in a plane of these axes.
std::optional<SpecialPoint> end_of_doubled_fold(const SliceAxis& speed, const SliceAxis& drag,
                                                const Eigen::Vector2d& born, double least_drag) {
  const ChartedPlane charted(speed, drag, heavier());
  const auto crossing = crossing_of(charted, of_balance, born[0], born[1], [&](const CycleCrossing& c) {
    return c.change == CurveKind::cycle_fold && charted.plane.y(c.near.at) > least_drag;
  });
  if (!crossing) return std::nullopt;
  CycleCurve fold(charted.plane, *charted.plane.system(crossing->near.at), *crossing);
  if (!fold.follow_from(*crossing, nullptr, {})) return std::nullopt;
  EXPECT_EQ(std::count(fold.ends().begin(), fold.ends().end(), CurveEnd::single_cycle), 1);
  // It passes no place twice: beyond the end the same places would follow, and the plane's edge again.
  EXPECT_EQ(std::count(fold.ends().begin(), fold.ends().end(), CurveEnd::plane), 1);
  std::optional<SpecialPoint> end;
  for (const SpecialPoint& p : fold.specials())
    if (p.kind == SpecialKind::generalised_flip) end = p;
  return end;
}

TEST(CycleReturns, AFoldOfDoubledCyclesEndsWhereASingleCycleDoublesItsPeriod) {
  // On the way to the end one curve comes so near to the curve of period doublings that no next point is found; the
  // other one steps over the end and comes back.
  const auto near = end_of_doubled_fold({"speed.final", 1.15, 1.23, 16}, {"balancer.drag", 0.005, 0.09, 16},
                                        {1.18904, 0.005614}, 0.045);
  const auto over =
      end_of_doubled_fold({"speed.final", 0.8, 3.0, 32}, {"balancer.drag", 0.002, 0.3, 32}, {1.186098, 0.004355}, 0.0);
  ASSERT_TRUE(near && over);
  // Extrapolated from places 0.02 to 0.3 next to it: cut off at the product of their squares, some 1e-7.
  EXPECT_NEAR(near->x, over->x, 2.2 * 1e-7);
  EXPECT_NEAR(near->y, over->y, 0.3 * 1e-7);
  Study study = heavier();
  study.speed.speed = near->x;
  study.parameters.drag = {near->y, near->y};
  const model::System system = study.system();
  const Eigen::VectorXd z = Eigen::Map<const Eigen::VectorXd>(near->state.data(), 8);
  const double half = M_PI / near->frequency;
  const auto back = advance_state(system, z, half, 0.0, 1e-13);
  ASSERT_TRUE(back);
  EXPECT_LT((*back - z).norm(), 1e-3) << "states have odd parts, cut off at the product of three distances";
  const auto refined = refine_orbit(system, {z}, half);
  ASSERT_TRUE(refined);
  EXPECT_NEAR(refined->period, half, 1e-5);
  const Eigen::VectorXcd single = multipliers_by_differences(system, refined->nodes.front(), refined->period);
  // The doublings' curve passes here; its multiplier changes by about 100 over the plane.
  EXPECT_LT((single.array() + 1.0).abs().minCoeff(), 1e-4);
}

TEST(CycleReturns, AClosedCurveIsPassedOnceThoughCyclesBeginAtAnotherTime) {
  const ChartedPlane charted({"speed.final", 1.1, 1.3, 16}, {"balancer.drag", 0.002, 0.1, 16}, heavier());
  const auto crossing = crossing_of(charted, "balls opposite", 1.18445, 0.03539, [&](const CycleCrossing& c) {
    const double speed = charted.plane.x(c.near.at);
    return c.change == CurveKind::cycle_flip && speed > 1.115 && speed < 1.125;
  });
  ASSERT_TRUE(crossing);
  CycleCurve flip(charted.plane, *charted.plane.system(crossing->near.at), *crossing);
  ASSERT_TRUE(flip.follow_from(*crossing, nullptr, {}));
  EXPECT_EQ(flip.ends()[0], CurveEnd::closed);
  EXPECT_EQ(flip.ends()[1], CurveEnd::closed);
  // Its last places are on its first chords, and no others are.
  const auto& places = flip.places();
  ASSERT_GT(places.size(), 100u);
  const auto apart = [&](const CurvePlace& a, const CurvePlace& b) { return (a.at - b.at).head(2).norm(); };
  EXPECT_LT(apart(places.back(), places.front()), 3.0 * CurveFollower::longest_step);
  // The first node has moved along the cycle: states differ.
  EXPECT_GT((places.back().at - places.front().at).tail(8).norm(), 1e-3);
  for (std::size_t k = 10; k + 10 < places.size(); ++k) EXPECT_GT(apart(places[k], places.front()), 1e-3) << k;
  // Points at which a second multiplier is -1 are met once each. The orbit there, refined by another method, has two:
  // each to a root of an error, their product to the error.
  int doubled = 0;
  for (const SpecialPoint& p : flip.specials()) {
    if (p.kind != SpecialKind::resonance_1_2) continue;
    ++doubled;
    Study study = heavier();
    study.speed.speed = p.x;
    study.parameters.drag = {p.y, p.y};
    const model::System system = study.system();
    const double period = 2.0 * M_PI / p.frequency;
    constexpr int nodes = 16;
    std::vector<Eigen::VectorXd> guess{Eigen::Map<const Eigen::VectorXd>(p.state.data(), 8)};
    while (guess.size() < nodes) guess.push_back(*advance_state(system, guess.back(), period / nodes, 0.0, 1e-13));
    const auto refined = refine_orbit(system, guess, period);
    ASSERT_TRUE(refined);
    EXPECT_NEAR(refined->period, period, 1e-8);
    Eigen::VectorXd from = (refined->multipliers.array() + 1.0).abs();
    std::sort(from.begin(), from.end());
    EXPECT_LT(from[0] * from[1], 1e-6) << p.x << " " << p.y;
  }
  EXPECT_EQ(doubled, 2);
}

}  // namespace cycle_returns_test
}  // namespace equipoise
