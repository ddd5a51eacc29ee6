// Curves and regions of locked states: against the closed form of two balls, eigenvalues, branches along one parameter,
// trajectories.
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/extras/charts/plane_reports.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/analyses/continuation/branch_follower.hpp"
#include "equipoise/extras/curves/bifurcation_chart.hpp"
#include "equipoise/extras/curves/locked_states.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "../support/studies.hpp"

namespace equipoise {
namespace locked_chart_test {

const std::string with_motor = R"([rotor]
eccentricity = 0.1
damping = 0.1
inertia = 0.5
[balancer]
balls = 2
mass = 0.01
drag = 0.05
[speed]
profile = "torque"
torque = { stall = 0.05, no_load_speed = 2.4 }
)";

Study study_of(const std::string& text) { return parse_study(text, "rotor"); }

BifurcationChart chart_of(const std::string& text, const SliceAxis& x, const SliceAxis& y, int threads = 1) {
  ChartSettings settings;
  settings.x = x;
  settings.y = y;
  settings.boxes = 0;
  settings.threads = threads;
  return bifurcation_chart(study_of(text), settings);
}

const BifurcationChart& over_unbalance() {
  static const BifurcationChart chart =
      chart_of(constant_speed, {"speed.final", 0.5, 3.0, 40}, {"rotor.eccentricity", 0.0, 0.2, 40});
  return chart;
}
const BifurcationChart& of_motor() {
  static const BifurcationChart chart =
      chart_of(with_motor, {"speed.torque.stall", 0.005, 0.2, 24}, {"rotor.damping", 0.02, 0.5, 24});
  return chart;
}

model::System system_at(const BifurcationChart& chart, double x, double y) {
  Study study = chart.plane.study;
  const auto put = [&](const std::string& key, double value) { study = study_with(study, key, value); };
  put(chart.plane.x.key, x);
  put(chart.plane.y.key, y);
  return study.system();
}

// All eigenvalues, of the whole Jacobian: unlike the search, which splits it by symmetry.
Eigen::VectorXcd eigenvalues_at(const BifurcationChart& chart, const CurvePoint& p) {
  const model::System system = system_at(chart, p.x, p.y);
  const Eigen::VectorXd state = Eigen::Map<const Eigen::VectorXd>(p.state.data(), system.dimension());
  EXPECT_LT(model::rate(system, state).lpNorm<Eigen::Infinity>(), 1e-9);
  return dense::eigenvalues(model::jacobian(system, state));
}
double nearest(const Eigen::VectorXcd& values, std::complex<double> value) {
  return (values.array() - value).abs().minCoeff();
}

TEST(LockedStates, AreAtRestAndAllThatRandomStartsFind) {
  for (const char* balls :
       {"balls = 2\nmass = 0.05", "balls = 3\nmass = 0.02", "balls = 3\nmass = [0.03, 0.01, 0.01]"}) {
    const Study study = study_of(with(with(constant_speed, "balls = 2\nmass = 0.05", balls), "0.01", "0.055"));
    const model::System system = study.system();
    std::vector<Eigen::VectorXd> known;
    for (const LockedKind& kind : locked_kinds(study.parameters))
      for (const Eigen::VectorXd& state : locked_states(system, kind)) {
        known.push_back(state);
        EXPECT_LT(model::rate(system, state).lpNorm<Eigen::Infinity>(), 1e-13) << balls << " " << kind.name;
      }
    EXPECT_GE(known.size(), 2u);
    // As exchange of alike balls leaves them: by the rotor's place.
    std::mt19937 random(3);
    std::uniform_real_distribution<> part(-1.0, 1.0);
    int found = 0;
    std::vector<bool> met(known.size(), false);
    for (int k = 0; k < 3000; ++k) {
      Eigen::VectorXd guess = Eigen::VectorXd::Zero(system.dimension());
      for (int i = 0; i < 2; ++i) guess[i] = 0.3 * part(random);
      guess[2] = -system.speed() * guess[1];
      guess[3] = system.speed() * guess[0];
      // Saddles are met from next to them only: half of the starts have the balls nearly in line with the rotor.
      const double line = std::atan2(guess[1], guess[0]), spread = k % 2 ? M_PI : 0.3;
      for (int i = 0; i < system.balls(); ++i)
        guess[model::index::phi(i)] = line + (part(random) < 0.0 ? M_PI : 0.0) + spread * part(random);
      const auto rest = refine_equilibrium(system, guess);
      if (!rest || rest->state.head(2).norm() < 1e-6) continue;
      ++found;
      bool is_known = false;
      for (std::size_t n = 0; n < known.size(); ++n)
        if ((rest->state.head(2) - known[n].head(2)).norm() < 1e-7) is_known = met[n] = true;
      EXPECT_TRUE(is_known) << balls << " " << rest->state.transpose();
    }
    EXPECT_GT(found, 100);
    EXPECT_TRUE(std::all_of(met.begin(), met.end(), [](bool one) { return one; })) << balls;
  }
}

// The last of the speeds that are looked at is the motor's highest: rounding must not lose it (here 80 s/80 > s).
TEST(LockedStates, AtAMotorsHighestSpeedAreFound) {
  const Study study = study_of(R"([rotor]
eccentricity = 0.07561111111111112
damping = 0.3
inertia = 0.6
[balancer]
balls = 2
mass = 0.03
drag = 0.05
[speed]
profile = "torque"
torque = { stall = 0.028388888888888887, no_load_speed = 4.0 }
load = { quadratic = 0.002, at = 2.0 }
)");
  const model::System system = study.system();
  double fastest = 0.0;
  for (const LockedKind& kind : locked_kinds(study.parameters))
    for (const Eigen::VectorXd& z : locked_states(system, kind)) fastest = std::max(fastest, z[system.layout().speed]);
  EXPECT_NEAR(fastest, 3.2295, 1e-3);  // where trajectories stay: Newton's method on equations written otherwise
}

// A control whose torque is limited holds no state that needs more: zeta Omega rho^2 is 9.6e-5 in the least.
TEST(LockedStates, NeedNoMoreThanTheLimitOfTheTorque) {
  const auto count = [](const char* limit) {
    const Study study = study_of(std::string(R"([rotor]
eccentricity = 0.05
damping = 0.3
inertia = 0.6
[balancer]
balls = 2
mass = 0.02
drag = 0.05
[speed]
profile = "torque"
initial = 2.5
torque = { gain = 0.2, integral = 0.02, limit = )") +
                                 limit +
                                 R"(, target = { profile = "constant", speed = 2.5 } }
)");
    std::size_t states = 0;
    for (const LockedKind& kind : locked_kinds(study.parameters)) states += locked_states(study.system(), kind).size();
    return states;
  };
  EXPECT_EQ(count("0.00005"), 0u);
  EXPECT_EQ(count("0.0005"), 1u);
  EXPECT_EQ(count("0.05"), 3u);
}

// One ball as heavy as the unbalance: one of the two states on the line is balance.
TEST(LockedStates, OfWhichOneIsBalanceAreTheOthers) {
  const Study study = study_of(R"([rotor]
eccentricity = 0.03
damping = 0.3
[balancer]
balls = 1
mass = 0.03
drag = 0.05
[speed]
profile = "constant"
speed = 2.4
)");
  const auto states = locked_states(study.system(), locked_kinds(study.parameters).front());
  ASSERT_EQ(states.size(), 1u);
  EXPECT_GT(states.front().head(2).norm(), 0.01);
}

// Where three unlike balls in line just reach, two real rates cross 0 together: no pair swings.
TEST(LockedChart, TwoEqualRealRatesAreNoPair) {
  const BifurcationChart chart = chart_of(R"([rotor]
eccentricity = 0.02
damping = 0.3
[balancer]
balls = 3
mass = [0.03, 0.02, 0.01]
drag = 0.05
[speed]
profile = "constant"
speed = 2.4
)",
                                          {"speed.final", 3.0, 6.0, 8}, {"rotor.eccentricity", 0.05, 0.07, 8});
  ASSERT_FALSE(chart.curves.empty());
  for (const ChartCurve& curve : chart.curves) EXPECT_NE(curve.kind, CurveKind::hopf) << curve.of;
}

// Gravity comes with the axis, though the study has none.
TEST(LockedChart, WhatAnAxisBringsIsRefusedToo) {
  EXPECT_THROW(chart_of(constant_speed, {"speed.final", 1.2, 2.0, 4}, {"rotor.gravity", 0.0, 0.1, 4}), InputError);
}

TEST(LockedChart, EveryPointHasTheEigenvaluesThatItsCurveStates) {
  int seen[5] = {};
  for (const BifurcationChart* chart : {&over_unbalance(), &of_motor()})
    for (const ChartCurve& curve : chart->curves) {
      if (curve.of == of_balance) continue;
      for (std::size_t k = 0; k < curve.points.size(); ++k) {
        const CurvePoint& p = curve.points[k];
        const bool end = k == 0 || k + 1 == curve.points.size();
        if (end && curve.ends[k == 0 ? 0 : 1] == CurveEnd::no_pair) continue;  // a double zero, with its square root
        const Eigen::VectorXcd values = eigenvalues_at(*chart, p);
        // Next to a double zero an eigenvalue is that of rounding, to its square root.
        const double gap = std::abs(values.array().abs().minCoeff());
        const double other = (values.array().abs() > gap).select(values.array().abs(), INFINITY).minCoeff();
        const double allowed =
            curve.kind == CurveKind::hopf ? 1e-9 + 1e-12 / (p.frequency + 1e-12) : 1e-9 + 1e-12 / other;
        EXPECT_LT(nearest(values, {0.0, curve.kind == CurveKind::hopf ? p.frequency : 0.0}), allowed)
            << curve_kind_names[static_cast<std::size_t>(curve.kind)] << " " << curve.of << " " << p.x << " " << p.y;
      }
      ++seen[static_cast<int>(curve.kind)];
    }
  EXPECT_GE(seen[static_cast<int>(CurveKind::fold)], 3);
  EXPECT_GE(seen[static_cast<int>(CurveKind::hopf)], 3);
  EXPECT_GE(seen[static_cast<int>(CurveKind::pitchfork)], 1);
}

TEST(LockedChart, TwoBallsTogetherMergeWhereTheClosedFormSays) {
  // lambda^2 (K^2 + zeta^2 W^2) = zeta^2 W^2 (2 mu)^2, K = 1 - (1 + 2 mu) W^2.
  int points = 0;
  for (const ChartCurve& curve : over_unbalance().curves) {
    if (curve.kind != CurveKind::fold) continue;
    EXPECT_EQ(curve.of, "balls together");
    for (const CurvePoint& p : curve.points) {
      const double stiff = 1.0 - 1.1 * p.x * p.x, damp = 0.5 * p.x;
      EXPECT_NEAR(p.y, damp * 0.1 / std::hypot(stiff, damp), 1e-10) << p.x;
      ++points;
    }
  }
  EXPECT_GT(points, 50);
  // Alike balls part where they just cancel the unbalance: there balance begins.
  for (const ChartCurve& curve : over_unbalance().curves)
    if (curve.kind == CurveKind::pitchfork) {
      for (const CurvePoint& p : curve.points) EXPECT_NEAR(p.y, 0.1, 1e-10);
    }
}

TEST(LockedChart, BranchesAlongOneParameterFoldAndSwingWhereTheCurvesAre) {
  const auto unbalance = [](CurveKind kind) { return kind == CurveKind::fold ? 0.08 : 0.12; };
  std::vector<double> folds, hopfs;
  for (const ChartCurve& curve : over_unbalance().curves) {
    if (curve.of != "balls together") continue;
    const double at = unbalance(curve.kind);
    for (std::size_t k = 1; k < curve.points.size(); ++k) {
      const CurvePoint &a = curve.points[k - 1], &b = curve.points[k];
      if ((a.y - at) * (b.y - at) > 0.0 || a.others > 0) continue;
      const double x = a.x + (at - a.y) / (b.y - a.y) * (b.x - a.x);
      (curve.kind == CurveKind::fold ? folds : hopfs) = {x};
    }
  }
  ASSERT_FALSE(folds.empty() || hopfs.empty());
  for (const auto& [places, kind] : {std::pair{&folds, CurveKind::fold}, {&hopfs, CurveKind::hopf}}) {
    const double x = places->front(), low = x - 0.02, high = x + 0.02;
    Study study = study_of(constant_speed);
    study.parameters.eccentricity = unbalance(kind);
    const ParameterLine line(study, "speed.final=" + std::to_string(low) + ":" + std::to_string(high) + ":0.04");
    const BranchContinuation follower(line, 0, nullptr);
    const auto motion_at = [&](double value) -> std::optional<Motion> {
      const model::System system = line.system_at(value);
      for (const Eigen::VectorXd& state : locked_states(system, locked_kinds(system.parameters()).front())) {
        const auto rest = refine_equilibrium(system, state);
        if (rest && rest->eigenvalues[0].real() < 0.0) return describe_equilibrium(system, *rest);
      }
      return std::nullopt;
    };
    const double from = motion_at(line.values().front()) ? line.values().front() : line.values().back();
    const double to = line.values().front() + line.values().back() - from;
    const auto begin = motion_at(from);
    ASSERT_TRUE(begin) << x;
    const Advance way = follower.advance(*begin, from, to);
    if (kind == CurveKind::fold) {
      EXPECT_FALSE(way.arrived);
      EXPECT_LE(std::min(way.value, way.refused), x + 1e-5);
      EXPECT_GE(std::max(way.value, way.refused), x - 1e-5);
      // Of motions that exchange of balls leaves as they are, branches call a fold what may also be a pitchfork.
      const BranchCause cause = cause_of_end(follower, way);
      EXPECT_TRUE(cause == BranchCause::fold || cause == BranchCause::pitchfork) << name_of(cause);
      continue;
    }
    ASSERT_TRUE(way.arrived);
    const BranchPoint first{0, from, *begin}, last{1, to, way.motion};
    const auto events = changes_between(follower, from < to ? first : last, from < to ? last : first);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].cause, BranchCause::hopf);
    EXPECT_LE(events[0].low, x + 1e-5);
    EXPECT_GE(events[0].high, x - 1e-5);
  }
}

