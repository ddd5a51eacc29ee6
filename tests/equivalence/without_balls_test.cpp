// The rotor without balls and with balls held: against densely sampled trajectories, forced vibration and the motor's
// balance of torque; and what an ensemble tells of both.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../support/studies.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/classification/start_runs/transient_tally.hpp"
#include "equipoise/machine/mechanics/forced_vibration.hpp"
#include "equipoise/machine/model/unbalance.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/report/reports/transient_report.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/simulation/spin_up/held_run.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"

namespace equipoise {
namespace without_balls_test {

const std::string short_ramp = "[speed]\nprofile = \"ramp\"\nfinal = 3.0\nduration = 40.0\n";
const std::string motor = R"(inertia = 0.5
[balancer]
balls = 2
mass = 0.05
drag = 0.05
[speed]
profile = "torque"
)";
const std::string driven_rotor = "[rotor]\neccentricity = 0.02\ndamping = 0.2\n" + motor;

Study read(const std::string& text) { return with_horizon(parse_study(text, "bare")); }

HeldRun bare_run(Study study, const TransientSettings& settings = {}) {
  InitialState start = study.initial;
  take_balls_off(study, start);
  return follow_held(study, start, settings);
}

double largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

struct Peaks {
  double radial, force;
};
// Of 400 samples in a unit of time, from `from` on.
Peaks sampled_peaks(const Study& study, double until, double from = 0.0) {
  std::vector<double> times, force;
  for (int k = 0; k <= 400.0 * (until - from); ++k) times.push_back(from + k / 400.0);
  const Trajectory one = simulate(study, times);
  for (std::size_t k = 0; k < one.t.size(); ++k) force.push_back(std::hypot(one.bearing_x[k], one.bearing_y[k]));
  return {largest(one.radial), largest(force)};
}

// Balls that weigh next to nothing, held throughout.
Study weightless(const std::string& text) {
  Study study = parse_study(text, "weightless");
  study.parameters.mass.fill(0.0);
  for (int i = 0; i < study.parameters.balls; ++i) study.parameters.mass[i] = 1e-12;
  study.release = {};
  study.release.time = 1e4;
  return study;
}

// Samples miss less than (w h)^2 / 8 = 1e-5 of a peak; the run itself less than 1e-5.
constexpr double same = 3e-5;

TEST(WithoutBalls, PeaksAreThoseOfTheTrajectoryOfARotorWithWeightlessBalls) {
  for (const std::string& rest :
       {short_ramp, short_ramp + "law = \"published\"\n",
        "[speed]\nprofile = \"points\"\ntimes = [0.0, 20.0, 30.0]\nspeeds = [0.0, 2.0, 1.4]\n" + std::string(),
        std::string("[speed]\nprofile = \"constant\"\nspeed = 2.4\n")}) {
    const std::string text = rotor_and_balancer + rest;
    const HeldRun run = bare_run(read(text));
    const Peaks expected = sampled_peaks(weightless(text), 120.0);
    EXPECT_NEAR(std::sqrt(larger(run.sums.free_peak, run.sums.clamped_peak).square), expected.radial,
                same * expected.radial)
        << rest;
    // Where psi' jumps the force does: its peak just before lies up to a sample away.
    const double at_jump = holds(rest, "published") ? 1e-4 : same;
    EXPECT_NEAR(std::sqrt(run.sums.force_peak), expected.force, at_jump * expected.force) << rest;
  }
}

TEST(WithoutBalls, KnowsUnequalSupportsAndOffCentreRaces) {
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"damping = 0.5", "damping = [0.3, 0.2]\nstiffness = [1.3, 0.8]"},
           {"balls = 2", "balls = 2\nrace_offset = [0.003, -0.002]"}}) {
    const std::string text = with(rotor_and_balancer + short_ramp, from, to);
    const HeldRun run = bare_run(read(text));
    const Peaks expected = sampled_peaks(weightless(text), 150.0);
    EXPECT_NEAR(std::sqrt(larger(run.sums.free_peak, run.sums.clamped_peak).square), expected.radial,
                same * expected.radial)
        << to;
    EXPECT_NEAR(std::sqrt(run.sums.force_peak), expected.force, same * expected.force) << to;
  }
}

