// Watching results as they come shows the same as basin(), the mapper and simulate().
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/mapper/mapper.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "equipoise/simulation/trajectory/study_equations.hpp"
#include "../support/studies.hpp"

namespace equipoise {
namespace watched_starts_test {

StartArrays starts_of_basin(Study study, std::uint64_t starts) {
  study.sampling.starts = starts;
  BasinOptions options;
  options.keep_starts = true;
  options.transients = true;
  return *basin(study, options).every_start;
}

TEST(Mapper, GivesStartsTheBitsOfBasinInWhateverPieces) {
  const Study study = parse_study(constant_speed, "rotor");
  const StartArrays whole = starts_of_basin(study, 700);
  MapperOptions options;
  options.transients = true;
  const Mapper mapper(study, options);
  for (const auto& [first, count] : {std::pair{500u, 200u}, std::pair{0u, 37u}, std::pair{37u, 463u}}) {
    const Decided ended = mapper.starts(first, count);
    ASSERT_EQ(ended.outcomes.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(code_of(ended.outcomes[i]), whole.outcome[first + i]);
      EXPECT_EQ(ended.outcomes[i].time, whole.decision_time[first + i]);
      EXPECT_EQ(ended.transients[i].peak_radial, (*whole.transient("peak_radial"))[first + i]);
      for (std::size_t b = 0; b < 2; ++b) EXPECT_EQ(ended.phi[2 * i + b], whole.phi[2 * (first + i) + b]);
    }
  }
}

TEST(Mapper, GivesAnglesTheBitsOfStates) {
  const Study study = parse_study(constant_speed, "rotor");
  const Mapper mapper(study);
  std::vector<double> phi;
  std::vector<InitialState> states;
  for (int k = 0; k < 40; ++k) {
    InitialState s;
    s.phi[0] = 0.1 + 0.15 * k;
    s.phi[1] = 6.0 - 0.11 * k;
    states.push_back(s);
    phi.insert(phi.end(), {s.phi[0], s.phi[1]});
  }
  const std::vector<Outcome> expected = mapper(states);
  const Decided ended = mapper.at_angles(phi);
  for (std::size_t i = 0; i < states.size(); ++i) {
    EXPECT_EQ(code_of(ended.outcomes[i]), code_of(expected[i]));
    EXPECT_EQ(ended.outcomes[i].time, expected[i].time);
  }
}

TEST(Mapper, BallsThatOverlapMakeNoStart) {
  const Mapper mapper(parse_study(constant_speed, "rotor", {"balancer.contact_angle=0.3"}));
  const Decided ended = mapper.at_angles({1.0, 1.1, 1.0, 4.0});
  EXPECT_EQ(ended.outcomes[0].kind, OutcomeKind::failed);
  EXPECT_TRUE(std::isnan(ended.outcomes[0].time));
  EXPECT_EQ(ended.outcomes[1].kind, OutcomeKind::attracted);
}

TEST(Mapper, RefusesWhatBasinRefuses) {
  EXPECT_THROW(Mapper(parse_study(constant_speed, "rotor", {"speed.speed=1e7"})), InputError);
  const Mapper grid(parse_study(constant_speed, "rotor", {"sampling.method=grid", "sampling.starts=400"}));
  EXPECT_THROW(grid.starts(100000, 10), InputError);
  EXPECT_THROW(grid.at_angles({1.0, 2.0, 3.0}), InputError);
}

// Results of simulate() at some times, computed again in steps. Both keep 1e-12 per step; a few hundred steps, and
// differences that grow by less than a thousand on these stretches, leave 1e-7 of the angles.
void expect_followed(const std::string& toml, const std::vector<std::string>& overrides, double until) {
  const Study study = parse_study(toml, "rotor", overrides);
  std::vector<double> times;
  for (int k = 1; k <= 60; ++k) times.push_back(until * k / 60.0);
  const Trajectory expected = simulate(study, times);
  ASSERT_EQ(expected.t.size(), times.size());
  FollowedRun run(study);
  Trajectory followed;
  followed.phi.resize(static_cast<std::size_t>(study.parameters.balls));
  followed.phi_dot.resize(followed.phi.size());
  for (const double t : times) {
    ASSERT_EQ(run.advance(t), IntegrationStatus::done);
    run.record(followed);
  }
  for (std::size_t k = 0; k < times.size(); ++k) {
    EXPECT_NEAR(followed.t[k], expected.t[k], 1e-12 * until);
    EXPECT_NEAR(followed.psi[k], expected.psi[k], 1e-7) << times[k];
    EXPECT_NEAR(followed.psi_dot[k], expected.psi_dot[k], 1e-7) << times[k];
    EXPECT_NEAR(followed.radial[k], expected.radial[k], 1e-7) << times[k];
    for (std::size_t b = 0; b < followed.phi.size(); ++b)
      EXPECT_NEAR(followed.phi[b][k], expected.phi[b][k], 1e-7) << times[k];
  }
}

const std::vector<std::string> apart{"initial.phi=[1.0, 4.0]"};
const std::string ramp =
    rotor_and_balancer +
    "[speed]\nprofile = \"ramp\"\ninitial = 0.0\nfinal = 2.4\nduration = 40.0\n[release]\nspeed = 2.0\n";

TEST(FollowedRun, GoesWhereSimulateGoes) {
  expect_followed(constant_speed, apart, 60.0);
  expect_followed(ramp, apart, 60.0);
  expect_followed(ramp, {apart[0], "rotor.gravity=0.001", "rotor.stiffness=[1.0, 1.2]"}, 60.0);
}

TEST(FollowedRun, CrossesTheJumpsOfThePublishedLaw) { expect_followed(ramp, {apart[0], "speed.law=published"}, 60.0); }

TEST(FollowedRun, FollowsMotorsContactAndStiction) {
  const std::string motor =
      "[speed]\nprofile = \"torque\"\ninitial = 0.0\ntorque = { stall = 0.05, no_load_speed = 2.4 }\n";
  expect_followed(rotor_and_balancer + motor, {apart[0], "rotor.inertia=0.5"}, 60.0);
  expect_followed(constant_speed, {apart[0], "balancer.contact_angle=0.2", "balancer.rolling=0.0002"}, 20.0);
}

// Here the motion with both balls in one place is at rest and unstable (r = 0.082): real balls do not keep it.
const std::vector<std::string> in_one_place{"speed.speed=3.5", "rotor.eccentricity=0.02", "balancer.drag=0.3",
                                            "initial.phi=[0.0, 0.0]"};

// Following a start step by step shows the same trajectory.
TEST(CoincidentBalls, PartForWhoeverFollowsThem) {
  const Study study = parse_study(constant_speed, "rotor", in_one_place);
  const Trajectory alone = simulate(study, {0.0, 1000.0});
  EXPECT_NEAR(alone.phi[1][0], 0.0, 1e-8);
  EXPECT_NE(alone.phi[1][0], 0.0);
  EXPECT_LT(alone.radial[1], 1e-6);  // balanced since t = 200
  FollowedRun run(study);
  Trajectory watched;
  watched.phi.resize(2);
  watched.phi_dot.resize(2);
  run.record(watched);
  EXPECT_EQ(watched.phi[1][0], alone.phi[1][0]);
  const StudyEquations equations(study);
  EXPECT_EQ(equations.initial_state()[5], alone.phi[1][0]);
  const Mapper mapper(study);
  EXPECT_EQ(mapper.name(mapper(study.initial)), "balanced");
  BasinOptions options;
  options.initial = {study.initial};
  const BasinResult ensemble = basin(study, options);
  EXPECT_EQ(ensemble.attractors.front().name, "balanced");
  EXPECT_EQ(ensemble.attractors.front().share.count, 1u);
}

// By default, balls of any size and number have room.
TEST(Simulate, StartsFromTheDefaultsOfBallsThatTouch) {
  for (const char* contact : {"0.3", "0.78"}) {  // eight balls fill the race at 0.785
    const Study study =
        parse_study(constant_speed, "rotor",
                    {"balancer.balls=8", "balancer.mass=0.01", fmt::format("balancer.contact_angle={}", contact)});
    EXPECT_EQ(simulate(study, {0.0, 1.0}).status, IntegrationStatus::done) << contact;
  }
}

// If one ball is heavier, nothing keeps them together, and nothing is moved.
TEST(CoincidentBalls, StartAsGivenIfTheyAreNotAlike) {
  std::vector<std::string> unlike = in_one_place;
  unlike.emplace_back("balancer.mass=[0.05, 0.06]");
  EXPECT_EQ(simulate(parse_study(constant_speed, "rotor", unlike), {0.0}).phi[1][0], 0.0);
  std::vector<std::string> turning = in_one_place;
  turning.emplace_back("initial.phi_dot=[0.1, -0.1]");
  EXPECT_EQ(simulate(parse_study(constant_speed, "rotor", turning), {0.0}).phi[1][0], 0.0);
}

TEST(FollowedRun, KnowsWhenBallsAreHeld) {
  FollowedRun run(parse_study(ramp, "rotor", apart));
  EXPECT_TRUE(run.clamped());
  run.advance(20.0);
  EXPECT_TRUE(run.clamped());
  run.advance(50.0);
  EXPECT_FALSE(run.clamped());
  run.advance(10.0);  // the past is over
  EXPECT_EQ(run.time(), 50.0);
}

}  // namespace watched_starts_test
}  // namespace equipoise