TEST(LockedChart, SpecialPointsHaveTheEigenvaluesThatNameThem) {
  int seen[6] = {};
  for (const BifurcationChart* chart : {&over_unbalance(), &of_motor()})
    for (const SpecialPoint& p : chart->specials) {
      if (chart->curves[p.curve].of == of_balance) continue;
      CurvePoint at;
      at.x = p.x;
      at.y = p.y;
      at.state = p.state;
      Eigen::VectorXcd values = eigenvalues_at(*chart, at);
      std::sort(values.begin(), values.end(), [](auto a, auto b) { return std::abs(a) < std::abs(b); });
      ++seen[static_cast<int>(p.kind)];
      if (p.kind == SpecialKind::bogdanov_takens) {
        EXPECT_LT(std::abs(values[1]), 2e-4) << p.x;  // root of rounding
      }
      if (p.kind == SpecialKind::fold_hopf || p.kind == SpecialKind::zero_hopf) {
        EXPECT_LT(std::abs(values[0]), 1e-7) << p.x;
        EXPECT_LT(nearest(values, {0.0, p.frequency}), 1e-7) << p.x;
        EXPECT_GT(p.frequency, 0.01);
      }
      if (p.kind == SpecialKind::cusp) {
        EXPECT_LT(std::abs(values[0]), 1e-5) << p.x;
        EXPECT_GT(std::abs(values[1]), 1e-3) << p.x;
      }
    }
  EXPECT_GE(seen[static_cast<int>(SpecialKind::bogdanov_takens)], 2);
  EXPECT_GE(seen[static_cast<int>(SpecialKind::zero_hopf)], 2);
  EXPECT_GE(seen[static_cast<int>(SpecialKind::fold_hopf)], 1);
  EXPECT_GE(seen[static_cast<int>(SpecialKind::generalised_hopf)], 1);
  EXPECT_EQ(seen[static_cast<int>(SpecialKind::cusp)], 1);
}

