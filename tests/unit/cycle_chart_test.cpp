// Curves on which cycles change: against finite differences of long trajectories, orbits refined on either side, the
// normal form at Hopf points.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/extras/charts/plane_reports.hpp"
#include "equipoise/extras/stability/plane_studies.hpp"
#include "equipoise/extras/curves/cycle_curve.hpp"
#include "equipoise/extras/cycles/cycle_branch.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/simulation/trajectory/study_equations.hpp"
#include "../support/charted_plane.hpp"

namespace equipoise {
namespace cycle_chart_test {

ChartSettings cycle_settings(double low_speed, double high_speed, double low_drag, double high_drag) {
  ChartSettings settings =
      ChartedPlane::settings({"speed.final", low_speed, high_speed, 16}, {"balancer.drag", low_drag, high_drag, 16});
  settings.cycles = true;
  return settings;
}

// Around a generalised Hopf point.
const BifurcationChart& around_generalised() {
  static const BifurcationChart chart = [] {
    ChartSettings settings = cycle_settings(1.84, 2.0, 0.008, 0.03);
    settings.threads = 2;
    return bifurcation_chart(charted_rotor(), settings);
  }();
  return chart;
}
// A torus curve near a double Hopf point, begun from a cycle of the faster swing: the chart would follow the slower
// one's, too.
const std::vector<CurvePlace>& torus_places() {
  static const std::vector<CurvePlace> places = [] {
    const ChartedPlane charted({"speed.final", 2.08, 2.11, 16}, {"balancer.drag", 0.001, 0.003, 16});
    for (const ChartCurve& curve : charted.chart.curves) {
      if (curve.kind != CurveKind::hopf || curve.of != of_balance) continue;
      for (const CurvePoint& p : curve.points) {
        if (p.frequency < 0.5 || p.x < 2.0935) continue;
        const CycleBranch branch = charted.born_at(p, {0.6, 0.8});
        for (const CycleCrossing& crossing : branch.crossings)
          if (crossing.change == CurveKind::cycle_torus) {
            CycleCurve torus(charted.plane, *charted.plane.system(crossing.near.at), crossing);
            if (torus.follow_from(crossing, nullptr, {})) return torus.places();
          }
        if (!branch.places.empty()) break;
      }
    }
    return std::vector<CurvePlace>();
  }();
  return places;
}

const ChartCurve* curve_of(const BifurcationChart& chart, CurveKind kind) {
  const auto found =
      std::find_if(chart.curves.begin(), chart.curves.end(), [&](const ChartCurve& c) { return c.kind == kind; });
  return found == chart.curves.end() ? nullptr : &*found;
}

Eigen::VectorXd state_of(const CurvePoint& p) {
  return Eigen::Map<const Eigen::VectorXd>(p.state.data(), static_cast<Eigen::Index>(p.state.size()));
}

std::vector<const CurvePoint*> some_points(const ChartCurve& curve, std::size_t count) {
  std::vector<const CurvePoint*> points;
  const std::size_t apart = std::max<std::size_t>(1, curve.points.size() / (count + 1));
  for (std::size_t k = apart; k + 1 < curve.points.size(); k += apart) points.push_back(&curve.points[k]);
  return points;
}

TEST(CycleChart, AtFoldsTwoMultipliersAreOneByDifferencesOfTrajectories) {
  int compared = 0;
  const ChartCurve* fold = curve_of(around_generalised(), CurveKind::cycle_fold);
  ASSERT_TRUE(fold);
  EXPECT_LT(fold->error, 1e-9);
  for (const CurvePoint* p : some_points(*fold, 5)) {
    const model::System system = charted_system(p->x, p->y);
    const double period = 2.0 * M_PI / p->frequency;
    const Eigen::VectorXd z = state_of(*p);
    EXPECT_LT((*advance_state(system, z, period) - z).norm(), 1e-9);
    const Eigen::VectorXcd all = multipliers_by_differences(system, z, period);
    // Two are 1, one of the shift in time: each to the root of an error, their polynomial to the error itself.
    Eigen::VectorXd from_one = (all.array() - 1.0).abs();
    std::sort(from_one.begin(), from_one.end());
    EXPECT_LT(from_one[0] * from_one[1], 1e-7) << p->x << " " << p->y;
    EXPECT_GT(from_one[2], 0.1);
    const auto outside = (all.array().abs() > 1.01).count();
    EXPECT_EQ(outside, p->others) << p->x << " " << p->y;
    ++compared;
  }
  EXPECT_GE(compared, 4);
}

// The orbit near a curve's cycle in another system.
std::optional<PeriodicOrbit> near_cycle(const model::System& system, const CurvePoint& p) {
  return refine_orbit(system, {state_of(p)}, 2.0 * M_PI / p.frequency);
}

// Orbits that Newton's method finds from the curve's cycle, made a tenth larger and smaller.
std::vector<PeriodicOrbit> orbits_near(const model::System& system, const CurvePoint& p) {
  const double period = 2.0 * M_PI / p.frequency;
  std::vector<Eigen::VectorXd> nodes{state_of(p)};
  Eigen::VectorXd middle = nodes[0] / 8.0;
  for (int k = 1; k < 8; ++k) {
    nodes.push_back(advance_state(charted_system(p.x, p.y), nodes.back(), period / 8.0).value());
    middle += nodes.back() / 8.0;
  }
  std::vector<PeriodicOrbit> found;
  for (const double factor : {1.1, 0.9}) {
    std::vector<Eigen::VectorXd> guess;
    for (const Eigen::VectorXd& z : nodes) guess.push_back(middle + factor * (z - middle));
    auto orbit = refine_orbit(system, guess, period);
    if (orbit && std::fabs(cycle_swing(system, {orbit->period, orbit->nodes}) / p.swing - 1.0) < 0.5)
      found.push_back(*std::move(orbit));
  }
  return found;
}

TEST(CycleChart, TwoCyclesExistOnOneSideOfAFoldAndNoneOnTheOther) {
  const ChartCurve* fold = curve_of(around_generalised(), CurveKind::cycle_fold);
  ASSERT_TRUE(fold);
  int compared = 0;
  for (const CurvePoint* p : some_points(*fold, 4)) {
    if (p->others > 0 || p->swing < 0.045) continue;
    // Nearer to the fold than the Hopf curve is, where one of the two ends.
    const double off = 2e-6;
    auto two = orbits_near(charted_system(p->x, p->y + off), *p),
         none = orbits_near(charted_system(p->x, p->y - off), *p);
    const double side = two.size() > none.size() ? 1.0 : -1.0;
    if (side < 0.0) two.swap(none);
    ASSERT_EQ(two.size(), 2u) << p->x << " " << p->y;
    EXPECT_EQ(none.size(), 0u) << p->x << " " << p->y;
    EXPECT_EQ(two[0].stable() + two[1].stable(), 1) << p->x << " " << p->y;
    // The stable one holds a trajectory. From the same state none is held on the other side.
    const PeriodicOrbit& held = two[0].stable() ? two[0] : two[1];
    const auto change = [&](double drag) {
      const model::System system = charted_system(p->x, drag);
      const Eigen::VectorXd z = advance_state(system, held.nodes[0], 2000 * held.period).value();
      const auto swing = [&](const Eigen::VectorXd& from) {
        return cycle_swing(system, {held.period, std::vector<Eigen::VectorXd>{from}});
      };
      return std::fabs(swing(z) / swing(held.nodes[0]) - 1.0);
    };
    EXPECT_LT(change(p->y + side * off), 1e-3) << p->x << " " << p->y;
    EXPECT_GT(change(p->y - side * off), 0.01) << p->x << " " << p->y;
    ++compared;
  }
  EXPECT_GE(compared, 2);
}

TEST(CycleChart, FoldsBeginAtGeneralisedHopfPointsAlongTheHopfCurve) {
  const BifurcationChart& chart = around_generalised();
  const ChartCurve* fold = curve_of(chart, CurveKind::cycle_fold);
  ASSERT_TRUE(fold);
  const auto point = std::find_if(chart.specials.begin(), chart.specials.end(),
                                  [](const SpecialPoint& p) { return p.kind == SpecialKind::generalised_hopf; });
  ASSERT_NE(point, chart.specials.end());
  const bool first = fold->ends[0] == CurveEnd::vanishes;
  ASSERT_TRUE(first || fold->ends[1] == CurveEnd::vanishes);
  std::vector<CurvePoint> points = fold->points;
  if (!first) std::reverse(points.begin(), points.end());
  EXPECT_EQ(points.front().x, point->x);
  EXPECT_EQ(points.front().y, point->y);
  EXPECT_EQ(points.front().swing, 0.0);
  // Its distance from there grows with the square of the swing.
  const auto distance = [&](const CurvePoint& p) {
    return std::hypot((p.x - point->x) / (2.0 - 1.84), (p.y - point->y) / 0.022) / (p.swing * p.swing);
  };
  const double near = distance(points[3]);
  int compared = 0;
  for (std::size_t k = 4; k < points.size() && points[k].swing < 0.025; ++k, ++compared)
    EXPECT_NEAR(distance(points[k]) / near, 1.0, 0.1) << points[k].swing;
  EXPECT_GE(compared, 2);
  // It is tangent to the Hopf curve: balance's pair grows by the fourth power of the swing only.
  const auto growth = [&](const CurvePoint& p) {
    Study study = charted_rotor();
    study.speed.speed = p.x;
    study.parameters.drag = {p.y, p.y};
    return std::fabs(nearest_pair(balance_spectrum(study)->rates, {0.0, p.frequency * p.frequency, {}})->mean) /
           std::pow(p.swing, 4.0);
  };
  const auto at_swing = [&](double swing) {
    return *std::find_if(points.begin() + 1, points.end(), [&](const CurvePoint& p) { return p.swing >= swing; });
  };
  EXPECT_NEAR(growth(at_swing(0.02)) / growth(at_swing(0.03)), 1.0, 0.2);
}

TEST(CycleChart, SmallCyclesSwingAsTheNormalFormSays) {
  const BifurcationChart& chart = around_generalised();
  const PlaneStudies plane(charted_rotor(), chart.plane.x, chart.plane.y);
  int compared = 0;
  for (const ChartCurve& curve : chart.curves) {
    if (curve.kind != CurveKind::hopf || curve.of != of_balance) continue;
    const CurvePoint& p = curve.points[curve.points.size() - 4];
    ASSERT_GT(std::fabs(p.lyapunov), 1e-3);
    const CycleStart start{plane.place(p.x, p.y), Eigen::Vector2d(0.0, 1.0), state_of(p), p.frequency};
    const CycleBranch branch =
        cycle_branch([&](const Eigen::VectorXd& at) { return plane.system(at); }, start, nullptr);
    ASSERT_GT(branch.places.size(), 3u);
    for (const CyclePlace& place : branch.places) {
      if (place.swing > 0.012) break;
      const auto spectrum = plane.spectrum(place.at);
      const double growth = nearest_pair(spectrum->rates, {0.0, p.frequency * p.frequency, {}})->mean;
      EXPECT_NEAR(place.swing / std::sqrt(-growth / p.lyapunov), 1.0, 0.05) << place.swing;
      ++compared;
    }
  }
  EXPECT_GE(compared, 2);
}

TEST(CycleChart, AtTorusPointsAPairIsOnTheUnitCircleAndCrossesIt) {
  ChartCurve torus;
  for (const CurvePlace& place : torus_places()) torus.points.push_back(place.point);
  ASSERT_GT(torus.points.size(), 10u);
  int compared = 0;
  for (const CurvePoint* p : some_points(torus, 8)) {
    const double period = 2.0 * M_PI / p->frequency;
    const Eigen::VectorXcd all = multipliers_by_differences(charted_system(p->x, p->y), state_of(*p), period);
    double nearest = INFINITY;
    for (const std::complex<double>& value : all)
      if (value.imag() > 0.01) nearest = std::min(nearest, std::fabs(std::abs(value) - 1.0));
    EXPECT_LT(nearest, 1e-7) << p->x << " " << p->y;
    // On either side the cycle goes on, with two more multipliers outside on one.
    if (p->swing < 0.04) continue;
    const CurvePoint& q = *(p + 1);
    const double wide = 0.03, high = 0.002, norm = std::hypot((q.x - p->x) / wide, (q.y - p->y) / high);
    const auto outside = [&](double side) {
      const auto orbit = near_cycle(charted_system(p->x - side * wide * (q.y - p->y) / high / norm,
                                                   p->y + side * high * (q.x - p->x) / wide / norm),
                                    *p);
      return orbit ? unstable_multipliers(orbit->decays()) : -1;
    };
    const int one = outside(2e-5), other = outside(-2e-5);
    EXPECT_EQ(std::min(one, other), p->others) << p->x << " " << p->y;
    EXPECT_EQ(std::max(one, other), p->others + 2) << p->x << " " << p->y;
    ++compared;
  }
  EXPECT_GE(compared, 2);
  // It begins where two swings begin at once.
  EXPECT_LT(std::min(torus.points.front().swing, torus.points.back().swing), 0.02);
}

TEST(CycleChart, AtAPeriodDoublingAMultiplierIsMinusOne) {
  const ChartedPlane charted({"speed.final", 1.1, 1.6, 16}, {"rotor.eccentricity", 0.005, 0.05, 16});
  int compared = 0;
  for (const ChartCurve& curve : charted.chart.curves) {
    if (curve.kind != CurveKind::hopf || curve.of != of_balance) continue;
    const auto p = std::find_if(curve.points.begin(), curve.points.end(), [](const CurvePoint& q) {
      return std::fabs(q.x - 1.54) < 0.01 && std::fabs(q.frequency - 0.205) < 0.01;
    });
    if (p == curve.points.end()) continue;
    const CycleBranch branch = charted.born_at(*p, {0.8, -0.6});
    const StopFlag at_once{true};  // the first place is enough
    for (const CycleCrossing& crossing : branch.crossings) {
      if (crossing.change != CurveKind::cycle_flip) continue;
      CycleCurve flip(charted.plane, *charted.plane.system(crossing.near.at), crossing);
      flip.follow_from(crossing, &at_once, {});
      ASSERT_FALSE(flip.places().empty());
      const CurvePoint& q = flip.places()[0].point;
      const model::System system = *charted.plane.system(flip.places()[0].at);
      const auto nearest = [&](double step) {
        const auto all = multipliers_by_differences(system, state_of(q), 2.0 * M_PI / q.frequency, step);
        Eigen::Index k = 0;
        (all.array() + 1.0).abs().minCoeff(&k);
        return all[k].real() + 1.0;
      };
      // What is left is the differences' error: the square of their step, times third derivatives over a long period.
      const double coarse = nearest(2e-5), fine = nearest(1e-5);
      EXPECT_LT(std::fabs(fine), 1e-5) << q.x << " " << q.y;
      EXPECT_NEAR(coarse / fine, 4.0, 0.4) << fine;
      EXPECT_LT(std::fabs((4.0 * fine - coarse) / 3.0), 1e-6) << q.x << " " << q.y;
      ++compared;
      break;
    }
  }
  EXPECT_GE(compared, 1);
}

TEST(CycleChart, TellsOfCyclesOnlyWhenAsked) {
  ChartSettings settings = cycle_settings(1.9, 1.95, 0.016, 0.026);
  settings.cycles = false;
  const BifurcationChart without = bifurcation_chart(charted_rotor(), settings);
  EXPECT_FALSE(without.curves.empty());
  for (const ChartCurve& curve : without.curves) EXPECT_FALSE(is_of_cycles(curve.kind));
  EXPECT_FALSE(holds(result_text(without), "fold of cycles"));
  const std::string text = result_text(around_generalised());
  EXPECT_TRUE(holds(text, "fold of cycles")) << text;
  EXPECT_TRUE(holds(text, "a stable cycle")) << text;
  EXPECT_TRUE(holds(text, "Curves of cycles end, by number: ")) << text;
  EXPECT_TRUE(holds(text, "where the cycle shrinks to a state at rest")) << text;
  EXPECT_FALSE(holds(result_text(without), "Curves of cycles end"));
  EXPECT_FALSE(holds(text, "Cycles were not analysed"));
  EXPECT_TRUE(holds(result_svg(around_generalised(), "rotor"), "two cycles merge"));
  EXPECT_FALSE(holds(result_svg(without, "rotor"), "two cycles merge"));
  EXPECT_TRUE(holds(json_text(around_generalised()), "\"swing\""));
}

TEST(CycleChart, TheEquationsRestInTheStatesOfItsPoints) {
  ChartSettings settings = cycle_settings(1.9, 1.95, 0.016, 0.026);
  settings.cycles = false;
  const BifurcationChart chart = bifurcation_chart(charted_rotor(), settings);
  int states = 0;
  for (const auto& curve : chart.curves)
    for (const CurvePoint& p : curve.points) {
      if (p.state.empty()) continue;
      const Study study = parse_study(to_toml(chart.plane.study), "rotor",
                                      {fmt::format("speed.speed={}", p.x), fmt::format("balancer.drag={}", p.y)});
      const StudyEquations equations(study);
      ASSERT_EQ(static_cast<std::size_t>(equations.dimension()), p.state.size());
      std::vector<double> rates(p.state.size());
      equations.rhs(0.0, p.state.data(), rates.data());
      for (const double rate : rates) EXPECT_NEAR(rate, 0.0, 1e-12);
      ++states;
    }
  EXPECT_GT(states, 10);
}

TEST(CycleChart, SaysWhyItTellsNothingOfCycles) {
  const Study touching = parse_study(with(constant_speed, "balls = 2", "balls = 2\ncontact_angle = 0.2"), "rotor");
  ChartSettings settings = cycle_settings(1.9, 1.95, 0.016, 0.026);
  settings.x.pixels = settings.y.pixels = 4;
  const BifurcationChart chart = bifurcation_chart(touching, settings);
  EXPECT_TRUE(holds(result_text(chart), "touching or sticking balls break them off"));
  settings.cycles = false;
  EXPECT_FALSE(holds(result_text(bifurcation_chart(touching, settings)), "Cycles were not analysed"));
}

TEST(CycleChart, AStoppedSearchHasTheCurvesOfTheCyclesThatItGotTo) {
  ChartSettings settings = cycle_settings(1.84, 2.0, 0.008, 0.03);
  settings.threads = 8;
  StopFlag stop{false};
  settings.stop = &stop;
  Progress last;
  settings.progress = [&](const Progress& p) {
    if (p.what != "cycles") return;
    last = p;
    stop = 2 * p.done >= p.total;
  };
  const BifurcationChart chart = bifurcation_chart(charted_rotor(), settings);
  EXPECT_FALSE(chart.complete);
  EXPECT_LT(last.done, last.total);
  const ChartCurve* whole = curve_of(around_generalised(), CurveKind::cycle_fold);
  const ChartCurve* found = curve_of(chart, CurveKind::cycle_fold);
  ASSERT_TRUE(whole && found);
  EXPECT_EQ(found->points.size(), whole->points.size());
  EXPECT_TRUE(holds(result_text(chart), "PARTIAL"));
}

TEST(CycleChart, ThreadsMakeNoDifference) {
  ChartSettings settings = cycle_settings(1.84, 2.0, 0.008, 0.03);
  settings.threads = 1;
  EXPECT_EQ(chart_csv(around_generalised()), chart_csv(bifurcation_chart(charted_rotor(), settings)));
}

}  // namespace cycle_chart_test
}  // namespace equipoise
