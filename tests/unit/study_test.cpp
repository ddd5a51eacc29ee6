// The study reader on good input: shipped studies, defaults, release rules, speed laws, overrides, the echo.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/study/contents/study.hpp"
#include "../support/studies.hpp"
#include "../support/study_difference.hpp"

namespace equipoise {
namespace study_test {

const std::string& ramp = ramp_speed;
const std::string trapezoid = rotor_and_balancer + R"([speed]
profile = "trapezoid"
peak = 3.0
final = 2.0
rise_until = 50.0
hold_until = 400.0
fall_until = 500.0
)";
const std::string points = rotor_and_balancer + R"([speed]
profile = "points"
times = [0.0, 10.0, 30.0, 40.0]
speeds = [1.0, 3.0, 3.0, 0.5]
)";

Study parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_study(text, "test.toml", overrides);
}

// A release time is one interpolation within a piece, accurate to a few units in the last place (EXPECT_DOUBLE_EQ).
double release_time(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse(text, overrides).release_time();
}

void expect_round_trip(const Study& study) {
  const std::string echo = to_toml(study);
  const Study back = parse_study(echo, "echo");
  EXPECT_EQ(first_difference(study, back), "");
  EXPECT_EQ(to_toml(back), echo);
}

std::vector<std::filesystem::path> shipped_studies() {
  std::vector<std::filesystem::path> result;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(EQUIPOISE_SOURCE_DIR "/studies"))
    if (entry.path().extension() == ".toml") result.push_back(entry.path());
  std::sort(result.begin(), result.end());
  return result;
}

const std::string paper = EQUIPOISE_SOURCE_DIR "/studies/paper/";

TEST(ShippedStudies, AllReadAndRoundTrip) {
  const auto paths = shipped_studies();
  EXPECT_GE(paths.size(), 95u);  // the cells of the paper's seven tables
  for (const auto& path : paths) {
    SCOPED_TRACE(path.string());
    const Study study = read_study(path.string());
    EXPECT_EQ(study.name, path.string());
    expect_round_trip(study);
  }
}

TEST(ShippedStudies, OfThePaperSayWhatTheTablesSay) {
  const Study cell = read_study(paper + "table-1-beta-0.25-omega-6.0.toml");
  EXPECT_EQ(cell.parameters.balls, 2);
  EXPECT_EQ(cell.parameters.eccentricity, 0.01);
  EXPECT_EQ(cell.parameters.damping, (std::array{0.5, 0.5}));
  EXPECT_EQ(cell.parameters.drag[1], 0.25);
  EXPECT_EQ(cell.speed.speed, 6.0);
  EXPECT_EQ(cell.release_time(), 0.0);
  EXPECT_EQ(cell.sampling.starts, 300000u);

  const Study impulse = read_study(paper + "table-3-t0-0.000001.toml");
  EXPECT_EQ(impulse.speed.law, model::SpeedLaw::published);
  EXPECT_EQ(impulse.speed.duration, 1e-6);
  EXPECT_EQ(impulse.release_time(), 1e-6);
  EXPECT_EQ(impulse.sampling.starts, 100000u);

  const Study early = read_study(paper + "table-5-t0-100.toml");
  EXPECT_DOUBLE_EQ(early.release_time(), 100.0 * 2.2 / 2.4);  // as the ramp function reaches 2.2

  const Study falling = read_study(paper + "table-7-t0-50-t1-400-t2-500.toml");
  EXPECT_EQ(falling.release_time(), 50.0);
  EXPECT_EQ(falling.speed_profile().final_speed(), 2.0);
}

TEST(Defaults, AreThoseOfTheManual) {
  const Study study = parse(ramp);
  EXPECT_EQ(study.parameters.stiffness, (std::array{1.0, 1.0}));
  EXPECT_EQ(study.parameters.gravity, 0.0);
  EXPECT_EQ(study.speed.initial, 0.0);
  EXPECT_EQ(study.speed.law, model::SpeedLaw::kinematic);
  EXPECT_FALSE(study.release.speed || study.release.time);
  EXPECT_EQ(study.initial.phi[0], 0.0);
  EXPECT_EQ(study.initial.phi_dot[1], 0.0);
  EXPECT_EQ(study.sampling.starts, 100000u);
  EXPECT_EQ(study.sampling.seed, 1u);
  EXPECT_FALSE(study.numerics.tolerance);
  EXPECT_FALSE(study.numerics.horizon);
}

TEST(Parameters, GivenOnceHoldForEveryBallAndDirection) {
  const Study study = parse(ramp, {"balancer.balls=8", "rotor.damping=0.3"});
  EXPECT_EQ(study.parameters.balls, 8);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(study.parameters.mass[i], 0.05);
  EXPECT_EQ(study.parameters.damping, (std::array{0.3, 0.3}));
}

