// Surveys of a tilting rotor, next to equations and trajectories in fixed axes: stability over a plane, sweeps,
// capacity, branches, maps and charts.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <set>
#include <string>
#include <vector>

#include "equipoise/analyses/basin_slices/basin_slice.hpp"
#include "equipoise/analyses/basin_slices/start_pixels.hpp"
#include "equipoise/analyses/continuation/continuation.hpp"
#include "equipoise/analyses/continuation/parameter_line.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/one_study/attractors.hpp"
#include "equipoise/analyses/sweeps/capacity.hpp"
#include "equipoise/analyses/sweeps/sweep.hpp"
#include "equipoise/analyses/sweeps/sweep_axis.hpp"
#include "equipoise/analyses/sweeps/sweep_plan.hpp"
#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/random.hpp"
#include "equipoise/extras/charts/plane_reports.hpp"
#include "equipoise/extras/curves/bifurcation_chart.hpp"
#include "equipoise/extras/stability/balance_at.hpp"
#include "equipoise/extras/stability/over_plane.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/study/contents/study.hpp"
#include "tilt_fixed_flow.hpp"

namespace equipoise {
namespace tilt_surveys_test {

using namespace tilting;

Study study(const std::vector<std::string>& overrides = {}) { return long_rotor_with(overrides); }

// The largest real part at a balanced state, by differences in fixed axes.
double fixed_growth(const Study& s, const std::array<double, model::max_balls>& phi) {
  const model::System system = s.system();
  return fixed_eigenvalues(system, model::balanced_state(system, system.speed(), phi.data())).real().maxCoeff();
}

double least_fixed_growth(const Study& s) {
  double least = 1e300;
  for (const auto& phi : model::balanced_states(s.parameters).angles) least = std::min(least, fixed_growth(s, phi));
  return least;
}

// Unlike balls of two planes leave four balanced states, each with rates of its own: the most stable one counts.
TEST(TiltStability, IsThatOfFixedAxes) {
  for (const std::vector<std::string>& overrides :
       {std::vector<std::string>{}, {"balancer.mass=[0.005, 0.006, 0.007, 0.004]", "speed.speed=2.9"}}) {
    StabilitySettings settings;
    settings.x = {"speed.final", 0.5, 4.5, 5};
    settings.y = {"rotor.tilt.transverse_inertia", 1.0, 5.0, 5};
    const StabilityPlane plane = stability(study(overrides), settings);
    ASSERT_EQ(plane.points.size(), 25u);
    int stable = 0, unstable = 0;
    for (std::size_t k = 0; k < plane.points.size(); ++k) {
      const BalancePoint& point = plane.points[k];
      const Study there = study_with(study_with(plane.study, "speed.final", settings.x.centre(k % 5)),
                                     "rotor.tilt.transverse_inertia", settings.y.centre(k / 5));
      EXPECT_EQ(point.kind == BalanceKind::none, model::balanced_states(there.parameters).angles.empty());
      EXPECT_EQ(point.kind == BalanceKind::none, point.margin < 0.0);
      if (point.kind == BalanceKind::none) continue;
      EXPECT_NEAR(point.growth, least_fixed_growth(there), same_eigenvalue);
      ++(point.kind == BalanceKind::stable ? stable : unstable);
    }
    EXPECT_GT(stable, 3);
    EXPECT_GT(unstable, 3);
    EXPECT_EQ(result_text(plane, {}).find("continuum"), std::string::npos);
  }
}

TEST(TiltStability, IsThatOfAttractors) {
  const Study s = study(damped({}));
  AttractorsOptions options;
  options.starts = 50;
  const AttractorsResult result = attractors(s, options);
  ASSERT_EQ(result.attractors.front().name, "balanced");
  EXPECT_NEAR(balance_at(s).growth, result.attractors.front().motion.spectrum.real().maxCoeff(), 1e-12);
  EXPECT_EQ(balance_at(s).kind, BalanceKind::stable);
}

// Of a continuum the text says so: three balls in a plane leave an angle free.
TEST(TiltStability, SaysWhichStatesFormAContinuum) {
  StabilitySettings settings;
  settings.x = {"speed.final", 3.0, 4.0, 2};
  settings.y = {"balancer.drag", 0.1, 0.2, 2};
  const std::vector<std::string> six{"balancer.balls=6", "balancer.plane=[2, 2, 2, -2, -2, -2]",
                                     "initial.phi=[0, 1, 2, 3, 4, 5]"};
  const StabilityPlane plane = stability(study(six), settings);
  EXPECT_NE(result_text(plane, {}).find("form a continuum"), std::string::npos);
  EXPECT_EQ(balance_margin(plane.study.parameters), plane.points.front().margin);
  EXPECT_TRUE(std::isfinite(plane.points.front().growth));
}

// Rodrigues and others (2011), figure 11, on supports that differ in X and Y: boundaries read at 2.48, 2.67 and 4.50.
TEST(TiltStability, OnSupportsThatDifferIsAsPublished) {
  const auto kind = [](double speed) {
    return balance_at(
               study({"rotor.eccentricity=1e-4", "rotor.eccentricity_angle=0", "rotor.tilt.misalignment=0",
                      "balancer.mass=1e-4", "rotor.stiffness=[1, 5]", "rotor.damping=[0.02, 0.1]",
                      "rotor.tilt.stiffness={ x = [0, 9], y = [0, 45] }",
                      "rotor.tilt.damping={ x = [0, 0.18], y = [0, 0.9] }", "speed.speed=" + std::to_string(speed)}))
        .kind;
  };
  EXPECT_EQ(kind(2.47), BalanceKind::unstable);
  EXPECT_EQ(kind(2.49), BalanceKind::stable);
  EXPECT_EQ(kind(2.66), BalanceKind::stable);
  EXPECT_EQ(kind(2.68), BalanceKind::unstable);
  EXPECT_EQ(kind(4.49), BalanceKind::unstable);
  EXPECT_EQ(kind(4.51), BalanceKind::stable);
}

// The margin is 0 or more exactly where angles are found that balance both planes.
TEST(TiltStability, TheMarginTellsWhereAStateExists) {
  RandomStream random;
  int none = 0, some = 0;
  for (int k = 0; k < 400; ++k) {
    model::Parameters p = study().parameters;
    p.eccentricity = 0.02 * random.uniform();
    p.eccentricity_angle = two_pi * random.uniform();
    p.tilt.misalignment = 0.02 * random.uniform();
    for (std::size_t i = 0; i < 4; ++i) p.mass[i] = 0.01 * random.uniform();
    const bool exists = model::balanced_states(p).kind != model::BalancedStates::Kind::none;
    EXPECT_EQ(balance_margin(p) >= 0.0, exists);
    ++(exists ? some : none);
  }
  EXPECT_GT(none, 50);
  EXPECT_GT(some, 50);
  EXPECT_LT(balance_margin(study({"balancer.plane=2"}).parameters), 0.0);
  EXPECT_TRUE(std::isnan(balance_margin(study({"balancer.plane=[2, 1, -1, -2]"}).parameters)));
}

// Couple unbalance beyond what both planes can cancel: for chi = (0.02 - 0.005) 2 / 2.75 one plane's balls lie in line.
TEST(TiltSurveys, SweepAndCapacityAreThoseOfEnsembles) {
  const std::vector<std::string> rotor = damped({"rotor.eccentricity_angle=0", "sampling.starts=24"});
  const StudySource source{long_rotor, "rotor", rotor};
  const SweepResult swept =
      sweep(SweepPlan(source, sweep_axes({"rotor.tilt.misalignment=0.005,0.012"}, false, "--over"), {}, "--over"));
  for (std::size_t k = 0; k < 2; ++k) {
    ASSERT_TRUE(swept.cells[k]);
    std::vector<std::string> own = rotor;
    own.push_back(k ? "rotor.tilt.misalignment=0.012" : "rotor.tilt.misalignment=0.005");
    const BasinResult alone = basin(study(own));
    const SweepCell& cell = *swept.cells[k];
    for (const OutcomeShare& o : alone.attractors)
      for (const SweepOutcome& there : cell.outcomes)
        if (there.name == o.name) {
          EXPECT_EQ(there.share.count, o.share.count) << o.name;
        }
    const auto at = std::find_if(cell.outcomes.begin(), cell.outcomes.end(), [&](const SweepOutcome& o) {
      return o.name == (k ? "locked (2 together)" : "balanced");
    });
    ASSERT_NE(at, cell.outcomes.end()) << k;
    EXPECT_EQ(at->share.count, 24u) << k;
  }
  CapacityOptions asked;
  asked.key = "rotor.tilt.misalignment";
  asked.from = 0.0105;  // the second value tried is beyond the boundary: few searches
  asked.to = 0.0145;
  asked.precision = 0.1;
  const CapacityResult capacity_there = capacity(SweepPlan(source, {}, {}, "--over"), asked);
  ASSERT_TRUE(capacity_there.cells[0] && capacity_there.cells[0]->value);
  EXPECT_NEAR(*capacity_there.cells[0]->value, 0.015 * 2.0 / 2.75, asked.precision * (asked.to - asked.from));
}

// An equilibrium is followed along the balls' mass as long as it exists, and its rates are those of fixed axes.
TEST(TiltBranches, FollowEquilibria) {
  const Study s = study(damped({"speed.speed=3"}));
  const ParameterLine line(s, "balancer.mass=0.002:0.0028:0.0004", "--along");
  ContinuationOptions options;
  options.starts = 50;
  const BranchesResult result = follow_attractors(s, line, options);
  const auto find = [&](const std::string& name) {
    return std::find_if(result.branches.begin(), result.branches.end(),
                        [&](const Branch& b) { return b.name == name; });
  };
  const auto locked = find("locked (2 together)"), balanced = find("balanced");
  ASSERT_NE(locked, result.branches.end());
  ASSERT_NE(balanced, result.branches.end());
  for (const auto& branch : {*locked, *balanced})
    for (const BranchPoint& point : branch.points) {
      const model::System system = line.system_at(point.value);
      const Eigen::VectorXcd fixed = fixed_eigenvalues(system, point.motion.state);
      EXPECT_NEAR(fixed.real().maxCoeff(), point.motion.spectrum.real().maxCoeff(), same_eigenvalue);
      EXPECT_EQ(point.motion.stable, fixed.real().maxCoeff() < 0.0) << point.value;
    }
  // The locked state ends, or stops attracting, where the balls are heavy enough: (22) of Rodrigues and others (2008).
  const double critical = 0.00261500;
  EXPECT_EQ(locked->points.front().value, 0.002);
  EXPECT_TRUE(locked->points.front().motion.stable);
  EXPECT_EQ(balanced->points.back().value, 0.0028);
  for (const BranchPoint& point : balanced->points) EXPECT_GT(point.value, critical);
  for (const BranchPoint& point : locked->points)
    if (point.motion.stable) {
      EXPECT_LT(point.value, critical);
    }
}

// Pixels over an initial slope and a ball's place come to what the same starts come to alone.
TEST(TiltMaps, PixelsComeToWhatTheirStartsComeTo) {
  const Study s = study({"rotor.damping=0.1", "rotor.tilt.damping=[0, 0.9]", "balancer.drag=0.05", "speed.speed=3",
                         "balancer.mass=0.0025", "initial.phi_dot=-1.5"});
  BasinSliceSettings settings;
  settings.x = {"initial.tilt_x", -0.02, 0.02, 5};
  settings.y = {"initial.phi_1", 0.0, two_pi, 5};
  const BasinSlice map = basin_slice(s, settings);
  EXPECT_NEAR(map.balance_margin.front(), 2.0 * (0.0025 - 0.00261500), 1e-6);
  BasinOptions options;
  std::vector<Outcome> outcomes;
  options.outcome = [&](const Outcome& outcome) { outcomes.push_back(outcome); };
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 5; ++column) {
      options.initial.push_back(s.initial);
      options.initial.back().tilt_x = settings.x.centre(column);
      options.initial.back().phi[0] = settings.y.centre(row);
    }
  Catalogue catalogue;
  basin(s, options, &catalogue);
  ASSERT_EQ(outcomes.size(), map.code.size());
  std::set<short> codes(map.code.begin(), map.code.end());
  EXPECT_GT(codes.size(), 2u);
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    const auto code =
        std::find_if(map.codes.begin(), map.codes.end(), [&](const OutcomeShare& c) { return c.id == map.code[k]; });
    ASSERT_NE(code, map.codes.end());
    const Attractor* alone = catalogue.find(outcomes[k].attractor);
    EXPECT_EQ(code->name, alone ? alone->name : "undecided") << k;
    if (k % 3 != 0 || !alone) continue;
    Study own = s;
    own.initial = options.initial[k];
    EXPECT_EQ(drifting_in_fixed_axes(own, 1e-9), drifting_by(alone->name)) << k;
  }
}

