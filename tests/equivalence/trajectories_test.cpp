// Trajectories of many starts: each as simulate() gives it alone, on every kind of rotor, whatever runs beside it.
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cases.hpp"
#include "equipoise/analyses/one_study/trajectories.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/results/result_files/trajectory_file.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"

namespace equipoise {
namespace trajectories_test {

constexpr std::size_t starts = 11;  // no multiple of a number of lanes

Study with_starts(Study study) {
  study.sampling.starts = starts;
  study.sampling.seed = 5;
  return study;
}

// The largest difference of any number in any row, in the units of the columns. Rows of both must be as many.
double difference(const Trajectory& a, const Trajectory& b) {
  double most = 0.0;
  const auto compare = [&](const std::vector<double>& p, const std::vector<double>& q, const char* name) {
    ASSERT_EQ(p.size(), q.size()) << name;
    for (std::size_t k = 0; k < p.size(); ++k) most = std::max(most, std::fabs(p[k] - q[k]));
  };
  for (const TrajectoryColumn& c : trajectory_columns) {
    if (c.values) compare(a.*c.values, b.*c.values, c.name);
    if (!c.each) continue;
    EXPECT_EQ((a.*c.each).size(), (b.*c.each).size()) << c.name;
    for (std::size_t i = 0; i < (a.*c.each).size(); ++i) compare((a.*c.each)[i], (b.*c.each)[i], c.name);
  }
  return most;
}

// Before the release, at it, where pieces of the drive end (20 to 60 in the cases), and between.
const std::vector<double> times{0.0, 0.3, 5.0, 7.3, 18.0, 20.0, 20.1, 33.0, 40.0, 60.0, 71.7};

// Both are followed to 1e-12 a step, lanes by a norm of their own; none of these is chaotic. Over 72 units of time
// errors of 1e-12 grow at most by e^10.
constexpr double same_run = 1e-7;

void expect_each_alone(const Study& given) {
  const Study study = with_starts(given);
  const std::vector<InitialState> from = drawn_starts(study);
  const Trajectories many = simulate(study, from, times);
  ASSERT_EQ(many.runs.size(), starts);
  EXPECT_FALSE(many.stopped);
  for (std::size_t i = 0; i < starts; ++i) {
    Study own = study;
    own.initial = from[i];
    const Trajectory alone = simulate(own, times);
    EXPECT_EQ(many.runs[i].status, alone.status);
    EXPECT_LT(difference(many.runs[i], alone), same_run) << study.name << ", start " << i;
  }
}

TEST(ManyTrajectories, AreThoseOfEachStartAlone) {
  for (cases::Case c : cases::all()) {
    c.study.initial.phi_dot = {};  // as of all balls that are held
    for (int i = c.study.parameters.balls; i < model::max_balls; ++i) c.study.initial.phi[i] = 0.0;
    expect_each_alone(c.study);
  }
}

const std::string damped = "[rotor]\neccentricity = 0.02\ndamping = 0.4\ninertia = 4.0\n",
                  two_balls = "[balancer]\nballs = 2\nmass = 0.03\ndrag = 0.3\n",
                  two_speeds = "[speed]\nprofile = \"ramp\"\nfinal = 2.4\nduration = 40.0\n[release]\ntime = 5.0\n";

TEST(ManyTrajectories, OfMotorsTouchingBallsAndTiltingRotorsToo) {
  const std::string motor = "[speed]\nprofile = \"torque\"\ntorque = { stall = 0.4, no_load_speed = 3.2 }\n";
  expect_each_alone(parse_study(damped + two_balls + motor, "motor"));
  expect_each_alone(parse_study(
      damped + "[balancer]\nballs = 2\nmass = 0.03\ndrag = 0.3\ncontact_angle = 0.5\nrestitution = 0.3\n" + two_speeds,
      "touching"));
  const std::string tilting =
                        "[rotor.tilt]\ntransverse_inertia = 2.5\npolar_inertia = 1.0\nstiffness = { x = [0.2, 9.0], y "
                        "= [0.2, 10.0] }\n"
                        "damping = { x = [0.1, 1.2], y = [0.1, 1.2] }\nbearings_at = [1.5, -1.0]\n",
                    in_plane = "[balancer]\nballs = 2\nplane = 1.2\nmass = 0.03\ndrag = 0.3\n";
  expect_each_alone(parse_study(damped + tilting + in_plane + two_speeds, "tilting, held"));
  const std::string never_held = "[speed]\nprofile = \"ramp\"\nfinal = 1.4\nduration = 40.0\n[release]\ntime = 0.0\n";
  expect_each_alone(parse_study(damped + tilting + in_plane + never_held, "tilting, free"));
  expect_each_alone(parse_study(
      damped + "[balancer]\nballs = 2\nmass = 0.03\ndrag = 0.3\nstiction = 0.01\n" + two_speeds, "sticking"));
}

void expect_same_bits(const Trajectories& a, const Trajectories& b, std::size_t first) {
  for (std::size_t i = 0; i < b.runs.size(); ++i) EXPECT_EQ(difference(a.runs[first + i], b.runs[i]), 0.0);
}

TEST(ManyTrajectories, DependNeitherOnThreadsNorOnEachOther) {
  Study study = parse_study(damped + two_balls + two_speeds, "ramp");
  study.sampling.starts = 600;  // more than two blocks
  const std::vector<InitialState> from = drawn_starts(study);
  RunOptions one, three;
  one.threads = 1;
  three.threads = 3;
  const Trajectories all = simulate(study, from, times, one);
  expect_same_bits(all, simulate(study, from, times, three), 0);
  expect_same_bits(all, simulate(study, std::span(from).subspan(250, 17), times, one), 250);
  // More output times move no state by more than the error of a step.
  std::vector<double> fewer{times.front(), times.back()};
  const Trajectories ends = simulate(study, from, fewer, one);
  for (std::size_t i = 0; i < from.size(); ++i) EXPECT_NEAR(ends.runs[i].x.back(), all.runs[i].x.back(), same_run);
}

TEST(ManyTrajectories, EndWhereTheyAreLost) {
  Study study = parse_study(damped + two_balls + "[speed]\nprofile = \"constant\"\nspeed = 2.4\n", "lost");
  std::vector<InitialState> from(3, study.initial);
  for (InitialState& s : from) s.phi = {1.0, 4.0};
  from[1].phi_dot = {1e200, 0.0};  // beyond any rate that can be followed
  const Trajectories many = simulate(study, from, {0.0, 1.0, 2.0});
  EXPECT_NE(many.runs[1].status, IntegrationStatus::done);
  EXPECT_LT(many.runs[1].t.size(), 3u);
  for (const std::size_t i : {0, 2}) {
    EXPECT_EQ(many.runs[i].status, IntegrationStatus::done);
    EXPECT_EQ(many.runs[i].t.size(), 3u);
  }
  const std::string text = trajectory_csv(many, study);
  EXPECT_TRUE(text.starts_with("start,t,psi,psi_dot,x,y,"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'),
            static_cast<std::ptrdiff_t>(7 + many.runs[1].t.size()));  // titles, and three rows of two runs
}

TEST(ManyTrajectories, RefuseWhatCannotBeFollowed) {
  const Study study = parse_study(damped + two_balls + two_speeds, "held");
  InitialState moving = study.initial;
  moving.phi_dot[0] = 1.0;  // held until 5
  EXPECT_THROW(simulate(study, std::vector{moving}, {0.0, 1.0}), InputError);
  EXPECT_THROW(simulate(study, std::vector{study.initial}, {1.0, 1.0}), InputError);
}

TEST(ManyTrajectories, StopEarly) {
  Study study = parse_study(damped + two_balls + two_speeds, "stopped");
  study.sampling.starts = 2000;
  RunOptions options;
  options.threads = 1;
  StopFlag stop{false};
  options.stop = &stop;
  options.progress = [&](const Progress& p) {
    EXPECT_EQ(p.total, 2000u);
    stop = true;
  };
  const Trajectories some = simulate(study, drawn_starts(study), times, options);
  EXPECT_TRUE(some.stopped);
  EXPECT_EQ(some.runs.front().t.size(), times.size());
  EXPECT_TRUE(some.runs.back().t.empty());
}

}  // namespace trajectories_test
}  // namespace equipoise