TEST(Parameters, MayBeGivenOneABallAndOneADirection) {
  const Study study = parse(ramp, {"balancer.mass=[0.04, 0.06]", "rotor.stiffness=[1.0, 1.5]"});
  EXPECT_EQ(study.parameters.mass[0], 0.04);
  EXPECT_EQ(study.parameters.mass[1], 0.06);
  EXPECT_FALSE(study.parameters.isotropic());
  EXPECT_FALSE(study.parameters.equal_balls());
}

TEST(Numbers, MayBeWrittenAsAnyTomlNumber) {
  EXPECT_EQ(parse(ramp, {"initial.psi=3"}).initial.psi, 3.0);
  EXPECT_EQ(parse(ramp, {"initial.psi=0x10"}).initial.psi, 16.0);
  EXPECT_EQ(parse(ramp, {"initial.psi=-1_000.5e-3"}).initial.psi, -1.0005);
  // The nearest double to an integer that no double equals, as for decimals.
  EXPECT_EQ(parse(ramp, {"initial.psi=9007199254740993"}).initial.psi, 9007199254740992.0);
}

TEST(Release, FollowsTheProfileWhereNothingIsSaid) {
  EXPECT_EQ(release_time(constant_speed), 0.0);
  EXPECT_EQ(release_time(ramp), 500.0);
  EXPECT_EQ(release_time(trapezoid), 50.0);
  EXPECT_EQ(release_time(points), 40.0);
  EXPECT_EQ(release_time(ramp + "[release]\n"), 500.0);
}

TEST(InitialAngles, AreSpreadEvenlyWhereNothingIsSaid) {
  const Study three = parse(ramp, {"balancer.balls=3"});
  for (int i = 0; i < 3; ++i) EXPECT_DOUBLE_EQ(three.initial.phi[i], two_pi * i / 3.0);
  EXPECT_EQ(three.initial.phi[3], 0.0);
  EXPECT_FALSE(states_angles(three));
  EXPECT_EQ(to_toml(three).find("phi ="), std::string::npos);
  expect_round_trip(three);
}

TEST(InitialAngles, ThatAreStatedAreKept) {
  for (const char* phi : {"[1.0, 1.0]", "0", "[0.0, 3.14159265358979323846]"}) {
    const Study study = parse(ramp, {fmt::format("initial.phi={}", phi)});
    EXPECT_TRUE(states_angles(study)) << phi;
    EXPECT_NE(to_toml(study).find("phi = ["), std::string::npos) << phi;
    EXPECT_TRUE(states_angles(parse(to_toml(study)))) << phi;
    expect_round_trip(study);
  }
  Study by_code = parse(ramp);
  by_code.initial.phi = {0.0, 0.0};
  EXPECT_TRUE(states_angles(by_code));
  expect_round_trip(by_code);
}

TEST(Release, BySpeedIsTheFirstTimeThatTheRampFunctionReachesIt) {
  EXPECT_DOUBLE_EQ(release_time(ramp, {"release.speed=2.2"}), 500.0 * 2.2 / 2.4);
  EXPECT_EQ(release_time(ramp, {"release.speed=2.4"}), 500.0);
  EXPECT_EQ(release_time(ramp, {"release.speed=0"}), 0.0);
  EXPECT_DOUBLE_EQ(release_time(trapezoid, {"release.speed=2.5"}), 50.0 * 2.5 / 3.0);  // not again on the way down
  EXPECT_DOUBLE_EQ(release_time(points, {"release.speed=0.75"}), 39.0);                // 0.25/2.5 of 10 before the end
  EXPECT_DOUBLE_EQ(release_time(ramp, {"speed.initial=3.4", "release.speed=2.9"}), 250.0);
  EXPECT_EQ(release_time(constant_speed, {"release.speed=2.4"}), 0.0);
}

TEST(Release, ByTimeMayComeBeforeDuringOrAfterTheSpinUp) {
  for (const double time : {0.0, 0.125, 499.0, 500.0, 1e6})
    EXPECT_EQ(release_time(ramp, {fmt::format("release.time={}", time)}), time);
}

TEST(Release, AtTimeZeroLetsTheBallsStartWithARate) {
  const Study study = parse(ramp, {"release.time=0", "initial.phi_dot=[0.5, -0.5]"});
  EXPECT_EQ(study.initial.phi_dot[0], 0.5);
  EXPECT_EQ(study.initial.phi_dot[1], -0.5);
}