TEST(WithoutBalls, AHeavyRotorHangsLowerWithItsBalls) {
  const std::string text = with(rotor_and_balancer + short_ramp, "damping = 0.5", "damping = 0.5\ngravity = 0.3");
  Study bare = read(text);
  InitialState start = bare.initial;
  EXPECT_NEAR(start.y, -0.3 * 1.1, 1e-12);
  take_balls_off(bare, start);
  EXPECT_NEAR(start.y, -0.3, 1e-12);
  EXPECT_NEAR(start.x_dot, 0.0, 1e-12);
  // From its own place of rest it vibrates as if there were no gravity, which stiffness does not notice.
  const HeldRun heavy = follow_held(bare, start, {});
  const HeldRun light = bare_run(read(rotor_and_balancer + short_ramp));
  EXPECT_NEAR(std::sqrt(heavy.sums.clamped_peak.square), std::sqrt(light.sums.clamped_peak.square), 1e-6 * 0.01);
  ASSERT_TRUE(heavy.end && light.end);
  EXPECT_NEAR(heavy.end->radial, light.end->radial, 1e-12);
  EXPECT_NEAR(heavy.end->rms_force, std::hypot(light.end->rms_force, 0.3), 1e-12);
  EXPECT_NEAR(heavy.end->peak_force, light.end->peak_force + 0.3, 1e-9);
}

// By the textbook: r = lambda w^2 / sqrt((1 - w^2)^2 + (zeta w)^2).
TEST(WithoutBalls, MotionAtTheEndIsForcedVibration) {
  const HeldRun run = bare_run(read(rotor_and_balancer + short_ramp));
  const double w = 3.0, r = 0.01 * w * w / std::hypot(1.0 - w * w, 0.5 * w);
  ASSERT_TRUE(run.end);
  EXPECT_TRUE(run.steady);
  EXPECT_NEAR(run.end->radial, r, 1e-12);
  EXPECT_NEAR(run.end->rms_velocity, w * r, 1e-12);
  EXPECT_NEAR(run.end->rms_force, r * std::hypot(1.0, 0.5 * w), 1e-12);
  EXPECT_NEAR(run.end->peak_force, run.end->rms_force, 1e-12);
  EXPECT_DOUBLE_EQ(run.end->unbalance, 0.01);
}

TEST(WithoutBalls, ForcedVibrationIsWhatTrajectoriesComeTo) {
  const std::string text = with(rotor_and_balancer + short_ramp, "damping = 0.5",
                                "damping = [0.3, 0.2]\nstiffness = [1.3, 0.8]\ngravity = 0.02");
  const Study study = weightless(text);
  const model::MotionFigures f = model::forced_vibration(study.parameters, 0.01, 3.0);
  std::vector<double> times;
  constexpr int each = 2000, turns = 4;
  for (int k = 0; k <= turns * each; ++k) times.push_back(400.0 + 2.0 * 3.14159265358979 / 3.0 * k / each);
  const Trajectory one = simulate(study, times);
  double radial = 0.0, peak = 0.0, force = 0.0, velocity = 0.0;
  for (std::size_t k = 0; k + 1 < one.t.size(); ++k) {
    const double u = one.x_dot[k] - one.psi_dot[k] * one.y[k], v = one.y_dot[k] + one.psi_dot[k] * one.x[k];
    const double square = one.bearing_x[k] * one.bearing_x[k] + one.bearing_y[k] * one.bearing_y[k];
    const double sag = -0.02 / 0.8, rx = one.x[k] - sag * std::sin(one.psi[k]),
                 ry = one.y[k] - sag * std::cos(one.psi[k]);
    radial = std::max(radial, std::hypot(rx, ry));
    peak = std::max(peak, std::sqrt(square));
    force += square / (turns * each);
    velocity += (u * u + v * v) / (turns * each);
  }
  EXPECT_NEAR(f.radial, radial, 1e-5 * radial);
  EXPECT_NEAR(f.peak_force, peak, 1e-5 * peak);
  EXPECT_NEAR(f.rms_force, std::sqrt(force), 1e-5 * f.rms_force);
  EXPECT_NEAR(f.rms_velocity, std::sqrt(velocity), 1e-5 * f.rms_velocity);
}

