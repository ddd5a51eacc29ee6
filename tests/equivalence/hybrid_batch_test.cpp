// Lanes of systems with contact and dry friction, alone and together, against the same starts one by one in doubles:
// final states and numbers of events; independence of neighbours; how balls graze, stop dead and come to rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/spin_up/spin_up.hpp"
#include "lane_studies.hpp"

namespace hybrid_batch_test {

using namespace lanes;

constexpr double until = 30.0;

struct Case {
  std::string name, toml;
  double accuracy = 1e-6;  // lanes err by up to 1e-10 per step; every impact and start multiplies the errors
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

std::string contact(double restitution, double angle = 0.5) {
  return "contact_angle = " + std::to_string(angle) + "\nrestitution = " + std::to_string(restitution) + "\n";
}
const std::string sticky = "rolling = 0.01\nstiction = 0.02\n", rolling = "rolling = 0.01\n",
                  motor = "[speed]\nprofile = \"torque\"\ninitial = 0.5\ntorque = { constant = 0.6, slope = -0.2 }\n",
                  constant = "[speed]\nprofile = \"constant\"\nspeed = 2.0\n",
                  published = ramp + "law = \"published\"\n", sizes = "rolls = true\nball_radius = [0.3, 0.1, 0.2]\n";

std::vector<Case> cases() {
  std::vector<Case> all{{"contact", rotor() + balls(2, contact(0.5)) + constant},
                        {"elastic_contact", rotor() + balls(3, contact(1.0)) + constant},
                        {"plastic_contact", rotor() + balls(3, contact(0.0)) + constant},
                        {"contact_with_gravity_on_a_ramp", rotor(upright) + balls(3, contact(0.5)) + ramp},
                        {"contact_of_balls_released_at_a_time", rotor() + balls(3, contact(0.7)) + ramp + at_time},
                        {"contact_where_the_speed_jumps", rotor() + balls(2, contact(0.6)) + published + at_time},
                        {"contact_under_a_motor_with_gravity", rotor(upright) + balls(4, contact(0.5)) + motor},
                        {"contact_off_centre_releasing_at_a_speed",
                         rotor(upright) + balls(3, contact(0.3) + off_centre) + motor + at_speed},
                        {"contact_of_balls_that_roll", rotor() + balls(3, contact(0.5) + sizes) + motor},
                        {"plastic_contact_of_balls_that_roll", rotor(upright) + balls(3, contact(0.0) + sizes) + motor},
                        {"rolling_resistance", rotor() + balls(2, rolling) + constant},
                        {"stiction", rotor() + balls(2, sticky) + constant},
                        {"stiction_with_gravity", rotor(upright) + balls(3, sticky) + constant},
                        {"stiction_of_balls_that_roll", rotor() + balls(3, sticky + sizes) + motor},
                        {"stiction_under_a_motor_with_gravity", rotor(upright) + balls(3, sticky) + motor + at_time},
                        {"stiction_off_centre", rotor() + balls(3, sticky + off_centre) + ramp + at_time},
                        {"both", rotor() + balls(3, contact(0.5) + sticky) + constant},
                        {"both_plastic", rotor() + balls(3, contact(0.0) + sticky) + constant},
                        {"both_elastic", rotor() + balls(2, contact(1.0) + rolling) + constant},
                        {"both_with_gravity", rotor(upright) + balls(3, contact(0.5) + sticky) + ramp},
                        {"both_under_a_motor_off_centre",
                         rotor(upright) + balls(4, contact(0.2) + sticky + off_centre) + motor + at_speed},
                        {"both_of_balls_that_roll", rotor() + balls(3, contact(0.3) + sticky + sizes) + motor}};
  for (int n : {1, 2, 3, 4, 5, 6, 7, 8, 12, 16})
    all.push_back({"both_of_" + std::to_string(n), rotor() + balls(n, contact(0.4, 0.3) + sticky) + constant});
  return all;
}

struct Ends {
  std::vector<double> states;
  std::uint64_t events = 0;
  std::vector<Outcome> outcomes;
};

Ends on_lanes(const Study& study, std::uint64_t first, std::size_t count, double end = until) {
  SpunUp spun;
  const auto source = make_spin_up(study, nullptr);
  EXPECT_TRUE(source->make(study.sampling.seed, first, count, spun));
  BatchTask task = source->last_task();
  EXPECT_EQ(task.kind(), BatchKind::hybrid);
  BatchWork work;
  task.end = end;
  task.count = count;
  task.states = spun.states.data();
  task.work = &work;
  if (!spun.begins.empty()) task.begins = spun.begins.data();
  Ends ends;
  ends.outcomes.resize(count);
  EXPECT_TRUE(advance_batch(task, ends.outcomes));
  ends.states = spun.states;
  ends.events = work.events;
  return ends;
}

class HybridLanes : public testing::TestWithParam<Case> {};

TEST_P(HybridLanes, FollowStartsAsDoublesDo) {
  const Study study = parse_study(GetParam().toml, "study");
  const auto size = static_cast<std::size_t>(study.system().dimension());
  const Eigen::VectorXd scale = study.system().scale();
  const Ends ends = on_lanes(study, 0, starts);
  ASSERT_EQ(ends.states.size(), starts * size);
  long events = 0;
  double worst = 0.0;
  for (std::size_t i = 0; i < starts; ++i) {
    ASSERT_EQ(ends.outcomes[i].kind, OutcomeKind::undecided);
    const Reference reference = one_by_one(study, i, until);
    events += reference.events;
    for (std::size_t k = 0; k < size; ++k) {
      const double off = std::fabs(ends.states[i * size + k] - reference.state[k]) / scale[k];
      EXPECT_LT(off, GetParam().accuracy) << i << " " << k;
      worst = std::max(worst, off);
    }
  }
  RecordProperty("worst", std::to_string(worst * 1e9) + "e-9");
  RecordProperty("events", static_cast<int>(events));
  EXPECT_GT(events, 0);
  // On the way to the last piece of the drive lanes count their events elsewhere.
  if (study.speed.profile == Profile::constant) {
    EXPECT_EQ(static_cast<long>(ends.events), events);
  }
}
INSTANTIATE_TEST_SUITE_P(AllSystems, HybridLanes, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });

// Place, neighbours and number of a trajectory do not change its bits, on any instruction set.
TEST(HybridLanesAlone, GiveTheSameBits) {
  for (const std::string& target : cpu_targets())
    for (const char* name : {"both_of_5", "both_under_a_motor_off_centre", "contact_of_balls_that_roll"}) {
      const ChosenCpuTarget chosen(target);
      const auto all = cases();
      const auto found = std::find_if(all.begin(), all.end(), [&](const Case& c) { return c.name == name; });
      const Study study = parse_study(found->toml, "study");
      const auto size = static_cast<std::size_t>(study.system().dimension());
      const Ends together = on_lanes(study, 0, 17);
      for (const std::uint64_t i : {0u, 7u, 14u})
        for (const std::size_t count : {1u, 3u}) {
          const Ends alone = on_lanes(study, i, count);
          for (std::size_t k = 0; k < count * size; ++k)
            ASSERT_EQ(alone.states[k], together.states[i * size + k]) << target << " " << name << " " << i << " " << k;
        }
    }
}

// A trajectory stopped anywhere and resumed continues unchanged: the mode is a function of the state.
TEST(HybridLanesAlone, GoOnFromAnyState) {
  for (const char* name : {"both_of_5", "plastic_contact", "both_plastic", "stiction"}) {
    const auto all = cases();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Case& c) { return c.name == name; });
    const Study study = parse_study(found->toml, "study");
    const auto size = static_cast<std::size_t>(study.system().dimension());
    const Eigen::VectorXd scale = study.system().scale();
    const Ends whole = on_lanes(study, 0, starts);
    Ends parts = on_lanes(study, 0, starts, 10.0);
    const model::System system = study.system();
    for (int part = 0; part < 40; ++part) {
      BatchTask task = batch_task(system);
      task.segment.begin = 10.0 + 0.5 * part;
      task.end = task.segment.begin + 0.5;
      task.tolerance = 1e-10;
      task.count = starts;
      task.states = parts.states.data();
      ASSERT_TRUE(advance_batch(task, parts.outcomes));
    }
    for (std::size_t k = 0; k < starts * size; ++k)
      EXPECT_NEAR(parts.states[k], whole.states[k], 1e-6 * scale[k % size]) << name << " " << k / size;
  }
}