TEST(SpeedLaw, IsKinematicUnlessPublishedIsNamed) {
  EXPECT_EQ(parse(ramp).speed_profile().law, model::SpeedLaw::kinematic);
  EXPECT_EQ(parse(ramp, {"speed.law=kinematic"}).speed_profile().law, model::SpeedLaw::kinematic);
  EXPECT_EQ(parse(ramp, {"speed.law=published"}).speed_profile().law, model::SpeedLaw::published);
}

TEST(SpeedLaw, DoesNotMoveTheRelease) {
  EXPECT_EQ(release_time(ramp, {"release.speed=2.2"}),
            release_time(ramp, {"release.speed=2.2", "speed.law=published"}));
}

TEST(Profiles, ReachTheModelAsTheirCorners) {
  using Numbers = std::vector<double>;
  EXPECT_EQ(parse(constant_speed).speed_profile().speeds, Numbers{2.4});
  EXPECT_EQ(parse(ramp).speed_profile().times, (Numbers{0.0, 500.0}));
  EXPECT_EQ(parse(ramp).speed_profile().speeds, (Numbers{0.0, 2.4}));
  EXPECT_EQ(parse(trapezoid).speed_profile().times, (Numbers{0.0, 50.0, 400.0, 500.0}));
  EXPECT_EQ(parse(trapezoid).speed_profile().speeds, (Numbers{0.0, 3.0, 3.0, 2.0}));
  EXPECT_EQ(parse(points).speed_profile().times, (Numbers{0.0, 10.0, 30.0, 40.0}));
  EXPECT_EQ(parse(points, {"initial.psi=0.5"}).speed_profile().initial_angle, 0.5);
}

TEST(Overrides, ReplaceWhatTheFileSays) {
  EXPECT_EQ(parse(ramp, {"rotor.eccentricity=0.02"}).parameters.eccentricity, 0.02);
  EXPECT_EQ(parse(ramp, {"initial.phi=[1.0, 4.0]"}).initial.phi[1], 4.0);
  EXPECT_EQ(parse(ramp, {"rotor={eccentricity=0.03, damping=[0.1, 0.2]}"}).parameters.damping[1], 0.2);
}

TEST(Overrides, MakeTablesThatTheFileLacks) {
  const Study study = parse(ramp, {"sampling.seed=7", "numerics.tolerance=1e-9"});
  EXPECT_EQ(study.sampling.seed, 7u);
  EXPECT_EQ(study.numerics.tolerance, 1e-9);
}

TEST(Overrides, TakeBareWordsAsStrings) {
  EXPECT_EQ(parse(ramp, {"speed.law=published"}).speed.law, model::SpeedLaw::published);
  EXPECT_EQ(parse(ramp, {"speed.law=\"published\""}).speed.law, model::SpeedLaw::published);
  EXPECT_EQ(parse(ramp, {"speed.law='published'"}).speed.law, model::SpeedLaw::published);
}

TEST(Overrides, TakeNumbersWithNothingBesideThePoint) {
  const Study whole = parse_study(constant_speed, "f.toml", {"balancer.drag=0.5", "speed.speed=3"});
  EXPECT_EQ(to_toml(parse_study(constant_speed, "f.toml", {"balancer.drag=.5", "speed.speed=3."})), to_toml(whole));
  EXPECT_THROW(parse_study(constant_speed, "f.toml", {"balancer.drag=.5x"}), InputError);
}

TEST(Overrides, ApplyInOrderSoThatTheLastOneHolds) {
  EXPECT_EQ(parse(ramp, {"sampling.seed=7", "sampling.seed=8"}).sampling.seed, 8u);
  EXPECT_EQ(parse(ramp, {"rotor.eccentricity=-1", "rotor.eccentricity=0.2"}).parameters.eccentricity, 0.2);
  EXPECT_EQ(parse(constant_speed, {"speed={profile=\"constant\"}", "speed.speed=2"}).speed.speed, 2.0);
}

TEST(Overrides, MayMendAFileThatCouldNotBeReadWithoutThem) {
  EXPECT_THROW(parse(rotor_and_balancer), InputError);
  EXPECT_EQ(parse(rotor_and_balancer, {"speed.profile=constant", "speed.speed=3"}).speed.speed, 3.0);
}

TEST(Overrides, TolerateBlanksAroundKeyAndValue) {
  EXPECT_EQ(parse(ramp, {" rotor.eccentricity = 0.02 "}).parameters.eccentricity, 0.02);
}

