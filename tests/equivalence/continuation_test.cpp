// Attractors continued along the speed (two balls, mu = 0.05 each, lambda = 0.01, zeta = 0.5, beta = 0.05): where an
// earlier, independent code saw them, more accurate figures recorded with this code, and properties of branches however
// they are found.
#include "equipoise/analyses/continuation/continuation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "equipoise/analyses/continuation/branch_follower.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "../support/studies.hpp"

namespace continuation_test {

using namespace equipoise;

Study study() { return read_study(EQUIPOISE_SOURCE_DIR "/studies/paper/table-2-omega-2.4.toml"); }

BranchesResult along(const std::string& text, std::vector<std::vector<double>> warm_start_states = {},
                     int threads = 2) {
  const Study s = study();
  ContinuationOptions options;
  options.threads = threads;
  options.warm_start_states = std::move(warm_start_states);
  return follow_attractors(s, ParameterLine(s, text), options);
}

const Branch* branch(const BranchesResult& result, int id) {
  const auto at =
      std::find_if(result.branches.begin(), result.branches.end(), [&](const Branch& b) { return b.id == id; });
  return at == result.branches.end() ? nullptr : &*at;
}

const BranchEvent* event(const Branch& b, BranchChange change) {
  const auto at =
      std::find_if(b.events.begin(), b.events.end(), [&](const BranchEvent& e) { return e.change == change; });
  return at == b.events.end() ? nullptr : &*at;
}

// A state on the motion of coincident balls at 4.4, where starts with coincident balls come to other motions.
std::vector<double> coincident_at_4_4() {
  const model::Parameters p = study().parameters;
  Eigen::VectorXd start = Eigen::VectorXd::Zero(8);
  start[4] = start[5] = 1.0;
  const auto motion = motion_from({p, 3.4}, start);
  if (!motion) return {};
  PeriodicOrbit orbit = motion->orbit;
  for (int k = 1; k <= 10; ++k) {
    const auto next = refine_orbit({p, 3.4 + 0.1 * k}, orbit.nodes, orbit.period);
    if (!next) return {};
    orbit = *next;
  }
  return {orbit.nodes[0].data(), orbit.nodes[0].data() + 8};
}

TEST(Branches, OneCapturedIsBornInAFoldAt29043) {
  const BranchesResult result = along("speed.final=2.85:2.95:0.05");
  const Branch* b = branch(result, 4);
  ASSERT_TRUE(b);
  EXPECT_EQ(b->alias, "V3");
  EXPECT_EQ(b->points.size(), 1u);  // 2.95
  const BranchEvent* birth = event(*b, BranchChange::birth);
  ASSERT_TRUE(birth);
  EXPECT_EQ(birth->cause, BranchCause::fold);
  // Recorded with this code by other steps (orbit_test.cpp; the independent one: 2.90 to 2.95). The bracket is 2^-16 of
  // the step wide, and Newton's method may fail a little before the fold.
  EXPECT_NEAR(birth->middle(), 2.904337, 2e-6);
  EXPECT_LT(birth->high - birth->low, 0.05 / 16);
  // The motion of coincident balls and balance exist throughout, with their usual identifiers.
  for (const int id : {1, 2}) {
    ASSERT_TRUE(branch(result, id));
    EXPECT_EQ(branch(result, id)->points.size(), result.values.size());
    EXPECT_TRUE(branch(result, id)->events.empty());
  }
  // A separate isola between 2.73 and 3.06, of the same name but larger. It was first met here: a regression test.
  const Branch* isola = branch(result, 8);
  ASSERT_TRUE(isola);
  EXPECT_EQ(isola->name, "one captured (2)");
  EXPECT_EQ(isola->alias, "");
  EXPECT_EQ(isola->points.size(), 3u);
}

TEST(Branches, LoseStabilityWhereTheyDidBefore) {
  const BranchesResult result =
      along("speed.final=4.4:4.45:0.05", {coincident_at_4_4(), {0, 0, 0, 0, 1.17174, 1.00534, 0, 0}});
  const Branch* coincident = branch(result, 2);
  ASSERT_TRUE(coincident);
  const BranchEvent* pitchfork = event(*coincident, BranchChange::stability_lost);
  ASSERT_TRUE(pitchfork);
  EXPECT_EQ(pitchfork->cause, BranchCause::pitchfork);
  EXPECT_GT(pitchfork->low, 4.41);  // recorded with this code; the independent one: 4.40 to 4.50
  EXPECT_LT(pitchfork->high, 4.42);
  EXPECT_LE(pitchfork->high - pitchfork->low, 0.05 / 16);
  EXPECT_EQ(coincident->points.size(), 2u);
  EXPECT_FALSE(coincident->points.back().motion.stable);  // continued through instability

  const Branch* period_four = branch(result, 5);
  ASSERT_TRUE(period_four);
  EXPECT_EQ(period_four->alias, "V4");
  const BranchEvent* doubling = event(*period_four, BranchChange::stability_lost);
  ASSERT_TRUE(doubling);
  EXPECT_EQ(doubling->cause, BranchCause::period_doubling);
  EXPECT_GT(doubling->low, 4.408);  // recorded between these
  EXPECT_LT(doubling->high, 4.409);
}

// A torus at 2.45, chaotic at 2.5, locked at 2.52, a torus again at 2.53, gone at 2.6: one motion with one identifier.
TEST(Branches, TorusThatTurnsChaoticAndLocksKeepsItsIdentifier) {
  const BranchesResult result = along("speed.final=2.45:2.55:0.05");
  const Branch* b = branch(result, 3);
  ASSERT_TRUE(b);
  EXPECT_EQ(b->alias, "V2");
  ASSERT_EQ(b->points.size(), 2u);
  EXPECT_EQ(b->points[0].motion.kind, MotionKind::quasi_periodic);
  EXPECT_EQ(b->points[1].motion.kind, MotionKind::chaotic);
  const BranchEvent *kind = event(*b, BranchChange::kind), *death = event(*b, BranchChange::death);
  ASSERT_TRUE(kind && death);
  EXPECT_EQ(kind->cause, BranchCause::torus_to_chaos);
  EXPECT_GT(kind->low, 2.45);
  EXPECT_LT(kind->high, 2.5);
  // Plain searches find it at 2.54 (0.3 % of 6000 starts), but not at 2.55.
  EXPECT_EQ(death->cause, BranchCause::attraction_ends);
  EXPECT_GT(death->low, 2.54);
  EXPECT_LE(death->high, 2.55);
  for (const Branch& other : result.branches) {
    if (other.id != 3) {
      EXPECT_NE(other.name, b->name);
    }
  }
}

// With little drag the torus has a thin basin. It attracts from 2 (4.4 % of 3000 starts) through 2.0156 (0.4 %) to
// beyond 2.0234 (1.8 % of 15 000), and a trajectory carried over 0.0125 leaves it.
TEST(Branches, ThinBasinOfATorusIsFollowedThrough) {
  Study s = study();
  s.parameters.drag.fill(0.01);
  ContinuationOptions options;
  options.threads = 2;
  const BranchesResult result = follow_attractors(s, ParameterLine(s, "speed.final=2:2.05:0.05"), options);
  const Branch* b = branch(result, 3);
  ASSERT_TRUE(b);
  EXPECT_EQ(b->points.front().value, 2.0);
  const BranchEvent* death = event(*b, BranchChange::death);
  ASSERT_TRUE(death);
  EXPECT_EQ(death->cause, BranchCause::attraction_ends);
  EXPECT_GE(death->high, 2.0234);
  EXPECT_LT(death->high, 2.025);
  // Followed from a state just inside it, it stays.
  const BranchPoint& inside = b->points.back();
  const auto later = motion_from({s.parameters, inside.value}, inside.motion.state, 4.0 * motion_patience);
  ASSERT_TRUE(later);
  EXPECT_EQ(motion_name(s.parameters, *later).name.substr(0, 14), "drifting apart");
}

// Pair drift attracts a little around 1.81 (0.9 % of 3000 starts there, none at 1.8 and 1.82).
TEST(Branches, MotionThatLivesBetweenTwoValuesIsFoundHalfWay) {
  const BranchesResult result = along("speed.final=1.805:1.815:0.01");
  EXPECT_TRUE(std::any_of(result.branches.begin(), result.branches.end(),
                          [](const Branch& b) { return b.name.starts_with("pair drift"); }));
}

// An end without a cause is no death.
TEST(Branches, RangeThatWasNotFollowedToItsEndSaysSo) {
  BranchesResult result;
  result.study = study();
  result.key = "speed.final";
  result.values = {2.0, 2.05, 2.1};
  result.step = 0.05;
  result.starts = along_starts;
  Branch b;
  b.id = 2;
  b.name = "co-drifting";
  Motion motion;
  motion.stable = true;
  for (const std::size_t k : {0, 1}) b.points.push_back({k, result.values[k], motion});
  b.events.push_back({2, BranchChange::last_seen, BranchCause::unresolved, 2.0625, 2.065625, 0.0, 0.1, 0.2});
  result.branches.push_back(b);
  EXPECT_EQ(ranges_of(b).back().end, 2.0625);
  const auto has = [&](const char* words) { return result_text(result).find(words) != std::string::npos; };
  EXPECT_TRUE(has("seen from 2 to 2.062, not followed further above ")) << result_text(result);
  EXPECT_TRUE(has("2.0625 and 2.0657 ")) << result_text(result);  // two digits between the bounds
  result.branches[0].events[0].change = BranchChange::death;
  result.branches[0].events[0].cause = BranchCause::fold;
  EXPECT_TRUE(has("  2 to 2.064 ")) << result_text(result);
  EXPECT_FALSE(has("not followed")) << result_text(result);
  result.branches[0].events.clear();  // of a stopped run
  EXPECT_TRUE(has("seen from 2 to 2.05, not followed further above ")) << result_text(result);
  result.branches[0].points.push_back({2, 2.1, motion});
  EXPECT_FALSE(has("not followed")) << result_text(result);
}

// A motion stable at two neighbouring values need not be stable between them.
TEST(Branches, StabilityLostAndGainedBetweenTwoValuesMakesTwoRanges) {
  Branch b;
  Motion motion;
  motion.stable = true;
  b.points = {{0, 1.0, motion}, {1, 2.0, motion}};
  b.events.push_back({1, BranchChange::stability_lost, BranchCause::hopf, 1.2, 1.2, 0.0, 0.0, 0.0});
  b.events.push_back({1, BranchChange::stability_gained, BranchCause::hopf, 1.7, 1.7, 0.0, 0.0, 0.0});
  const auto ranges = ranges_of(b);
  ASSERT_EQ(ranges.size(), 3u);
  EXPECT_EQ(ranges[0].end, 1.2);
  EXPECT_FALSE(ranges[1].stable);
  EXPECT_EQ(ranges[2].begin, 1.7);
  EXPECT_EQ(ranges[2].end, 2.0);
  // The same between a point and an end.
  b.events.insert(b.events.begin(), {1, BranchChange::stability_gained, BranchCause::hopf, 0.9, 0.9, 0.0, 0.0, 0.0});
  b.events.insert(b.events.begin(), {1, BranchChange::birth, BranchCause::fold, 0.8, 0.8, 0.0, 0.0, 0.0});
  const auto more = ranges_of(b);
  ASSERT_EQ(more.size(), 4u);
  EXPECT_FALSE(more[0].stable);
  EXPECT_EQ(more[0].begin, 0.8);
  EXPECT_EQ(more[1].begin, 0.9);
}

// At 1.775 this torus's drift is measured as two rates, so it has another name there. 14 % of 6000 starts come to it,
// as 13 % do at 1.7765 and 12 % at 1.779, where it is pair drift.
TEST(Branches, TorusNamedOtherwiseAtOneValueIsStillTheSame) {
  const model::Parameters p = study().parameters;
  Motion pair;
  pair.kind = MotionKind::quasi_periodic;
  pair.stable = true;
  pair.r_mean = 0.0299;
  pair.r_max = 0.0518;
  pair.drift[0] = pair.drift[1] = -0.1525;
  pair.drift_group[0] = pair.drift_group[1] = 1;
  pair.oppositions_per_turn = 11.5;
  Motion apart = pair;
  apart.r_max = 0.052;
  apart.drift[0] = -0.154;
  apart.drift[1] = -0.1539;
  apart.drift_group[1] = 2;
  ASSERT_NE(family_of(p, pair), family_of(p, apart));
  EXPECT_TRUE(resembles(p, pair, apart));
  apart.drift[1] = -0.3;
  EXPECT_FALSE(resembles(p, pair, apart));
  apart.drift[1] = -0.1539;
  apart.r_max = 0.07;
  EXPECT_FALSE(resembles(p, pair, apart));
}

// Pair drift is a torus at 1.812, periodic from 1.8145 on, and ends in a fold before the line's next value.
TEST(Branches, TorusThatBecomesPeriodicIsFollowedToItsFold) {
  const BranchesResult result = along("speed.final=1.812:1.832:0.02");
  const Branch* b = branch(result, 6);
  ASSERT_TRUE(b);
  const BranchEvent *kind = event(*b, BranchChange::kind), *death = event(*b, BranchChange::death);
  ASSERT_TRUE(kind && death) << result_text(result);
  EXPECT_EQ(kind->cause, BranchCause::to_periodic);
  EXPECT_NEAR(kind->middle(), 1.8145, 1.5e-3);  // bracketed to 1/16 of the step
  EXPECT_EQ(death->cause, BranchCause::fold);
  EXPECT_NEAR(death->middle(), 1.8183334, 1e-6);  // 2^-16 of the step, twice; as in the run with steps of 0.005
}

TEST(Branches, DoNotDependOnThreads) {
  const BranchesResult one = along("speed.final=2.9:2.95:0.05", {}, 1), two = along("speed.final=2.9:2.95:0.05", {}, 2);
  EXPECT_EQ(branches_csv(one), branches_csv(two));
}

// No motion is on two branches; events of a branch are in order.
TEST(Branches, AreDisjointAndOrdered) {
  const BranchesResult result = along("balancer.drag=0.05:0.1:0.05");
  ASSERT_GE(result.values.size(), 2u);  // and 0.075, if something exists only there
  EXPECT_EQ(result.values.front(), 0.05);
  EXPECT_EQ(result.values.back(), 0.1);
  for (const Branch& a : result.branches) {
    for (std::size_t i = 0; i + 1 < a.points.size(); ++i) EXPECT_LT(a.points[i].at, a.points[i + 1].at);
    for (std::size_t i = 0; i + 1 < a.events.size(); ++i) EXPECT_LE(a.events[i].middle(), a.events[i + 1].middle());
    for (const Branch& b : result.branches) {
      if (a.id >= b.id) continue;
      for (const BranchPoint& x : a.points)
        for (const BranchPoint& y : b.points) {
          if (x.at != y.at) continue;
          EXPECT_FALSE(same_motion(study().parameters, x.motion, y.motion)) << a.id << " " << b.id;
        }
    }
  }
}

TEST(ParameterLine, HasDecimalValuesWhicheverWayItIsGiven) {
  const ParameterLine line(study(), "speed.final=1.4:6.5:0.05"), back(study(), "speed.final=6.5:1.4:-0.05");
  ASSERT_EQ(line.values().size(), 103u);
  EXPECT_EQ(line.values()[20], 2.4);
  EXPECT_EQ(line.values().back(), 6.5);
  EXPECT_EQ(back.values(), line.values());
  EXPECT_EQ(line.system_at(2.4).speed(), 2.4);
  EXPECT_EQ(ParameterLine(study(), "balancer.drag=0.1:0.1:1").system_at(0.1).parameters().drag[1], 0.1);
}

TEST(ParameterLine, TakesQuantitiesWhereTheStudyHasUnits) {
  const Study machine =
      parse_study(machine_rotor + "[speed]\nprofile = \"ramp\"\nfinal = \"2000 rpm\"\nduration = \"10 s\"\n", "m.toml");
  const double omega_c = machine.scales->frequency;
  const auto first = [&](const char* text) { return ParameterLine(machine, text).values().front(); };
  // Values of a line have twelve digits of the largest, here less than ten times the first.
  const auto near = [](double value) { return 1e-11 * std::pow(10.0, std::ceil(std::log10(value))); };
  const auto expect = [&](const char* text, double value) { EXPECT_NEAR(first(text), value, near(value)) << text; };
  expect("speed.final=1500 rpm:3000 rpm:500 rpm", 50.0 * pi / omega_c);
  expect("speed.duration=500 ms:2 s:0.5 s", 0.5 * omega_c);
  expect("rotor.eccentricity=150 \u00B5m:0.2 mm:50 um", 0.15 / 30.0);
  expect("balancer.drag=1e-4 N m s:2e-4 N m s:1e-4 N m s", 1e-4 / (0.06 * 9e-4 * omega_c));
  expect("speed.final=2.5:3:0.5", 2.5);  // plain numbers are dimensionless
  EXPECT_EQ(ParameterLine(machine, "speed.final=1500 rpm:3000 rpm:500 rpm").values().size(), 4u);
  for (const char* text :
       {"speed.final=1500 s:3000 rpm:500 rpm", "speed.final=1500:3000 mm:1", "rotor.damping=1 kg:2 kg:1 kg"})
    EXPECT_THROW(ParameterLine(machine, text), InputError) << text;
  EXPECT_THROW(ParameterLine(study(), "speed.final=1500 rpm:3000 rpm:500 rpm"), InputError);
  Study unequal = machine;  // one torque is another beta for each
  unequal.parameters.mass[1] *= 1.5;
  EXPECT_THROW(ParameterLine(unequal, "balancer.drag=1e-4 N m s:2e-4 N m s:1e-4 N m s"), InputError);
}

TEST(ParameterLine, RefusesWhatItCannotFollow) {
  for (const char* text :
       {"", "speed.final", "=1:2:1", "speed.final=1:2", "speed.final=1:2:3:4", "speed.final=a:2:1", "speed.final=1:2:0",
        "speed.final=1:2:-0.1", "speed.final=2:1:0.1", "speed.final=1:nan:0.1", "speed.final=0:1:0.5",
        "speed.final=1:2:0.0001", "balancer.balls=1:3:1", "numerics.horizon=1000:2000:500", "balancer.dragg=1:2:1",
        "balancer.mass=-1:1:0.5", "speed.law=1:2:1", "rotor=1:2:1"})
    EXPECT_THROW(ParameterLine(study(), text), InputError) << text;
}

}  // namespace continuation_test