// One start of two balls on a heavy rotor at rest that nothing turns: balls at `phi` with rates `q`.
std::vector<double> two_balls(const std::string& more, std::vector<double> phi, std::vector<double> q, double end,
                              BatchWork& work, std::vector<Outcome>& outcomes) {
  const Study study = parse_study("[rotor]\neccentricity = 0.0\ndamping = 0.4\n[balancer]\nballs = 2\nmass = 1e-9\n" +
                                      more + "[speed]\nprofile = \"constant\"\nspeed = 1.0\n",
                                  "two balls");
  const model::System system = study.system();
  std::vector<double> z{0.0, 0.0, 0.0, 0.0, phi[0], phi[1], q[0], q[1]};
  BatchTask task = batch_task(system);
  task.end = end;
  task.tolerance = 1e-10;
  task.count = 1;
  task.states = z.data();
  task.work = &work;
  outcomes.resize(1);
  EXPECT_TRUE(advance_batch(task, outcomes));
  return z;
}

// Light balls feel only drag: q = q0 e^{-b t}. The one behind gains (q1 - q2)/b on the other in the end.
TEST(HybridLanesAlone, SeeBallsThatGraze) {
  for (const double miss : {-1e-6, -1e-3, 1e-6, 1e-3}) {
    // Ball 2 slows down less: their distance falls and grows again, and is 0.5 - miss at its least.
    const double b1 = 0.5, b2 = 0.1, q1 = 1.0, q2 = 0.6, time = std::log(q1 / q2) / (b1 - b2);
    const double nearer = q1 / b1 * (1.0 - std::exp(-b1 * time)) - q2 / b2 * (1.0 - std::exp(-b2 * time));
    BatchWork work;
    std::vector<Outcome> outcomes;
    two_balls("drag = [0.5, 0.1]\n" + contact(1.0), {1.0, 1.5 + nearer - miss}, {q1, q2}, 4.0, work, outcomes);
    EXPECT_EQ(work.events, miss > 0.0 ? 1u : 0u) << miss;
  }
}