TEST(Echo, HoldsEveryKeyOfAStudyThatSetsThemAll) {
  const Study study =
      parse(points,
            {"rotor.damping=[0.1, 0.2]", "rotor.stiffness=[1.0, 1.1]", "rotor.gravity=0.01",
             "balancer={balls=3, mass=[0.1, 0.2, 0.3], drag=[0.0, 0.4, 0.5], rolls=true, ball_radius=[0.1, 0.2, 0.15]}",
             "speed.law=published", "release.time=0.0",
             "initial={psi=1, x=2, y=3, x_dot=4, y_dot=5, phi=[6, 7, 8], phi_dot=[9, 10, 11]}",
             "sampling={starts=12, seed=13, method=\"sobol\"}", "numerics={tolerance=1e-10, horizon=500}"});
  expect_round_trip(study);
  EXPECT_TRUE(study.parameters.rolls);
  EXPECT_EQ(study.parameters.ball_radius[2], 0.15);
  EXPECT_EQ(study.initial.phi_dot[2], 11.0);
  EXPECT_EQ(study.sampling.method, SamplingMethod::sobol);
  EXPECT_EQ(study.numerics.horizon, 500.0);
}

TEST(Balls, SlideUnlessADimensionlessStudySaysThatTheyRoll) {
  EXPECT_FALSE(parse(ramp).parameters.rolls);
  EXPECT_EQ(to_toml(parse(ramp)).find("rolls"), std::string::npos);
  EXPECT_EQ(to_toml(parse(ramp, {"balancer.rolls=false"})), to_toml(parse(ramp)));
  const model::Parameters p = parse(ramp, {"balancer.rolls=true"}).parameters;
  EXPECT_TRUE(p.rolls);
  EXPECT_EQ(p.ball_radius[0], 0.0);
  EXPECT_EQ(parse(ramp, {"balancer.rolls=true", "balancer.ball_radius=0.2"}).parameters.ball_radius[1], 0.2);
}

TEST(Echo, NamesTheMethodThatAnUnsetOneMeans) {
  EXPECT_FALSE(parse(ramp).sampling.method.has_value());
  EXPECT_NE(to_toml(parse(ramp)).find("method = \"random\""), std::string::npos);
  EXPECT_NE(to_toml(parse(ramp, {"sampling.method=grid"})).find("method = \"grid\""), std::string::npos);
}

TEST(Echo, KeepsLargestSeedAndCountOfStarts) {
  const Study study = parse(ramp, {"sampling.seed=9223372036854775807", "sampling.starts=1000000000000"});
  EXPECT_EQ(study.sampling.seed, 9223372036854775807u);
  EXPECT_EQ(study.sampling.starts, 1000000000000u);
  expect_round_trip(study);
}

TEST(Initial, IsAtRestUnderGravityUnlessItIsStated) {
  const std::vector<std::string> lying{"rotor.gravity=0.2", "speed.initial=0.5", "initial.psi=0.3", "release.time=0.0"};
  const Study study = parse(ramp, lying);
  const model::Parameters& p = study.parameters;
  const double sag = (1.0 + p.total_mass()) * 0.2 / p.stiffness[1];
  const InitialState& s = study.initial;
  // X = 0, Y = -sag, seen from a frame turned by 0.3; it moves backwards in that frame while the rotor turns at 0.5.
  EXPECT_NEAR(s.x * std::cos(0.3) - s.y * std::sin(0.3), 0.0, 1e-15);
  EXPECT_NEAR(s.x * std::sin(0.3) + s.y * std::cos(0.3), -sag, 1e-15);
  EXPECT_DOUBLE_EQ(s.x_dot, 0.5 * s.y);
  EXPECT_DOUBLE_EQ(s.y_dot, -0.5 * s.x);
  expect_round_trip(study);
  for (const char* stated : {"initial.x=0.0", "initial.y_dot=0.0", "sampling.box={x_dot=[0, 1]}"}) {
    std::vector<std::string> more = lying;
    more.push_back(stated);
    EXPECT_EQ(parse(ramp, more).initial.y, 0.0) << stated;
  }
  EXPECT_EQ(parse(ramp).initial.y, 0.0);
}

TEST(Echo, KeepsEveryBitOfEveryNumber) {
  std::mt19937_64 bits(1);
  for (int trial = 0; trial < 2000; ++trial) {
    Study study = parse(ramp);
    const auto any = [&] {
      for (;;) {
        const double v = std::bit_cast<double>(static_cast<std::uint64_t>(bits()));
        if (std::abs(v) <= 1e300) return v;  // finite and within the reader's range; subnormal numbers included
      }
    };
    study.parameters.eccentricity = std::abs(any());
    study.speed.initial = any();
    study.speed.final = any();
    study.initial.psi = any();
    study.initial.phi = {any(), any()};
    expect_round_trip(study);
    if (HasFailure()) return;
  }
}

}  // namespace study_test
}  // namespace equipoise