// The derivatives that the chart's criticality comes from, next to differences of the equations in fixed axes.
TEST(TiltCharts, HigherDerivativesAreThoseOfFixedAxes) {
  const Study s = study({"balancer.mass=[0.05, 0.06, 0.07, 0.04]", "rotor.tilt.stiffness=[0.3, 9]"});
  const model::System system = s.system();
  RandomStream random;
  const auto draw = [&] {
    VectorXd v(system.dimension());
    for (double& x : v) x = 2.0 * random.uniform() - 1.0;
    return v;
  };
  for (int k = 0; k < 5; ++k) {
    const VectorXd y = draw(), u = draw(), v = draw(), w = draw();
    const auto second = [&](const VectorXd& at, double step) {
      const auto rate = [&](double a, double b) { return fixed_rate(system, at + step * (a * u + b * v)); };
      return VectorXd((rate(1, 1) - rate(1, -1) - rate(-1, 1) + rate(-1, -1)) / (4.0 * step * step));
    };
    const VectorXd exact = model::second_derivative(system, y, u, v);
    EXPECT_LT((exact - second(y, 1e-4)).norm(), 1e-5 * exact.norm());
    const VectorXd third = model::third_derivative(system, y, u, v, w);
    constexpr double step = 2e-3;
    const VectorXd slope = (second(y + step * w, step) - second(y - step * w, step)) / (2.0 * step);
    EXPECT_LT((third - slope).norm(), 1e-3 * third.norm());
  }
}