// Rolling resistance alone: q' = -k n with n = (1 + q)^2 against the motion, until the balls are at rest for good.
TEST(HybridLanesAlone, LetBallsStopDead) {
  BatchWork work;
  std::vector<Outcome> outcomes;
  const double q0 = 1e-3, k = 0.01;
  const auto z = two_balls("drag = 0.0\nrolling = 0.01\n", {1.0, 4.0}, {q0, -q0}, 5.0, work, outcomes);
  EXPECT_EQ(z[6], 0.0);
  EXPECT_EQ(z[7], 0.0);
  EXPECT_EQ(work.events, 2u);
  // The integral of q dq/(k (1 + q)^2).
  EXPECT_NEAR(z[4] - 1.0, (std::log1p(q0) - q0 / (1.0 + q0)) / k, 1e-9);
}

// A weak motor brings its rotor up so slowly that balls stay at the edge of what friction holds, where step errors
// release and stop them again and again. That must neither take for ever nor end elsewhere.
TEST(HybridLanesAlone, PassWhereBallsCreepAtTheEdgeOfFriction) {
  const Study study = parse_study(
      "[rotor]\neccentricity = 0.01\ndamping = 0.5\ninertia = 0.5\n[balancer]\nballs = 2\nmass = 0.05\ndrag = 0.05\n"
      "rolling = 0.001\n[speed]\nprofile = \"torque\"\ninitial = 2.25\n"
      "torque = { stall = 0.05, no_load_speed = 2.4 }\n[numerics]\nhorizon = 1000\n",
      "study");
  const std::size_t count = 40;
  const double end = 500.0;
  SpunUp spun;
  const auto source = make_spin_up(study, nullptr);
  ASSERT_TRUE(source->make(study.sampling.seed, 0, count, spun));
  const auto size = static_cast<std::size_t>(study.system().dimension());
  BatchTask task = source->last_task();
  BatchWork work;
  task.end = end;
  task.count = count;
  task.states = spun.states.data();
  task.work = &work;
  std::vector<Outcome> outcomes(count);
  ASSERT_TRUE(advance_batch(task, outcomes));
  // They take 1.3 steps per time unit. Released and stopped at every step, a ball took 500.
  RecordProperty("steps", static_cast<int>(work.steps));
  EXPECT_LT(static_cast<double>(work.steps), 4.0 * end * static_cast<double>(count));
  int resting = 0;
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(outcomes[i].kind, OutcomeKind::undecided) << i;  // none is given up
    const double* z = &spun.states[i * size];
    if (std::fabs(z[6]) > 1e-4 || std::fabs(z[7]) > 1e-4) continue;
    ++resting;
    const Reference reference = one_by_one(study, i, end);
    // Steps of 1e-6 leave 2e-3 where a ball slid through a dozen turns before.
    for (const int k : {4, 5}) EXPECT_NEAR(z[k], reference.state[k], 0.01) << i;
  }
  EXPECT_GT(resting, 0);
}

// A ball thrown against one held by friction: ever smaller bounces, an end in finite time, together at rest.
TEST(HybridLanesAlone, EndASeriesOfImpacts) {
  for (const double restitution : {0.0, 0.5, 0.9}) {
    BatchWork work;
    std::vector<Outcome> outcomes;
    const auto z = two_balls("drag = 0.1\nrolling = 0.01\nstiction = 0.02\n" + contact(restitution), {1.0, 1.8},
                             {0.5, 0.0}, 60.0, work, outcomes);
    EXPECT_EQ(outcomes[0].kind, OutcomeKind::undecided);
    EXPECT_GE(work.events, 2u);
    EXPECT_GE(z[5] - z[4], 0.5 - 1e-9);
    EXPECT_EQ(z[6], 0.0);
    EXPECT_EQ(z[7], 0.0);
  }
}

}  // namespace hybrid_batch_test