TEST(WithoutBalls, HeldBallsThatWeighNothingAreNoBalls) {
  Study study = read(rotor_and_balancer + short_ramp);
  const HeldRun bare = bare_run(study);
  study.parameters.mass.fill(0.0);
  InitialState start = study.initial;
  start.phi[0] = 1.0;
  start.phi[1] = 2.5;
  const HeldRun held = follow_held(study, start, {});
  EXPECT_EQ(held.sums.clamped_peak.square, bare.sums.clamped_peak.square);
  EXPECT_EQ(held.sums.force_peak, bare.sums.force_peak);
  EXPECT_EQ(held.end->radial, bare.end->radial);
}

TEST(HeldBalls, PeaksAreThoseOfTheTrajectoryWithBallsThatAreNeverLetGo) {
  const std::string text = with(rotor_and_balancer + short_ramp, "damping = 0.5", "damping = 0.5\ngravity = 0.1");
  Study study = read(text);
  study.initial.phi = {0.4, 1.1};
  const HeldRun run = follow_held(study, study.initial, {});
  Study never = study;
  never.release.time = 1e4;
  std::vector<double> times;
  for (int k = 0; k <= 400 * 120; ++k) times.push_back(k / 400.0);
  const Trajectory one = simulate(never, times);
  double peak = 0.0;
  for (std::size_t k = 0; k < one.t.size(); ++k)
    peak = std::max(peak, std::hypot(one.x[k] + 0.11 * std::sin(one.psi[k]), one.y[k] + 0.11 * std::cos(one.psi[k])));
  EXPECT_NEAR(std::sqrt(larger(run.sums.clamped_peak, run.sums.free_peak).square), peak, same * peak);
  EXPECT_NEAR(run.end->unbalance, std::abs(model::unbalance(study.parameters, study.initial.phi.data())), 1e-12);
}

// A steady speed is where the motor gives what vibration takes.
TEST(WithoutBalls, AWeakMotorStallsWhereShakingTakesItsTorque) {
  const Study study = read(driven_rotor + "torque = { constant = 0.0012, slope = -0.0003 }\n");
  const HeldRun run = bare_run(study);
  ASSERT_TRUE(run.steady);
  EXPECT_LT(run.speed, study.stall_speed());
  const double taken = model::shaking_torque(study.parameters, 0.02, run.speed);
  Study bare = study;
  bare.parameters.mass.fill(0.0);
  EXPECT_NEAR(0.0012 - 0.0003 * run.speed, model::shaking_torque(bare.parameters, 0.02, run.speed), 1e-6);
  EXPECT_GT(taken, 0.0);
  const double w = run.speed, r = 0.02 * w * w / std::hypot(1.0 - w * w, 0.2 * w);
  const TransientRow row = transient_row({}, run.sums, false, run.end);
  EXPECT_NEAR(row.peak_radial_at_end, r, 1e-4 * r);
  EXPECT_NEAR(row.rms_velocity, w * r, 1e-4 * w * r);
}