// The real part of the eigenvalue nearest to i frequency, by differences in fixed axes.
double hopf_growth(const Study& s, double frequency) {
  const model::System system = s.system();
  const auto phi = model::balanced_states(s.parameters).angles.front();
  const Eigen::VectorXcd rates = fixed_eigenvalues(system, model::balanced_state(system, system.speed(), phi.data()));
  Eigen::Index nearest = 0;
  (rates.array() - Complex(0.0, frequency)).abs().minCoeff(&nearest);
  return rates[nearest].real();
}

// Rodrigues and others (2011), figure 14 (c): a supercritical Hopf bifurcation at 3.387 for balls of 0.01; eigenvalues
// of the equations in fixed axes cross there. (22) of 2008: a balanced state exists from 0.002615 on.
TEST(TiltCharts, HaveThePublishedBifurcations) {
  ChartSettings settings;
  settings.x = {"speed.final", 3.2, 3.6, 9};
  settings.y = {"balancer.mass", 0.0014, 0.0124, 11};
  const BifurcationChart chart = bifurcation_chart(study(), settings);
  ASSERT_TRUE(chart.complete);
  const CurvePoint* nearest = nullptr;
  int existence = 0;
  for (const ChartCurve& curve : chart.curves)
    for (const CurvePoint& point : curve.points) {
      if (curve.kind == CurveKind::existence) {
        EXPECT_NEAR(point.y, 0.00261500, 5e-9);
        // Both balls of one plane are in one place there, and those of the other are not.
        const Study beyond = study_with(study(), "balancer.mass", point.y * (1.0 + 1e-8));
        const auto phi = model::balanced_states(beyond.parameters).angles.front();
        EXPECT_LT(std::fabs(wrapped(phi[0] - phi[1])), 1e-3);
        EXPECT_GT(std::fabs(wrapped(phi[2] - phi[3])), 0.1);
        ++existence;
      }
      if (curve.kind != CurveKind::hopf) continue;
      const Study there = study_with(study_with(study(), "speed.final", point.x), "balancer.mass", point.y);
      EXPECT_NEAR(hopf_growth(there, point.frequency), 0.0, same_eigenvalue) << point.x << ", " << point.y;
      if (!nearest || std::fabs(point.y - 0.01) < std::fabs(nearest->y - 0.01)) nearest = &point;
    }
  EXPECT_GT(existence, 3);
  ASSERT_TRUE(nearest);
  EXPECT_NEAR(nearest->y, 0.01, 1e-4);
  EXPECT_NEAR(nearest->x, 3.3869559, 2e-3);
  EXPECT_NEAR(nearest->frequency, 0.888898, 1e-3);
  EXPECT_LT(nearest->lyapunov, 0.0);
  EXPECT_NE(result_text(chart, {}).find("all balls of one plane are in line"), std::string::npos);
  for (const BalanceBoundary& b : chart.plane.own->boundaries)
    if (!b.along_x && !b.upwards) {
      EXPECT_EQ(b.change, BalanceBoundary::Change::existence);
      EXPECT_NEAR(b.value, 0.00261500, 5e-9);
    }
}

}  // namespace tilt_surveys_test
}  // namespace equipoise
