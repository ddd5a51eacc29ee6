// Balance of touching balls that need nearly all their room: which rotors have it, and that starts come to it.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/attractors/equilibria/continuum_draws.hpp"
#include "equipoise/classification/balanced_regions/balanced_analysis.hpp"
#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/balance/room_in_race.hpp"
#include "equipoise/machine/model/unbalance.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "equipoise/simulation/spin_up/spin_up.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"

namespace equipoise {
namespace touching_balance_test {

using Kind = model::BalancedStates::Kind;

// 10 kg on 20 kN/m, six balls of 20 mm in a race of 40 mm: points would cancel 0.0196, balls side by side 0.01305.
constexpr double ball = 0.00326726, touching = 0.505360510284157;
const double most = ball * std::sin(3.0 * touching) / std::sin(0.5 * touching);

Study crowded_rotor(double unbalance) {
  Study study;
  study.name = "rotor";
  model::Parameters& p = study.parameters;
  p.balls = 6;
  p.eccentricity = unbalance;
  p.damping = {0.2, 0.2};
  for (int i = 0; i < p.balls; ++i) {
    p.mass[i] = ball;
    p.drag[i] = 0.855484;
  }
  p.contact_angle = touching;
  study.speed.profile = Profile::constant;
  study.speed.speed = 7.02481;
  return study;
}

TEST(TouchingBalance, ExistsUpToARowSideBySide) {
  // Beyond the 1e-6 of all masses to which rows are computed.
  EXPECT_EQ(model::balanced_states(crowded_rotor(0.9999 * most).parameters).kind, Kind::continuum);
  const auto none = model::balanced_states(crowded_rotor(1.0001 * most).parameters);
  EXPECT_EQ(none.kind, Kind::none);
  EXPECT_EQ(none.reason, "balls of this size, side by side, cancel less than the unbalance");
  // Balls that pass each other cancel it.
  model::Parameters passing = crowded_rotor(1.0001 * most).parameters;
  passing.contact_angle = 0.0;
  EXPECT_EQ(model::balanced_states(passing).kind, Kind::continuum);
}

TEST(TouchingBalance, TwoBallsHaveRoomOrOverlap) {
  model::Parameters p = crowded_rotor(0.0).parameters;
  p.balls = 2;
  const double side_by_side = 2.0 * ball * std::cos(0.5 * touching);
  p.eccentricity = 0.999 * side_by_side;
  EXPECT_EQ(model::balanced_states(p).kind, Kind::isolated);
  p.eccentricity = 1.001 * side_by_side;
  EXPECT_EQ(model::balanced_states(p).kind, Kind::none);
  // A heavy ball and two that could balance it only by overlapping.
  p.balls = 3;
  p.eccentricity = 0.0;
  p.mass = {1.99 * ball, ball, ball};
  const auto heavy = model::balanced_states(p);
  EXPECT_EQ(heavy.kind, Kind::none);
  EXPECT_EQ(heavy.reason, "balls of this size have no room to cancel as little as the unbalance");
  p.mass[0] = 1.9 * ball;
  EXPECT_EQ(model::balanced_states(p).kind, Kind::continuum);
}

TEST(TouchingBalance, MembersAreDrawnWithRoom) {
  for (const double share : {0.0, 0.5, 0.766, 0.98, 0.9995}) {
    const Study study = crowded_rotor(share * most);
    const model::Parameters& p = study.parameters;
    ContinuumDraws draws(p);
    std::array<double, model::max_balls> phi{};
    std::vector<double> first;
    for (int k = 0; k < 100; ++k) {
      ASSERT_TRUE(draws.next(phi)) << share;
      EXPECT_LT(std::abs(model::unbalance(p, phi.data())), 1e-14 * p.all_unbalances());
      EXPECT_TRUE(model::has_room(p, phi.data()));
      first.push_back(phi[0]);
    }
    std::sort(first.begin(), first.end());
    EXPECT_GT(first.back(), first.front()) << "all the same";
    const BalancedAnalysis found = analyse_balanced({p, study.speed.speed});
    EXPECT_TRUE(found.stable) << share;
    EXPECT_EQ(found.note, "") << share;
  }
}

TEST(TouchingBalance, StartsComeToItAsSimulateDoes) {
  Study study = crowded_rotor(0.766 * most);
  constexpr std::size_t count = 16;
  Session runner(study, {2, nullptr, {}});
  EXPECT_EQ(runner.balance().note, "");
  Decided decided;
  ASSERT_TRUE(runner.decide(0, count, decided));
  EXPECT_TRUE(decided.unlisted.empty());
  for (const Outcome& outcome : decided.outcomes) {
    EXPECT_EQ(outcome.kind, OutcomeKind::attracted);
    EXPECT_EQ(outcome.attractor, balanced_id);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    std::copy_n(&decided.phi[i * 6], 6, study.initial.phi.begin());
    study.numerics.tolerance = 1e-9;
    const Trajectory path = simulate(study, {0.0, 1.0, 300.0});
    EXPECT_GT(path.radial[1], 0.1 * study.parameters.eccentricity);
    // Thirty times the time in which the slowest deviation falls to 1/e.
    EXPECT_LT(path.radial[2], 1e-5 * study.parameters.eccentricity);
  }
}

// Both ways: starts whose balls never meet go like those of passing balls; nearly all others do not.
TEST(TouchingBalance, StartsWhoseBallsNeverMeetAreThoseOfBallsThatPass) {
  constexpr std::size_t starts = 400;
  Study touching = crowded_rotor(0.5 * most);
  touching.parameters.balls = 3;
  touching.parameters.drag.fill(0.1);
  touching.speed.speed = 2.5;
  Study passing = touching;
  passing.parameters.contact_angle = 0.0;
  std::vector<InitialState> begins;  // with room
  for (std::size_t i = 0; i < starts; ++i) begins.push_back(start_of(touching, 1, i));
  const auto states_of = [&](const Study& study, std::vector<Outcome>& outcomes) {
    const auto source = make_spin_up(with_horizon(study), nullptr);
    SpunUp spun;
    EXPECT_TRUE(source->follow(begins, spun));
    BatchTask task = source->last_task();
    task.end = 20.0;
    task.count = starts;
    task.states = spun.states.data();
    outcomes.assign(starts, Outcome{});
    EXPECT_TRUE(advance_batch(task, outcomes));
    return spun.states;
  };
  std::vector<Outcome> outcomes, none;
  const std::vector<double> with = states_of(touching, outcomes), without = states_of(passing, none);
  const std::size_t size = with.size() / starts;
  std::size_t met = 0;
  for (std::size_t i = 0; i < starts; ++i) {
    EXPECT_FALSE(none[i].met);
    double apart = 0.0;
    for (std::size_t k = 0; k < size; ++k)
      apart = std::max(apart, std::fabs(with[i * size + k] - without[i * size + k]));
    met += outcomes[i].met;
    // Lanes of other kinds round differently; colliding balls lose half their speed.
    EXPECT_EQ(outcomes[i].met, apart > 1e-4) << i << " " << apart;
  }
  EXPECT_GT(met, starts / 10);
  EXPECT_LT(met, 9 * starts / 10);
}

}  // namespace touching_balance_test
}  // namespace equipoise