TEST(WithoutBalls, AStrongMotorPassesAndItsReleaseIsTimed) {
  const Study study = read(driven_rotor + "torque = { constant = 0.12, slope = -0.04 }\n[release]\nspeed = 2.0\n");
  const HeldRun run = bare_run(study);
  ASSERT_TRUE(run.steady);
  EXPECT_NEAR(run.speed, 3.0, 0.05);
  Study alone = weightless(driven_rotor + "torque = { constant = 0.12, slope = -0.04 }\n");
  std::vector<double> times;
  for (int k = 0; k <= 400 * 60; ++k) times.push_back(k / 400.0);
  const Trajectory one = simulate(alone, times);
  const auto at = std::find_if(one.psi_dot.begin(), one.psi_dot.end(), [](double w) { return w >= 2.0; });
  ASSERT_NE(at, one.psi_dot.end());
  EXPECT_NEAR(run.released, one.t[static_cast<std::size_t>(at - one.psi_dot.begin())], 1.0 / 400.0);
  EXPECT_NEAR(std::sqrt(larger(run.sums.clamped_peak, run.sums.free_peak).square), largest(one.radial),
              same * largest(one.radial));
}

const std::string limited =
    constant_speed + "[sampling]\nstarts = 600\n[limits]\ndisplacement = 0.02\nvelocity = 0.01\n";

TEST(Basin, TellsWhatTheRotorDoesWithoutBalls) {
  BasinOptions one_thread;
  one_thread.threads = 1;
  const BasinResult r = basin(parse_study(limited, "s"), one_thread);
  ASSERT_TRUE(r.without_balls);
  const OneBodyRuns &bare = r.without_balls->bare, &held = r.without_balls->held;
  EXPECT_TRUE(bare.one);
  EXPECT_EQ(bare.runs, 1u);
  EXPECT_EQ(held.runs, most_held_starts);
  EXPECT_EQ(held.figures.starts, most_held_starts);
  const HeldRun run = bare_run(with_horizon(parse_study(limited, "s")), transient_settings(r.study));
  EXPECT_EQ(bare.figures.figure(&TransientRow::rms_velocity).quantiles[0].value,
            static_cast<double>(static_cast<float>(run.end->rms_velocity)));
  BasinOptions two_threads;
  two_threads.threads = 2;
  const BasinResult again = basin(parse_study(limited, "s"), two_threads);
  EXPECT_EQ(Json(PartOf{*again.without_balls, r.study}), Json(PartOf{*r.without_balls, r.study}));
  EXPECT_TRUE(holds(basin_text(r), "No balls: one run. Balls held where they start: median of 256."));
  const auto json = nlohmann::json::parse(json_text(r))["without_balls"];
  EXPECT_EQ(json["no_balls"]["one_for_all"], true);
  EXPECT_FALSE(json["no_balls"]["figures"]["peak_radial"].contains("mean_low"));
  EXPECT_TRUE(json["balls_held"]["figures"]["peak_radial"].contains("mean_low"));
  EXPECT_FALSE(json["no_balls"]["figures"].contains("energy"));
}

TEST(Basin, DoesNotTellItWhereTransientsAreNotAsked) {
  const BasinResult r = basin(parse_study(constant_speed + "[sampling]\nstarts = 20\n", "s"));
  EXPECT_FALSE(r.without_balls);
  EXPECT_FALSE(holds(basin_text(r), "No balls"));
  EXPECT_FALSE(nlohmann::json::parse(json_text(r)).contains("without_balls"));
}

TEST(Basin, UncertainRotorsAreBareOneByOne) {
  const std::string text = with(limited, "eccentricity = 0.01", "eccentricity = { uniform = [0.005, 0.015] }");
  const BasinResult r = basin(parse_study(text, "s"));
  ASSERT_TRUE(r.without_balls);
  const OneBodyRuns& bare = r.without_balls->bare;
  EXPECT_FALSE(bare.one);
  EXPECT_EQ(bare.runs, most_held_starts);
  // Its unbalance is the eccentricity that was drawn: uniform, so that 90 % lie below 0.014; 256 draws, 4 errors.
  const SampleSummary& left = bare.figures.figure(&TransientRow::residual_unbalance);
  EXPECT_NEAR(left.quantiles[1].value, 0.014, 4.0 * std::sqrt(0.09 / 256.0) * 0.01);
  EXPECT_TRUE(holds(basin_text(r), "No balls: median of 256 runs."));
}

