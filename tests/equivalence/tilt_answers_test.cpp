// What a tilting rotor comes to, next to equations and trajectories in fixed axes: equilibria, eigenvalues, outcomes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/one_study/attractors.hpp"
#include "equipoise/attractors/equilibria/equilibria.hpp"
#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/attractors/motions/motion_description.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/study/contents/study.hpp"
#include "tilt_fixed_flow.hpp"

namespace equipoise {
namespace tilt_answers_test {

using namespace tilting;

Study study(const std::vector<std::string>& overrides = {}) { return long_rotor_with(overrides); }

// Distance from the axis of the section at z.
double off_axis(const model::System& system, const VectorXd& y, double z) {
  const int t = system.layout().tilt;
  return std::hypot(y[0] + z * y[t], y[1] + z * y[t + 1]);
}

struct Rest {
  std::vector<std::string> overrides;
  const char* name;
};

// Balls too light for their race's share: together on the light side. The other race, whose share they can cancel, is
// centred with its balls apart.
const std::vector<Rest> rests{
    {damped({"speed.speed=3", "balancer.mass=0.002"}), "locked (2 together)"},
    {damped({"speed.speed=1.2", "balancer.mass=0.0028"}), "locked (2 and 2 together)"},
    {damped({"speed.speed=3", "rotor.eccentricity=0.05", "rotor.eccentricity_angle=0", "rotor.tilt.misalignment=0"}),
     "locked together"}};

TEST(TiltEquilibria, HaveTheEigenvaluesOfFixedAxes) {
  for (const Rest& rest : rests) {
    const Study s = study(rest.overrides);
    const model::System system = s.system();
    const std::vector<Equilibrium> all = unbalanced_equilibria(system, 100);
    ASSERT_GT(all.size(), 2u) << rest.name;
    int stable = 0;
    for (const Equilibrium& e : all) {
      EXPECT_LT(fixed_rate(system, e.state).lpNorm<Eigen::Infinity>(), 1e-12);
      const Eigen::VectorXcd fixed = fixed_eigenvalues(system, e.state);
      EXPECT_LT(farthest(e.eigenvalues, fixed), same_eigenvalue);
      EXPECT_LT(farthest(fixed, e.eigenvalues), same_eigenvalue);
      if (!attracts(e.eigenvalues, 0)) continue;
      ++stable;
      const Motion motion = describe_equilibrium(system, e);
      EXPECT_EQ(motion_name(s.parameters, motion).name, rest.name);
      const double upper = off_axis(system, e.state, 2.0), lower = off_axis(system, e.state, -2.0);
      EXPECT_EQ(std::min(upper, lower) < 1e-9, std::string(rest.name) == "locked (2 together)");
      EXPECT_GT(std::max(upper, lower), 1e-3);
    }
    EXPECT_EQ(stable, 1) << rest.name;
  }
}

// Two light balls in one race cannot cancel its share; three in the other leave an angle free, and that race centred.
TEST(TiltEquilibria, WithAFreeAngleAreOneContinuum) {
  const Study s = study(damped({"speed.speed=3", "balancer.balls=5", "balancer.mass=0.002",
                                "balancer.plane=[2, 2, -2, -2, -2]", "initial.phi=[0, 1, 2, 3, 4]"}));
  const model::System system = s.system();
  AttractorsOptions options;
  options.starts = 60;
  const AttractorsResult result = attractors(s, options);
  ASSERT_EQ(result.attractors.size(), 1u) << result_text(result);
  const Attractor& a = result.attractors.front();
  EXPECT_EQ(a.name, "locked (2 together)");
  ASSERT_TRUE(a.continuum);
  EXPECT_EQ(a.continuum->drawn, 256);
  EXPECT_EQ(a.continuum->stable, 256);
  EXPECT_LT(a.continuum->slowest_rate, 0.0);
  EXPECT_NE(result_text(result).find("of the continuum"), std::string::npos);
  // One zero, all other eigenvalues within the range; another member rests as well.
  Eigen::VectorXcd fixed = fixed_eigenvalues(system, a.motion.state);
  std::sort(fixed.begin(), fixed.end(), [](Complex p, Complex q) { return std::abs(p) < std::abs(q); });
  EXPECT_LT(std::abs(fixed[0]), same_eigenvalue);
  const double slowest = fixed.tail(fixed.size() - 1).real().maxCoeff();
  EXPECT_LT(slowest, a.continuum->slowest_rate + same_eigenvalue);
  EXPECT_GT(slowest, a.continuum->fastest_rate - same_eigenvalue);
  EXPECT_EQ(free_angles(system, a.motion.state), 1);
  int others = 0;
  for (double turn = -0.6; turn < 0.7; turn += 0.4) {
    VectorXd beside = a.motion.state;
    beside[model::index::phi(2)] += turn;
    const auto e = refine_equilibrium(system, beside);
    ASSERT_TRUE(e);
    EXPECT_LT(fixed_rate(system, e->state).lpNorm<Eigen::Infinity>(), 1e-10);
    EXPECT_TRUE(same_continuum(system, a.motion.state, e->state));
    others += (e->state - a.motion.state).lpNorm<Eigen::Infinity>() > 0.05;
  }
  EXPECT_GT(others, 2);
  // Where two balls run in either race no angle is free.
  const Study isolated = study(rests[0].overrides);
  for (const Equilibrium& e : unbalanced_equilibria(isolated.system(), 50))
    EXPECT_EQ(free_angles(isolated.system(), e.state), 0);
}

// Each equilibrium is listed once, whatever balls of one race exchange.
TEST(TiltEquilibria, AreListedOnce) {
  const model::System system = study(rests[0].overrides).system();
  const std::vector<Equilibrium> few = unbalanced_equilibria(system, 200), many = unbalanced_equilibria(system, 400);
  EXPECT_GE(many.size(), few.size());
  EXPECT_LE(many.size(), few.size() + 2);
  for (std::size_t i = 0; i < many.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_FALSE(same_motion(system.parameters(), describe_equilibrium(system, many[i]),
                               describe_equilibrium(system, many[k])));
}

// At rest under a motor all that it gives goes into the supports' dampers, of centre and slope.
TEST(TiltEquilibria, TakeTheMotorsPower) {
  const model::System held = study(rests[0].overrides).system();
  std::vector<std::string> overrides = rests[0].overrides;
  overrides.push_back("rotor.tilt.damping=[0.1, 1.8]");
  overrides.push_back(
      "speed={ profile = \"torque\", initial = 3.0, torque = { stall = 0.001, no_load_speed = 3.02 } }");
  const model::System driven = study(overrides).system();
  VectorXd guess = VectorXd::Zero(driven.dimension());
  const VectorXd at = unbalanced_equilibria(held, 100).front().state;
  model::copy_state(held.layout(), at.data(), driven.layout(), guess.data());
  guess[driven.layout().speed] = 3.0;
  const auto found = refine_equilibrium(driven, guess);
  ASSERT_TRUE(found);
  const Motion motion = describe_equilibrium(driven, *found);
  ASSERT_TRUE(motion.motor);
  EXPECT_GT(motion.motor->power, 1e-6);
  EXPECT_NEAR(motion.motor->support_power, motion.motor->power, 1e-8 * motion.motor->power);
}

TEST(TiltEquilibria, AreAttractorsWithShares) {
  for (const Rest& rest : rests) {
    const Study s = study(rest.overrides);
    AttractorsOptions options;
    options.starts = 100;
    const AttractorsResult result = attractors(s, options);
    const auto at = std::find_if(result.attractors.begin(), result.attractors.end(),
                                 [&](const Attractor& a) { return a.name == rest.name; });
    ASSERT_NE(at, result.attractors.end()) << rest.name;
    const auto share = std::find_if(result.basin.attractors.begin(), result.basin.attractors.end(),
                                    [&](const OutcomeShare& o) { return o.id == at->id; });
    ASSERT_NE(share, result.basin.attractors.end());
    EXPECT_GT(share->share.count, 0u);
    EXPECT_LT(farthest(at->motion.spectrum, fixed_eigenvalues(s.system(), at->motion.state)), same_eigenvalue);
  }
}

// All balls at the centre of mass, no couple and k12 = 0: nothing tilts, and a tilt adds only directions in which
// deviations die out.
TEST(TiltAttractors, OfNoTiltAreThoseOfTheRotorThatCannotTilt) {
  const std::string plane = R"(
[rotor]
eccentricity = 0.01
damping = 0.5
[balancer]
balls = 4
mass = 0.006
drag = 0.3
[speed]
profile = "constant"
speed = 4.5
[numerics]
horizon = 300
)";
  const auto found = [&](const std::vector<std::string>& overrides, std::vector<Outcome>& outcomes) {
    AttractorsOptions options;
    options.starts = 32;
    options.outcome = [&](const Outcome& outcome) { outcomes.push_back(outcome); };
    return attractors(parse_study(plane, "plane", overrides), options);
  };
  std::vector<Outcome> outcomes_without, outcomes_with;
  const AttractorsResult without = found({}, outcomes_without),
                         with = found({"rotor.tilt={ transverse_inertia = 3.25, polar_inertia = 0.5, stiffness = [0, "
                                       "9], damping = [0, 4.5] }",
                                       "balancer.plane=0"},
                                      outcomes_with);
  ASSERT_EQ(with.attractors.size(), without.attractors.size());
  for (std::size_t k = 0; k < with.attractors.size(); ++k) {
    const Attractor &a = without.attractors[k], &b = with.attractors[k];
    EXPECT_EQ(b.name, a.name);
    EXPECT_EQ(b.motion.kind, a.motion.kind);
    EXPECT_EQ(b.motion.stable, a.motion.stable);
    EXPECT_NEAR(b.motion.r_max, a.motion.r_max, 1e-9);
    ASSERT_EQ(b.continuum.has_value(), a.continuum.has_value());
    if (!a.continuum) continue;
    EXPECT_EQ(b.continuum->share(), a.continuum->share());
  }
  ASSERT_EQ(outcomes_with.size(), outcomes_without.size());
  for (std::size_t i = 0; i < outcomes_with.size(); ++i) {
    EXPECT_EQ(outcomes_with[i].kind, outcomes_without[i].kind) << i;
    EXPECT_EQ(outcomes_with[i].attractor, outcomes_without[i].attractor) << i;
  }
}

// Balls that lag at first are caught, or not, by the two races' unbalance. Followed until long after that in fixed
// axes, as many drift as the label of the start says; where it says locked, the rotor is where that equilibrium is.
void same_outcomes_in_fixed_axes(std::uint64_t starts) {
  Study s = study({"rotor.damping=0.1", "rotor.tilt.damping=[0, 0.9]", "balancer.drag=0.05", "speed.speed=3",
                   "balancer.mass=0.0025", "initial.phi_dot=-1.5"});
  s.sampling.starts = starts;
  std::vector<Outcome> outcomes;
  BasinOptions options;
  options.outcome = [&](const Outcome& outcome) { outcomes.push_back(outcome); };
  Catalogue catalogue;
  basin(s, options, &catalogue);
  ASSERT_EQ(outcomes.size(), starts);
  std::uint64_t locked = 0, drifting = 0;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Attractor* attractor = catalogue.find(outcomes[i].attractor);
    ASSERT_TRUE(attractor) << i;
    Study own = s;
    own.initial = start_of(s, i);
    const FixedFlow flow{own.parameters, false, 0.0};
    std::array<double, most> y{};
    const int lagging = drifting_in_fixed_axes(own, 1e-9, &y);
    EXPECT_EQ(lagging, drifting_by(attractor->name)) << i << ", " << attractor->name;
    ++(lagging > 0 ? drifting : locked);
    if (lagging > 0) continue;
    EXPECT_NEAR(std::abs(flow.state(y.data()).q1), attractor->motion.r_max, 1e-5);
    EXPECT_NEAR(std::abs(flow.state(y.data()).q2), attractor->motion.state.tail(4).head(2).norm(), 1e-5);
  }
  EXPECT_GE(locked, starts / 20);
  EXPECT_GT(drifting, starts / 2);
}

TEST(TiltOutcomes, AreThoseOfFixedAxes) { same_outcomes_in_fixed_axes(40); }
TEST(TiltOutcomes, OfTwoHundredAreThoseOfFixedAxes) { same_outcomes_in_fixed_axes(200); }

// How many balls drift in fixed axes; none for a transient so sensitive that the tolerance decides.
std::optional<int> drifting_for_certain(const Study& own) {
  const int drifting = drifting_in_fixed_axes(own, 1e-11);
  for (const double tolerance : {1e-9, 1e-10, 1e-12})
    if (drifting_in_fixed_axes(own, tolerance) != drifting) return std::nullopt;
  return drifting;
}

// Balls held through a ramp; and a motor on supports that differ in X and Y, with balls that lag at first.
TEST(TiltOutcomes, AfterARampAndUnderAMotorAreThoseOfFixedAxes) {
  const std::vector<std::string> ramp{"rotor.damping=0.2", "rotor.tilt.damping=[0, 1.8]",
                                      "speed={ profile = \"ramp\", initial = 0.0, final = 3.5, duration = 20 }"};
  const std::vector<std::string> motor{
      "rotor.damping=0.1",
      "rotor.tilt.damping=[0, 0.9]",
      "balancer.mass=0.0025",
      "initial.phi_dot=-1.5",
      "speed={ profile = \"torque\", initial = 3.0, torque = { constant = 0.3, slope = -0.1 } }",
      "rotor.stiffness=[1, 1.1]",
      "rotor.tilt.stiffness={ x = [0, 9], y = [0, 9.5] }"};
  for (std::vector<std::string> overrides : {ramp, motor}) {
    for (const char* key : {"balancer.drag=0.05", "numerics.tolerance=1e-11", "sampling.starts=8"})
      overrides.push_back(key);
    const Study s = study(overrides);
    std::vector<Outcome> outcomes;
    BasinOptions options;
    options.outcome = [&](const Outcome& outcome) { outcomes.push_back(outcome); };
    Catalogue catalogue;
    basin(s, options, &catalogue);
    ASSERT_EQ(outcomes.size(), s.sampling.starts);
    std::set<int> kinds;
    int certain = 0;
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      const Attractor* attractor = catalogue.find(outcomes[i].attractor);
      ASSERT_TRUE(attractor) << i;
      Study own = s;
      own.initial = start_of(s, i);
      const auto drifting = drifting_for_certain(own);
      if (!drifting) continue;
      ++certain;
      EXPECT_EQ(*drifting, drifting_by(attractor->name)) << i << ", " << attractor->name;
      kinds.insert(*drifting);
    }
    EXPECT_GE(certain, 4);
    EXPECT_GE(kinds.size(), 2u);
  }
}

}  // namespace tilt_answers_test
}  // namespace equipoise