TEST(LockedChart, FoldsMeetInACuspBeyondWhichTheMotorHasOneStateLess) {
  const BifurcationChart& chart = of_motor();
  for (const SpecialPoint& p : chart.specials)
    if (p.kind == SpecialKind::cusp) {
      // Both ways from it along the fold the states merge pairwise; there are two more between than outside.
      int least = 99, most = 0;
      for (int k = 0; k < 24; ++k) {
        const double x = p.x * (1.0 + 0.03 * std::cos(M_PI * k / 12.0)),
                     y = p.y * (1.0 + 0.03 * std::sin(M_PI * k / 12.0));
        const model::System system = system_at(chart, x, y);
        const int count = static_cast<int>(locked_states(system, locked_kinds(system.parameters()).front()).size());
        least = std::min(least, count);
        most = std::max(most, count);
      }
      EXPECT_EQ(most - least, 2) << p.x << " " << p.y;
    }
}

TEST(LockedChart, RegionsTellWhatTrajectoriesStayAt) {
  const BifurcationChart& chart = over_unbalance();
  double sum = 0.0;
  int stable_locked = 0;
  for (const ChartRegion& r : chart.regions) {
    sum += r.part;
    if (r.points < 4) continue;
    const model::System system = system_at(chart, r.x, r.y);
    const auto kinds = locked_kinds(system.parameters());
    for (std::size_t n = 0; n < kinds.size(); ++n) {
      int stable = 0, unstable = 0;
      for (const Eigen::VectorXd& state : locked_states(system, kinds[n])) {
        Eigen::VectorXd pushed = state;
        for (Eigen::Index i = 0; i < pushed.size(); ++i)
          pushed[i] += 1e-4 * std::cos(3.0 * static_cast<double>(i) + 1.0);
        const auto later = advance_state(system, pushed, 3000.0);
        (later && (*later - state).norm() < 1e-5 ? stable : unstable) += 1;
      }
      EXPECT_EQ(stable, r.locked[n].stable) << r.x << " " << r.y << " " << kinds[n].name;
      EXPECT_EQ(unstable, r.locked[n].unstable) << r.x << " " << r.y << " " << kinds[n].name;
      stable_locked += stable;
    }
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_GT(stable_locked, 0);
  EXPECT_EQ(chart.region_of.size(), chart.plane.points.size());
  for (std::size_t k = 0; k < chart.region_of.size(); ++k)
    EXPECT_EQ(chart.regions[static_cast<std::size_t>(chart.region_of[k])].balance, chart.plane.points[k].kind);
  EXPECT_TRUE(holds(result_text(chart), "balls together stable")) << result_text(chart);
  EXPECT_TRUE(holds(result_svg(chart, ""), ">A</text>"));
}

TEST(LockedChart, IsTheSameWhateverTheThreads) {
  const SliceAxis x{"speed.final", 0.5, 3.0, 20}, y{"rotor.eccentricity", 0.0, 0.2, 20};
  const BifurcationChart one = chart_of(constant_speed, x, y, 1), two = chart_of(constant_speed, x, y, 2);
  EXPECT_EQ(chart_csv(one), chart_csv(two));
  EXPECT_EQ(one.region_of, two.region_of);
}

TEST(LockedChart, SaysOfWhichRotorsItKnowsNoLockedStates) {
  const SliceAxis x{"speed.final", 1.0, 3.0, 4}, y{"balancer.drag", 0.02, 0.2, 4};
  const auto told = [&](const std::string& more) {
    return result_text(chart_of(with(constant_speed, "drag = 0.05\n", "drag = 0.05\n" + more), x, y));
  };
  EXPECT_FALSE(holds(told(""), "were not analysed"));
  EXPECT_TRUE(holds(told("stiction = 0.001\n"), "touching or sticking balls may rest anywhere"));
  EXPECT_TRUE(holds(told("contact_angle = 0.2\n"), "touching or sticking balls may rest anywhere"));
}

}  // namespace locked_chart_test
}  // namespace equipoise