TEST(Basin, SaysThatAMotorStallsWithoutBalls) {
  const std::string weak = driven_rotor + "torque = { constant = 0.0012, slope = -0.0003 }\n[sampling]\nstarts = 20\n";
  BasinOptions options;
  options.transients = true;
  const BasinResult r = basin(parse_study(weak, "s"), options);
  EXPECT_EQ(r.without_balls->bare.stalled, 1u);
  EXPECT_TRUE(holds(basin_text(r), "Without balls the motor does not bring the rotor up to speed: it ends at "));
  const std::string strong = with(weak, "constant = 0.0012, slope = -0.0003", "constant = 0.12, slope = -0.04");
  const BasinResult s = basin(parse_study(strong, "s"), options);
  EXPECT_EQ(s.without_balls->bare.stalled, 0u);
  EXPECT_FALSE(holds(basin_text(s), "Without balls the motor"));
}

TEST(Basin, SaysHowManyTimesTheBareRotorsPeakItIs) {
  BasinOptions options;
  options.transients = true;
  const BasinResult r = basin(parse_study(rotor_and_balancer + short_ramp + "[sampling]\nstarts = 20\n", "s"), options);
  const double times = r.transients->groups.front().figure(&TransientRow::peak_radial).quantiles[0].value /
                       r.without_balls->bare.figures.figure(&TransientRow::peak_radial).quantiles[0].value;
  EXPECT_TRUE(
      holds(basin_text(r), fmt::format("Peak displacement: {:.3g} times that without balls in the median", times)));
  // A rotor in balance does not shake.
  const std::string still = with(rotor_and_balancer, "eccentricity = 0.01", "eccentricity = 0.0") + short_ramp;
  EXPECT_FALSE(
      holds(basin_text(basin(parse_study(still + "[sampling]\nstarts = 20\n", "s"), options)), "times that without"));
}

TEST(Basin, SaysWhichLimitsTheBareRotorKeeps) {
  // By itself it ends at r = 0.0111 and peaks at 0.0225.
  const auto text_of = [](const std::string& limits) {
    return basin_text(
        basin(parse_study(rotor_and_balancer + short_ramp + "[sampling]\nstarts = 20\n[limits]\n" + limits, "s")));
  };
  EXPECT_TRUE(holds(text_of("displacement = 0.01\n"),
                    "Without balls the rotor exceeds a limit during start-up and at full speed."));
  EXPECT_TRUE(holds(text_of("displacement = 0.02\n"), "exceeds a limit during start-up, but not at full speed."));
  EXPECT_TRUE(holds(text_of("displacement = 0.03\n"), "Without balls the rotor meets every limit."));
  EXPECT_TRUE(holds(text_of("velocity = 0.03\n"), "Without balls the rotor exceeds a limit at full speed."));
}

TEST(Basin, AResumedFileHoldsTheSameWithoutBalls) {
  const std::string file = testing::TempDir() + "without_balls.nc";
  std::filesystem::remove(file);
  BasinOptions options;
  options.output = file;
  const BasinResult few = basin(parse_study(with(limited, "starts = 600", "starts = 300"), "s"), options);
  const BasinResult more = basin(parse_study(limited, "s"), options);
  EXPECT_EQ(more.resumed_from, 300u);
  EXPECT_EQ(Json(PartOf{*few.without_balls, few.study}), Json(PartOf{*more.without_balls, more.study}));
  const BasinResult fresh = basin(parse_study(limited, "s"));
  EXPECT_EQ(Json(PartOf{*fresh.without_balls, fresh.study}), Json(PartOf{*more.without_balls, more.study}));
}

}  // namespace without_balls_test
}  // namespace equipoise
