// Points at which curves of cycles change their kind, and their ends: against differences of plain trajectories.
#include <algorithm>
#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/extras/charts/plane_reports.hpp"
#include "equipoise/extras/curves/cycle_curve.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "../support/charted_plane.hpp"

namespace equipoise {
namespace cycle_points_test {

// Special points of the curve on which cycles of one of two swings become tori, near a double Hopf point.
std::vector<SpecialPoint> of_tori(bool slow, const SliceAxis& speed, const SliceAxis& drag,
                                  const Eigen::Vector2d& across) {
  const ChartedPlane charted(speed, drag);
  for (const ChartCurve& curve : charted.chart.curves) {
    if (curve.kind != CurveKind::hopf || curve.of != of_balance) continue;
    for (const CurvePoint& p : curve.points) {
      if ((p.frequency < 0.3) != slow || p.x < 2.0935) continue;
      const CycleBranch branch = charted.born_at(p, across);
      for (const CycleCrossing& crossing : branch.crossings) {
        if (crossing.change != CurveKind::cycle_torus) continue;
        CycleCurve torus(charted.plane, *charted.plane.system(crossing.near.at), crossing);
        if (torus.follow_from(crossing, nullptr, {})) return torus.specials();
      }
      if (!branch.places.empty()) break;
    }
  }
  return {};
}

TEST(CyclePoints, AtResonancesTheMapOverThreeOrFourTurnsHasTwoMoreMultipliersOfOne) {
  int thirds = 0, quarters = 0;
  for (const SpecialPoint& p :
       of_tori(true, {"speed.final", 2.05, 2.15, 16}, {"balancer.drag", 0.00186, 0.003, 16}, {0.0, 1.0})) {
    if (p.kind != SpecialKind::resonance_1_3 && p.kind != SpecialKind::resonance_1_4) continue;
    const int turns = p.kind == SpecialKind::resonance_1_3 ? 3 : 4;
    const Eigen::VectorXd z = Eigen::Map<const Eigen::VectorXd>(p.state.data(), 8);
    const model::System system = charted_system(p.x, p.y);
    const double period = 2.0 * M_PI / p.frequency;
    EXPECT_LT((*advance_state(system, z, period) - z).norm(), 1e-8);
    double away[2];
    for (const int part : {1, 2}) {
      const Eigen::VectorXcd all = multipliers_by_differences(system, z, period, 2e-5 / part);
      double nearest = INFINITY;
      for (const std::complex<double>& value : all)
        if (value.imag() > 0.1) nearest = std::min(nearest, std::abs(std::pow(value, turns) - 1.0));
      away[part - 1] = nearest;
    }
    // The differences' error falls with the square of their step.
    EXPECT_LT(away[1], 1e-5) << p.x << " " << p.y;
    EXPECT_LT(away[1], std::max(0.5 * away[0], 1e-7)) << p.x << " " << p.y;
    ++(turns == 3 ? thirds : quarters);
  }
  EXPECT_GE(thirds, 1);
  EXPECT_GE(quarters, 1);
}

TEST(CyclePoints, AtAFoldTorusPointAPairIsOnTheUnitCircleAndASecondMultiplierIsOne) {
  int compared = 0;
  for (const SpecialPoint& p :
       of_tori(false, {"speed.final", 2.08, 2.11, 16}, {"balancer.drag", 0.001, 0.003, 16}, {0.6, 0.8})) {
    if (p.kind != SpecialKind::fold_torus) continue;
    const Eigen::VectorXd z = Eigen::Map<const Eigen::VectorXd>(p.state.data(), 8);
    const Eigen::VectorXcd all =
        multipliers_by_differences(charted_system(p.x, p.y), z, 2.0 * M_PI / p.frequency, 1e-5);
    Eigen::VectorXd from_one = (all.array() - 1.0).abs();
    std::sort(from_one.begin(), from_one.end());
    EXPECT_LT(from_one[0] * from_one[1], 1e-6) << p.x << " " << p.y;
    double nearest = INFINITY;
    for (const std::complex<double>& value : all)
      if (value.imag() > 0.1) nearest = std::min(nearest, std::fabs(std::abs(value) - 1.0));
    EXPECT_LT(nearest, 1e-6) << p.x << " " << p.y;
    ++compared;
  }
  EXPECT_GE(compared, 1);
}

TEST(CyclePoints, LongCyclesStayNearAStateAtRestFromWhichOneDirectionLeads) {
  const ChartedPlane charted({"speed.final", 2.0, 2.1, 16}, {"balancer.drag", 0.001, 0.004, 16});
  int compared = 0;
  for (const ChartCurve& curve : charted.chart.curves) {
    if (curve.kind != CurveKind::hopf || curve.of != of_balance || compared > 0) continue;
    const auto p = std::find_if(curve.points.begin(), curve.points.end(),
                                [](const CurvePoint& q) { return q.frequency < 0.1 && std::fabs(q.x - 2.05) < 0.01; });
    if (p == curve.points.end()) continue;
    const CycleBranch branch = charted.born_at(*p, {0.0, 1.0});
    ASSERT_FALSE(branch.places.empty());
    const CyclePlace &last = branch.places.back(), &first = branch.places.front();
    const model::System system = *charted.plane.system(last.at);
    // It has grown to the bound, nearly.
    EXPECT_GT(last.shape.period, 0.7 * longest_period(system, last.shape, 2.0 * M_PI / p->frequency));
    EXPECT_GT(last.shape.period, 1.5 * first.shape.period);
    // It nearly comes to rest once, at a state that it leaves along a direction in which that grows.
    std::vector<double> rates;
    Eigen::VectorXd z = last.shape.nodes.front(), slowest = z;
    double least = INFINITY;
    constexpr int parts = 400;
    for (int k = 0; k < parts; ++k) {
      rates.push_back(model::rate(system, z).cwiseQuotient(system.scale()).norm());
      if (rates.back() < least) least = rates.back(), slowest = z;
      z = advance_state(system, z, last.shape.period / parts).value();
    }
    EXPECT_LT(least, 0.01 * *std::max_element(rates.begin(), rates.end()));
    const auto rest = refine_equilibrium(system, slowest);
    ASSERT_TRUE(rest);
    EXPECT_LT((rest->state - slowest).cwiseQuotient(system.scale()).norm(), 0.1);
    const auto unstable = (rest->eigenvalues.real().array() > 1e-9).count();
    EXPECT_GE(unstable, 1);
    ++compared;
  }
  EXPECT_EQ(compared, 1);
}

TEST(CyclePoints, AClosedFoldHasItsCuspsAndToriEndOnItWhereASecondMultiplierIsOne) {
  Study study = charted_rotor();
  study.parameters.mass = {0.03, 0.025};
  ChartSettings settings =
      ChartedPlane::settings({"speed.final", 1.35, 1.49, 8}, {"rotor.eccentricity", 0.006, 0.0085, 8});
  settings.cycles = true;
  settings.threads = 2;
  const BifurcationChart chart = bifurcation_chart(study, settings);
  const auto count = [&](auto holds_for) {
    return std::count_if(chart.specials.begin(), chart.specials.end(), holds_for);
  };
  const auto apart = [](double x, double y, const auto& q) { return std::hypot((x - q.x) / 0.14, (y - q.y) / 0.0025); };
  EXPECT_EQ(count([](const SpecialPoint& p) { return p.kind == SpecialKind::fold_torus; }), 0);
  ASSERT_EQ(count([](const SpecialPoint& p) { return p.kind == SpecialKind::resonance_1_1; }), 2);
  ASSERT_EQ(count([](const SpecialPoint& p) { return p.kind == SpecialKind::cycle_cusp; }), 2);
  // As found in a plane in which the curve begins elsewhere.
  for (const auto& [x, y] : {std::pair{1.46847, 0.006267}, {1.38436, 0.007379}})
    EXPECT_EQ(count([&, x = x, y = y](const SpecialPoint& p) {
                return p.kind == SpecialKind::cycle_cusp && apart(x, y, p) < 5e-4;
              }),
              1)
        << x << " " << y;
  for (const SpecialPoint& p : chart.specials) {
    if (!is_of_cycles(chart.curves[p.curve].kind)) continue;
    study.speed.speed = p.x;
    study.parameters.eccentricity = p.y;
    const Eigen::VectorXd z = Eigen::Map<const Eigen::VectorXd>(p.state.data(), 8);
    const Eigen::VectorXcd all = multipliers_by_differences(study.system(), z, 2.0 * M_PI / p.frequency);
    Eigen::VectorXd from_one = (all.array() - 1.0).abs();
    std::sort(from_one.begin(), from_one.end());
    // With that of the shift in time two are 1, or three: each to a root of an error, their product to the error.
    if (p.kind == SpecialKind::resonance_1_1)
      EXPECT_LT(from_one[0] * from_one[1] * from_one[2], 1e-7) << p.x << " " << p.y;
    else
      EXPECT_LT(from_one[0] * from_one[1], 1e-6) << p.x << " " << p.y;
  }
  int ended = 0;
  for (const ChartCurve& curve : chart.curves) {
    if (curve.kind != CurveKind::cycle_torus || curve.ends[1] != CurveEnd::resonance) continue;
    const CurvePoint& end = curve.points.back();
    EXPECT_EQ(count([&](const SpecialPoint& p) {
                return p.kind == SpecialKind::resonance_1_1 && apart(end.x, end.y, p) < 1e-7;
              }),
              1)
        << end.x << " " << end.y;
    ++ended;
  }
  EXPECT_EQ(ended, 2);
}

TEST(CyclePoints, AStoppedChartSaysHowManyPlacesAreLeft) {
  BifurcationChart chart = ChartedPlane({"speed.final", 2.0, 2.1, 4}, {"balancer.drag", 0.01, 0.04, 4}).chart;
  EXPECT_FALSE(holds(result_text(chart), "PARTIAL"));
  const std::string whole = chart_answer(chart);
  chart.complete = false;
  EXPECT_NE(chart_answer(chart), whole);
  EXPECT_TRUE(holds(result_text(chart), "PARTIAL: stopped before all curves and boxes were done."));
  chart.cycles_left = 2;
  const std::string text = result_text(chart);
  EXPECT_TRUE(holds(text, "at least 2 places where cycles change were left.")) << text;
  EXPECT_FALSE(holds(text, "before all curves"));
  EXPECT_EQ(chart_answer(chart), whole);  // how balance is lost, and what is proved, were known before
}

}  // namespace cycle_points_test
}  // namespace equipoise
