// The drive's work, as gathered in transients, against the torque that single trajectories need: prescribed speeds with
// the balls held and free, motors on lanes and from event to event.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../support/studies.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/classification/start_runs/transient_tally.hpp"
#include "equipoise/machine/mechanics/energy.hpp"
#include "equipoise/simulation/spin_up/start_source.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "equipoise/study/sampling/starts.hpp"
#include "transient_lanes.hpp"

namespace equipoise {
namespace drive_work_test {

// About a disc's: the rotor's spin takes at least a tenth of all.
const std::string inertia = "inertia = 0.3\n";
const std::string heavy =
    "[rotor]\neccentricity = 0.01\ndamping = 0.5\n" + inertia + "[balancer]\nballs = 2\nmass = 0.05\ndrag = 0.05\n";
const std::string skew =
    "[rotor]\neccentricity = 0.01\ndamping = [0.4, 0.6]\nstiffness = [1.0, 1.3]\ngravity = 0.02\n" + inertia +
    "[balancer]\nballs = 3\nmass = 0.04\ndrag = 0.05\n";

std::vector<double> state_of(const Trajectory& one, std::size_t k) {
  std::vector<double> z{one.x[k], one.y[k], one.x_dot[k] - one.psi_dot[k] * one.y[k],
                        one.y_dot[k] + one.psi_dot[k] * one.x[k]};
  for (const auto& phi : one.phi) z.push_back(phi[k]);
  for (const auto& rate : one.phi_dot) z.push_back(rate[k]);
  return z;
}

struct Work {
  double drive = 0.0;    // of the torque, without pieces in which more was returned than supplied
  double net = 0.0;      // of the torque in total
  double balance = 0.0;  // stored and dissipated in total
};

// Until `until`, with 400 samples per unit of time: linear interpolation gives the work to 1e-5 of what goes back and
// forth.
Work torque_work(const Study& study, double until) {
  const model::Parameters& p = study.parameters;
  std::vector<model::Segment> segments = model::segments(study.speed_profile(), study.release_time());
  segments.back().end = until;
  Work work;
  double piece = 0.0, first = 0.0;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const model::Segment& segment = segments[s];
    const int count = static_cast<int>(std::ceil((segment.end - segment.begin) * 400.0));
    std::vector<double> times;
    for (int k = 0; k <= count; ++k) times.push_back(segment.begin + (segment.end - segment.begin) * k / count);
    times.back() = segment.end;
    const Trajectory one = simulate(study, times);
    model::Powers before{};
    for (std::size_t k = 0; k < times.size(); ++k) {
      const std::vector<double> z = state_of(one, k);
      const model::Powers now = model::powers(p, p.inertia, segment, times[k], z.data());
      const double stored = model::energy(p, p.inertia, segment, times[k], z.data());
      if (s == 0 && k == 0) first = stored;
      if (s + 1 == segments.size() && k + 1 == times.size()) work.balance += stored - first;
      if (k > 0) {
        const double half = 0.5 * (times[k] - times[k - 1]);
        piece += half * (before.drive + now.drive);
        work.balance += half * (before.supports + now.supports + before.balls + now.balls);
      }
      before = now;
    }
    if (s + 1 < segments.size() && segments[s + 1].acceleration == segment.acceleration) continue;
    work.drive += std::max(piece, 0.0);
    work.net += piece;
    piece = 0.0;
  }
  return work;
}

struct Case {
  const char* name;
  std::string study;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class DriveWorkOfSpeeds : public testing::TestWithParam<Case> {};

// As in transients_test.cpp: followed for `horizon` after the last piece begins.
TEST_P(DriveWorkOfSpeeds, IsThatOfTheTorqueThatTheyNeed) {
  const Case& c = GetParam();
  Study study = parse_study(c.study, c.name);
  const TransientSettings asked = transient_settings(study);
  ASSERT_EQ(asked.work, WorkSource::balance);
  const double horizon = 20.0;
  const std::vector<TransientRow> rows = gathered(study, asked, 4, horizon);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    start_angles(study.sampling.seed, i, study.parameters.balls, study.initial.phi.data());
    const Work work = torque_work(study, StartSource(study, nullptr).settled() + horizon);
    const double told = rows[i].energy;
    // Cubics through four samples per step give the losses of dampers and drag to 1e-4; lanes at tolerance 1e-6 give
    // their states more accurately.
    EXPECT_NEAR(told, work.drive, 2e-4 * work.drive) << c.name << ", start " << i;
    EXPECT_NEAR(work.net, work.balance, 2e-5 * work.drive) << c.name << ", start " << i;
  }
}

const std::string ramp = "[speed]\nprofile = \"ramp\"\nfinal = 2.4\nduration = 60.0\n";
const std::string overshoot = "[speed]\nprofile = \"points\"\ntimes = [0.0, 40.0, 60.0]\nspeeds = [0.0, 4.0, 2.0]\n";

INSTANTIATE_TEST_SUITE_P(
    All, DriveWorkOfSpeeds,
    testing::Values(Case{"constant speed", constant_speed}, Case{"ramp, held to its end", heavy + ramp},
                    Case{"ramp, free", heavy + "[release]\ntime = 0.0\n" + ramp},
                    Case{"ramp, let go on the way", heavy + "[release]\ntime = 30.0\n" + ramp},
                    Case{"braking, held", heavy + overshoot},
                    Case{"braking, let go before", heavy + "[release]\ntime = 20.0\n" + overshoot},
                    Case{"gravity and unequal supports, let go on the way", skew + "[release]\ntime = 30.0\n" + ramp}),
    [](const auto& param) { return std::to_string(param.index); });

// A braking drive recovers nothing.
TEST(DriveWork, IsNotGivenBackByBraking) {
  const auto work = [&](const std::string& speed) {
    return torque_work(parse_study(heavy + "[release]\ntime = 0.0\n" + speed, "braking"), 60.0 + 1e-3);
  };
  const Work down = work(overshoot);
  // Of what the rotor's spin gives up, most comes back; dampers and drag take the rest.
  EXPECT_GT(down.drive, down.net + 0.5 * (0.5 * 0.3 * (16.0 - 4.0)));
}

// A motor's torque is its law, whatever its balls do. `phi` comes from the replay if the start has it.
double motor_work(Study study, const StartReplay& replay, double until) {
  study.initial = replay.start;
  std::vector<double> times;
  const int count = static_cast<int>(std::ceil(until * 400.0));
  for (int k = 0; k <= count; ++k) times.push_back(until * k / count);
  const Trajectory one = simulate(study, times);
  const std::vector<model::DriveSegment> law = model::drive_segments(study.motor());
  double work = 0.0, before = 0.0;
  std::size_t piece = 0;
  for (std::size_t k = 0; k < one.t.size(); ++k) {
    while (piece + 1 < law.size() && law[piece].end <= one.t[k]) ++piece;
    const double now = law[piece].motor_torque(one.t[k], one.psi_dot[k], 0.0) * one.psi_dot[k];
    if (k > 0) work += 0.5 * (one.t[k] - one.t[k - 1]) * (before + now);
    before = now;
  }
  return work;
}

void expect_motor_work(const std::string& text) {
  const Study study = parse_study(text, "motor");
  BasinOptions options;
  options.transients = true;
  for (const std::uint64_t i : {0, 1}) {
    const StartReplay replay = replay_start(study, i, options);
    ASSERT_TRUE(replay.transients);
    const double work = motor_work(study, replay, replay.outcome.time);
    // Linear across the step in which balls are released; ways differ by the lanes' tolerance.
    EXPECT_NEAR(replay.transients->energy, work, 1e-3 * work) << text << i;
  }
}

const std::string motor = "[speed]\nprofile = \"torque\"\ntorque = { stall = 0.2, no_load_speed = 3.0 }\n";

TEST(DriveWorkOfMotors, IsThatOfTheirTorque) { expect_motor_work(heavy + "[release]\ntime = 0.0\n" + motor); }
TEST(DriveWorkOfMotors, IsThatOfACurveWhateverTheLoadTakes) {
  expect_motor_work(heavy +
                    "[release]\ntime = 0.0\n[speed]\nprofile = \"torque\"\nload = { quadratic = 0.05, at = 2.0 }\n" +
                    "torque = { speeds = [0.0, 1.0, 2.5, 3.0], values = [0.2, 0.3, 0.25, 0.0] }\n");
}
TEST(DriveWorkOfMotors, CountsTheWayWithTheBallsHeld) { expect_motor_work(heavy + "[release]\nspeed = 2.0\n" + motor); }
TEST(DriveWorkOfMotors, CountsPiecesOfTheirLaw) {
  expect_motor_work(heavy +
                    "[speed]\nprofile = \"torque\"\ninitial = 2.0\ntorque = { times = [0.0, 10.0, 20.0], values = "
                    "[0.1, 0.02, 0.02] }\n" +
                    "[numerics]\nhorizon = 60.0\n[release]\ntime = 0.0\n");
}
TEST(DriveWorkOfMotors, IsKnownWithContact) {
  expect_motor_work(heavy + "contact_angle = 0.3\n[release]\ntime = 0.0\n" + motor);
}

// Unknown work is not reported.
TEST(DriveWork, IsAskedWhereItIsKnown) {
  const auto known = [](const std::string& text) { return knows_energy(parse_study(text, "known")); };
  EXPECT_TRUE(known(constant_speed));
  EXPECT_TRUE(known(heavy + ramp));
  EXPECT_FALSE(known(rotor_and_balancer + ramp));               // no inertia
  EXPECT_FALSE(known(heavy + "contact_angle = 0.3\n" + ramp));  // the loss at impacts
  EXPECT_TRUE(known(heavy + "contact_angle = 0.3\n" + motor));
  const Study study = parse_study(rotor_and_balancer + ramp, "unknown");
  BasinOptions options;
  options.transients = true;
  EXPECT_TRUE(std::isnan(replay_start(study, 0, options).transients->energy));
}

}  // namespace drive_work_test
}  // namespace equipoise
