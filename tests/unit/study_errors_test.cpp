// The study reader on bad input: every message names the place, the key, the value and what is allowed, on one line.
#include <cctype>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/base/error.hpp"
#include "equipoise/study/overrides.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {
namespace {

// Cases below count on these line numbers.
const std::string good = R"([rotor]
eccentricity = 0.01
damping = 0.5
[balancer]
balls = 2
mass = 0.05
drag = 0.05
[speed]
profile = "ramp"
final = 2.4
duration = 500.0
[release]
speed = 2.2
[initial]
phi = [1.0, 4.0]
[sampling]
starts = 1000
)";

// `good` with its first `from` replaced by `to`.
std::string with(const std::string& from, const std::string& to) {
  std::string text = good;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string with_profile(const std::string& keys) {
  return with("profile = \"ramp\"\nfinal = 2.4\nduration = 500.0\n[release]\nspeed = 2.2\n", keys);
}

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

struct BadInput {
  std::string text;
  std::vector<std::string> overrides;
  std::string where;  // all of it, or up to the line of a "file:line:column"
  std::string key, value;
  std::string problem;  // a part of it
};

void expect_one_line(const InputError& error) {
  const std::string what = error.what();
  for (const char c : what) EXPECT_FALSE(std::iscntrl(static_cast<unsigned char>(c))) << what;
  EXPECT_EQ(what.find(error.where()), 0u) << what;
  EXPECT_NE(what.find(error.key()), std::string::npos) << what;
  EXPECT_NE(what.find(error.value()), std::string::npos) << what;
  EXPECT_FALSE(error.problem().empty());
  EXPECT_EQ(what.substr(what.size() - error.problem().size()), error.problem());  // nothing is cut off
}

void expect_rejected(const std::vector<BadInput>& cases) {
  for (const BadInput& bad : cases) {
    std::string trace = bad.text == good ? "" : bad.text.substr(0, 500);
    for (const auto& item : bad.overrides) trace += "\n--set " + item.substr(0, 200);
    SCOPED_TRACE(trace);
    try {
      parse_study(bad.text, "f.toml", bad.overrides);
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      const bool to_the_line = !bad.where.empty() && bad.where.back() == ':';
      EXPECT_EQ(to_the_line ? error.where().substr(0, bad.where.size()) : error.where(), bad.where);
      EXPECT_EQ(error.key(), bad.key);
      EXPECT_EQ(error.value(), bad.value);
      EXPECT_NE(error.problem().find(bad.problem), std::string::npos) << error.problem();
      expect_one_line(error);
    }
  }
}

// The same for --set alone, on a good file.
void expect_override_rejected(const std::string& item, const std::string& where, const std::string& key,
                              const std::string& value, const std::string& problem) {
  expect_rejected({{good, {item}, where, key, value, problem}});
}

TEST(BadInput, TheFileThatTheCasesChangeIsGood) { EXPECT_NO_THROW(parse_study(good, "f.toml")); }

TEST(BadInput, SamplingMethodsAreThree) {
  const std::string wanted = "must be one of: random, sobol, grid";
  expect_rejected({{good + "method = \"lattice\"\n", {}, "f.toml:18", "sampling.method", "\"lattice\"", wanted},
                   {good + "method = 2\n", {}, "f.toml:18", "sampling.method", "2", wanted}});
  const std::vector<std::string> lone{"sampling.method=grid", "sampling.starts=1"};
  expect_rejected({{good, lone, overrides_name, "sampling.starts", "1", "must be 2 or more"}});
}

TEST(BadInput, BallsRollOrSlide) {
  expect_override_rejected("balancer.rolls=1", overrides_name, "balancer.rolls", "1",
                           "is a number; must be true or false");
  expect_override_rejected("balancer.ball_radius=0.1", overrides_name, "balancer.ball_radius", "0.1",
                           "has a meaning only with balancer.rolls = true");
  expect_rejected({{good,
                    {"balancer.rolls=true", "balancer.ball_radius=1.0"},
                    overrides_name,
                    "balancer.ball_radius",
                    "1.0",
                    "must be a number at least 0 and less than 1"},
                   {good,
                    {"balancer.rolls=true", "balancer.ball_radius=[0.1, 0.1, 0.1]"},
                    overrides_name,
                    "balancer.ball_radius",
                    "[0.1, 0.1, 0.1]",
                    "has 3 entries"}});
}

TEST(BadInput, UnknownKeysAndTablesAreNamedWithTheNearestKnownOne) {
  expect_rejected({
      {with("damping = 0.5", "damping = 0.5\nstifness = 1.0"),
       {},
       "f.toml:4",
       "rotor.stifness",
       "1.0",
       "unknown key; did you mean \"stiffness\"? (allowed: eccentricity, damping, stiffness, gravity, inertia)"},
      {good + "horizon = 1\n",
       {},
       "f.toml:18",
       "sampling.horizon",
       "1",
       "unknown key (allowed: box, method, starts, seed); [numerics] has a key of this name"},
      {good + "[numeric]\nhorizon = 1\n", {}, "f.toml:18", "numeric", "{ horizon = 1 }", "did you mean \"numerics\"?"},
      {"colour = \"red\"\n" + good, {}, "f.toml:1", "colour", "\"red\"", "unknown key (allowed: rotor, balancer,"},
      {"rotor.gravity.x = 1\n", {}, "f.toml", "rotor.eccentricity", "", "missing"},
      {with("final = 2.4", "final = 2.4\nspeed = 2.4"), {}, "f.toml:11", "speed.speed", "2.4", "unknown key"},
      {with("eccentricity", "\"rotor.eccentricity\""),
       {},
       "f.toml:2",
       "rotor.rotor.eccentricity",
       "0.01",
       "unknown key; did you mean \"eccentricity\"?"},
  });
}

// What was meant by it is missing then; the misspelling is what there is to mend.
TEST(BadInput, UnknownKeysAreReportedBeforeWhatIsMissing) {
  expect_rejected({
      {with("balls = 2", "ball_count = 2"), {}, "f.toml:5", "balancer.ball_count", "2", "did you mean \"balls\"?"},
      {with("eccentricity", "eccentricty"), {}, "f.toml:2", "rotor.eccentricty", "0.01", "mean \"eccentricity\"?"},
      {with("damping", "support_damping"), {}, "f.toml:3", "rotor.support_damping", "0.5", "mean \"damping\"?"},
      {with("drag = 0.05", "ball_drag = 0.05"), {}, "f.toml:7", "balancer.ball_drag", "0.05", "mean \"drag\"?"},
      {with("final = 2.4", "final_speed = 2.4"), {}, "f.toml:10", "speed.final_speed", "2.4", "mean \"final\"?"},
      {with("damping = 0.5", "balls = 2"), {}, "f.toml:3", "rotor.balls", "2", "; [balancer] has a key of this name"},
      {with("damping = 0.5", "sprokets = 2"),
       {},
       "f.toml:3",
       "rotor.sprokets",
       "2",
       "unknown key (allowed: eccentricity, damping, stiffness, gravity, inertia)"},
      {good, {"balancer.ball_count=3"}, overrides_name, "balancer.ball_count", "3", "did you mean \"balls\"?"},
      // What another profile takes is left behind by whoever changes it: no misspelling.
      {good, {"speed.profile=constant"}, "f.toml", "speed.speed", "", "missing"},
  });
}

TEST(BadInput, MissingKeysAreNamedWithWhatTheyMustBe) {
  expect_rejected({
      {"", {}, "f.toml", "rotor.eccentricity", "", "missing; must be a finite number at least 0"},
      {" \n\n", {}, "f.toml", "rotor.eccentricity", "", "missing"},
      {with("balls = 2\n", ""), {}, "f.toml", "balancer.balls", "", "missing; must be a whole number from 1 to 8"},
      {with("drag = 0.05\n", ""), {}, "f.toml", "balancer.drag", "", "or an array of 2, one a ball"},
      {with("profile = \"ramp\"\n", ""),
       {},
       "f.toml",
       "speed.profile",
       "",
       "missing; must be one of: constant, ramp, trapezoid, points"},
      {with("duration = 500.0\n", ""), {}, "f.toml", "speed.duration", "", "missing"},
      {with_profile("profile = \"constant\"\nspeeds = 2\n"), {}, "f.toml", "speed.speed", "", "is \"speeds\" meant"},
      {with_profile("profile = \"points\"\ntimes = [0]\n"), {}, "f.toml", "speed.speeds", "", "an array of numbers"},
  });
}

TEST(BadInput, WrongTypesAreCalledByName) {
  const std::string not_negative = "must be a finite number at least 0";
  expect_rejected({
      {with("0.01", "\"0.01\""), {}, "f.toml:2", "rotor.eccentricity", "\"0.01\"", "is a string; " + not_negative},
      {with("0.01", "{ of = [1, 2] }"), {}, "f.toml:2", "rotor.eccentricity", "{ of = [1, 2] }", "is a table; "},
      {with("0.01", "[0.01]"), {}, "f.toml:2", "rotor.eccentricity", "[0.01]", "is an array; " + not_negative},
      {with("0.01", "true"), {}, "f.toml:2", "rotor.eccentricity", "true", "is a boolean; " + not_negative},
      {with("0.01", "2020-01-01"), {}, "f.toml:2", "rotor.eccentricity", "2020-01-01", "is a date or time; "},
      {with("\"ramp\"", "3"),
       {},
       "f.toml:9",
       "speed.profile",
       "3",
       "must be one of: constant, ramp, trapezoid, points"},
      {with("\"ramp\"", "[\"ramp\"]"), {}, "f.toml:9", "speed.profile", "[\"ramp\"]", "must be one of"},
      {with("balls = 2", "balls = \"2\""), {}, "f.toml:5", "balancer.balls", "\"2\"", "is a string; must be a whole"},
      {with("[1.0, 4.0]", "[1.0, \"4.0\"]"), {}, "f.toml:15", "initial.phi", "\"4.0\"", "entry 2 is a string"},
      {with("[1.0, 4.0]", "[[1.0, 4.0]]"), {}, "f.toml:15", "initial.phi", "[1.0, 4.0]", "entry 1 is an array"},
      {"rotor = 3\n", {}, "f.toml:1", "rotor", "3", "must be a table, [rotor]"},
      {with("[rotor]", "[[rotor]]"),
       {},
       "f.toml:1",
       "rotor",
       "[{ damping = 0.5, eccentricity = 0.01 }]",
       "must be a table, [rotor]"},
      {with("0.01", "0.01\nx.y.z = 1"), {}, "f.toml:3", "rotor.x", "{ y = { z = 1 } }", "unknown key"},
  });
}

TEST(BadInput, NumbersOutOfRangeAreShownWithTheRange) {
  expect_rejected({
      {with("0.01", "nan"), {}, "f.toml:2", "rotor.eccentricity", "nan", "must be a finite number at least 0"},
      {with("0.01", "inf"), {}, "f.toml:2", "rotor.eccentricity", "inf", "must be a finite number at least 0"},
      {with("2.4", "-inf"), {}, "f.toml:10", "speed.final", "-inf", "must be a finite number"},
      {with("0.01", "1e301"), {}, "f.toml:2", "rotor.eccentricity", "1e+301", "at most 1e+300 in size"},
      {with("0.5", "-0.5"), {}, "f.toml:3", "rotor.damping", "-0.5", "must be a finite number at least 0"},
      {with("0.5", "0.5\nstiffness = 0"), {}, "f.toml:4", "rotor.stiffness", "0", "greater than 0"},
      {with("mass = 0.05", "mass = -0.05"),
       {},
       "f.toml:6",
       "balancer.mass",
       "-0.05",
       "must be a finite number greater than 0"},
      {with("mass = 0.05", "mass = [0.05, -0.0]"), {}, "f.toml:6", "balancer.mass", "-0.0", "entry 2 must be"},
      {with("500.0", "0"), {}, "f.toml:11", "speed.duration", "0", "must be a finite number greater than 0"},
      {with("[1.0, 4.0]", "[1.0, nan]"), {}, "f.toml:15", "initial.phi", "nan", "entry 2 must be a finite number"},
      {good + "[numerics]\ntolerance = 0.1\n",
       {},
       "f.toml:19",
       "numerics.tolerance",
       "0.1",
       "must be a number at least 1e-14 and at most 0.01"},
  });
}

TEST(BadInput, WholeNumbersAreWholeAndInRange) {
  const std::string eight = "must be a whole number from 1 to 8";
  expect_rejected({
      {with("balls = 2", "balls = 0"), {}, "f.toml:5", "balancer.balls", "0", eight},
      {with("balls = 2", "balls = 9"), {}, "f.toml:5", "balancer.balls", "9", eight},
      {with("balls = 2", "balls = -9223372036854775808"),
       {},
       "f.toml:5",
       "balancer.balls",
       "-9223372036854775808",
       eight},
      {with("balls = 2", "balls = 4294967298"), {}, "f.toml:5", "balancer.balls", "4294967298", eight},  // 2 in 32 bits
      {with("balls = 2", "balls = 2.5"), {}, "f.toml:5", "balancer.balls", "2.5", eight},
      {with("balls = 2", "balls = 2.0"), {}, "f.toml:5", "balancer.balls", "2.0", "without point or exponent"},
      {with("1000", "1e5"), {}, "f.toml:17", "sampling.starts", "100000.0", "without point or exponent"},
      {with("1000", "0"), {}, "f.toml:17", "sampling.starts", "0", "from 1 to 1000000000000"},
      {with("1000", "1000\nseed = -1"), {}, "f.toml:18", "sampling.seed", "-1", "from 0 to 9223372036854775807"},
      {with("1000", "1000\nseed = 9223372036854775808"), {}, "f.toml:18:", "", "", "not representable in 64 bits"},
  });
}

TEST(BadInput, ArraysHaveOneEntryABallOrDirection) {
  expect_rejected({
      {with("mass = 0.05", "mass = [0.05]"),
       {},
       "f.toml:6",
       "balancer.mass",
       "[0.05]",
       "has 1 entries; must be a finite number greater than 0, or an array of 2, one a ball"},
      {with("0.5", "[0.5, 0.5, 0.5]"), {}, "f.toml:3", "rotor.damping", "[0.5, 0.5, 0.5]", "one a direction (x, y)"},
      {with("mass = 0.05", "mass = []"), {}, "f.toml:6", "balancer.mass", "[]", "must be an array, each entry"},
      {good, {"balancer.balls=3"}, "f.toml:15", "initial.phi", "[1.0, 4.0]", "has 2 entries"},
      {with("[1.0, 4.0]", "{ a = 1.0 }"), {}, "f.toml:15", "initial.phi", "{ a = 1.0 }", "is a table"},
  });
}

TEST(BadInput, ProfilesRunForwardInTimeFromZero) {
  const auto points = [](const std::string& times, const std::string& speeds) {
    return with_profile("profile = \"points\"\ntimes = " + times + "\nspeeds = " + speeds + "\n");
  };
  const auto trapezoid = [](const std::string& rise, const std::string& hold, const std::string& fall) {
    return with_profile("profile = \"trapezoid\"\npeak = 3.0\nfinal = 2.0\nrise_until = " + rise +
                        "\nhold_until = " + hold + "\nfall_until = " + fall + "\n");
  };
  expect_rejected({
      {points("[0, 2, 1]", "[0, 1, 2]"),
       {},
       "f.toml:10",
       "speed.times",
       "[0, 2, 1]",
       "times out of order: entry 3 must be greater than 2"},
      {points("[0, 1, 1]", "[0, 1, 2]"), {}, "f.toml:10", "speed.times", "[0, 1, 1]", "entry 3 must be greater than 1"},
      {points("[1, 2]", "[0, 1]"), {}, "f.toml:10", "speed.times", "[1, 2]", "the first time must be 0"},
      {points("[-1, 2]", "[0, 1]"), {}, "f.toml:10", "speed.times", "-1", "entry 1 must be a finite number at least 0"},
      {points("[0, 1]", "[0, 1, 2]"), {}, "f.toml:11", "speed.speeds", "[0, 1, 2]", "must have one a time, 2"},
      {points("0", "[0]"), {}, "f.toml:10", "speed.times", "0", "must be an array"},
      {points("[]", "[]"), {}, "f.toml:10", "speed.times", "[]", "must be an array"},
      {trapezoid("50.0", "40.0", "60.0"), {}, "f.toml:13", "speed.hold_until", "40.0", "greater than rise_until, 50"},
      {trapezoid("50.0", "50.0", "60.0"), {}, "f.toml:13", "speed.hold_until", "50.0", "greater than rise_until, 50"},
      {trapezoid("50.0", "60.0", "60.0"), {}, "f.toml:14", "speed.fall_until", "60.0", "greater than hold_until, 60"},
      {trapezoid("0", "1", "2"), {}, "f.toml:12", "speed.rise_until", "0", "greater than 0"},
  });
}

TEST(BadInput, ReleaseIsOneThingThatHappens) {
  expect_rejected({
      {with("speed = 2.2", "speed = 2.2\ntime = 1.0"),
       {},
       "f.toml:14",
       "release.time",
       "1.0",
       "give either release.speed or release.time, not both"},
      {with("speed = 2.2", "speed = 2.5"),
       {},
       "f.toml:13",
       "release.speed",
       "2.5",
       "the ramp function never reaches it; must be from 0 to 2.4"},
      {good, {"speed.final=2.0"}, "f.toml:13", "release.speed", "2.2", "must be from 0 to 2"},
      {with("speed = 2.2", "time = -1"), {}, "f.toml:13", "release.time", "-1", "must be a finite number at least 0"},
      {with_profile("profile = \"constant\"\nspeed = 2.4\n[release]\nspeed = 2.2\n"),
       {},
       "f.toml:12",
       "release.speed",
       "2.2",
       "must be from 2.4 to 2.4"},
      {with("[1.0, 4.0]", "0\nphi_dot = [0.0, 1.0]"),
       {},
       "f.toml:16",
       "initial.phi_dot",
       "[0.0, 1.0]",
       "must be 0: the balls are clamped until their release"},
  });
}

// The column and most of the wording are the TOML library's.
TEST(BadInput, WhatIsNotTomlIsNamedByLineAndColumn) {
  expect_rejected({
      {"this is not TOML\n", {}, "f.toml:1:", "", "", "not TOML: "},
      {with("damping = 0.5", "damping = 0.5\ndamping = 0.6"), {}, "f.toml:4:", "", "", "cannot redefine existing"},
      {good + "[rotor]\ngravity = 1\n", {}, "f.toml:18:", "", "", "cannot redefine existing table 'rotor'"},
      {with("0.01", "1e400"), {}, "f.toml:2:", "", "", "not TOML: "},
      {with("0.01", "99999999999999999999"), {}, "f.toml:2:", "", "", "not representable in 64 bits"},
      {with("\"ramp\"", "\"ramp"), {}, "f.toml:9:", "", "", "not TOML: "},
      {std::string("rotor\0 = 1\n", 11), {}, "f.toml:1:", "", "", "saw '\\u0000'"},
      {good + "# \xff\xfe\n", {}, "f.toml:18:", "", "", "invalid utf-8"},
  });
}

// toml++ 3.3 has undefined behaviour or, in some builds, a failed assertion for these.
TEST(BadInput, WhatTheTomlLibraryWouldStumbleOverIsStoppedBefore) {
  expect_rejected({
      {with("0.5", "0.5 \u00e9"), {}, "f.toml:3:15", "", "", "a character that is not ASCII, outside of comments"},
      {"\u03bb = 1\n", {}, "f.toml:1:1", "", "", "a character that is not ASCII, outside of comments"},
      {good + "x = \"\"\"\\\n\u00a7\"\"\"\n", {}, "f.toml:19:1", "", "", "outside of comments"},
      {good + "[ = ]\n", {}, "f.toml:18:", "", "", "not TOML: "},
      {good + "[[[a]]]\n", {}, "f.toml:18:", "", "", "not TOML: "},
      {good + "x = [1, } 2]\n", {}, "f.toml:18:", "", "", "not TOML: "},
      {with("500.0", "5\"\u00e9\""), {}, "f.toml:11:14", "", "", "not ASCII"},
      {with("500.0", "5'=\"\u00e9\"'"), {}, "f.toml:11:", "", "", "not ASCII"},
      {with("500.0", "\"\\\u00e9\""), {}, "f.toml:11:", "", "", "not ASCII"},
      {with("500.0", "\"\u00e9\""), {}, "f.toml:11", "speed.duration", "\"\u00e9\"", "number"},
      {good + "x = \"\"\"\\", {}, "f.toml:18:", "", "", "not TOML: "},
      {good + "[[\n", {}, "f.toml:18:", "", "", "not TOML: "},
      {good, {"rotor.eccentricity=\u03bb"}, overrides_name, "rotor.eccentricity", "\"\u03bb\"", "is a string"},
      {good, {"rotor.eccentricity=[\u03bb]"}, overrides_name, "rotor.eccentricity", "[\u03bb]", "not ASCII"},
  });
}

TEST(BadInput, StrangeTextStaysOnOneLineAndIsCutToLength) {
  const std::string sixty(60, 'x');
  expect_rejected({
      {with("0.01", "n"), {}, "f.toml:2:", "", "", "saw 'n\\u000A"},
      {"\"\\u0000\" = 1\n" + good, {}, "f.toml:1", "\\u0000", "1", "unknown key"},
      {"\"two\\nlines\\u001b[31m\" = 1\n" + good, {}, "f.toml:1", "two\\u000Alines\\u001B[31m", "1", "unknown key"},
      {"\"" + std::string(100000, 'x') + "\" = 1\n" + good, {}, "f.toml:1", sixty + "...", "1", "unknown key"},
      {with("\"ramp\"", "\"\"\"\ntwo\nlines\"\"\""), {}, "f.toml:9", "speed.profile", "\"two\\u000Alines\"", "one of"},
      {with("\"ramp\"", "\"" + std::string(100000, 'x') + "\""),
       {},
       "f.toml:9",
       "speed.profile",
       "\"" + std::string(59, 'x') + "...",
       "one of"},
      // Never cut within a character.
      {good,
       {"speed.profile=" + std::string(58, 'x') + "\u00e9\u00e9"},
       overrides_name,
       "speed.profile",
       "\"" + std::string(58, 'x') + "\u00e9...",
       "one of"},
  });
}

TEST(BadInput, NestingEndsInAMessageBeforeItEndsTheStack) {
  const std::string deep_key = repeated("a.", 1000000) + "a";
  const std::string shown_key = repeated("a.", 30) + "...";
  const std::string too_many = "a key has more than 16 parts";
  expect_rejected({
      {deep_key + " = 1\n" + good, {}, "f.toml:1:32", "", "", too_many},
      {good + "[" + deep_key + "]\n", {}, "f.toml:18:33", "", "", too_many},
      {good + "[\"#\".'=\\'." + deep_key + "]\n", {}, "f.toml:18:", "", "", too_many},
      {good + "[initial.x]\ny = {" + deep_key + " = 1}\n", {}, "f.toml:19:", "", "", too_many},
      {good + "x = \"\"\"\\\"\"\"\n\"#\"\"\"\n" + deep_key + " = 1\n", {}, "f.toml:20:", "", "", too_many},
      {"x = " + repeated("[", 100000) + "\n", {}, "f.toml:1:", "", "", "exceeded maximum nested value depth"},
      {good, {deep_key + "=1"}, overrides_name, shown_key, "1", "more parts than any key of a study has"},
      {good, {"rotor={" + deep_key + "=1}"}, overrides_name, "rotor", "{" + repeated("a.", 29) + "a...", too_many},
  });
}

TEST(GoodInput, MayLookStrangeWhereTomlAllowsIt) {
  // Dots that are no key's are no matter.
  EXPECT_NO_THROW(parse_study("# " + repeated("a.", 100) + "\n" + good + "# ...........................\n", "f.toml"));
  EXPECT_NO_THROW(parse_study(with("phi = [1.0, 4.0]", "phi = [1.0, 4.0] # " + repeated("'a.", 99)), "f.toml"));
  EXPECT_NO_THROW(parse_study("\xEF\xBB\xBF# \u03bb\n" + good, "f.toml"));
  EXPECT_NO_THROW(parse_study("# \u03bb\r\n \t[ rotor ]  # \u03bb" + good.substr(7), "f.toml"));
  EXPECT_NO_THROW(parse_study(with("[1.0, 4.0]", "[ # \u03bb\n  +1.0,\n\n  4.0, # [\n]"), "f.toml"));
}

TEST(BadInput, OverridesThatAreNotKeyAndValueAreQuotedWhole) {
  const std::string form = "must be key=value, for example rotor.eccentricity=0.02";
  for (const std::string item : {"", "=", "=3", "rotor", "rotor.eccentricity", "rotor.eccentricity=", ".x=3",
                                 "rotor.=3", "a..b=1", "rotor.eccentricity= "})
    expect_override_rejected(item, std::string(overrides_name) + " " + item, "", "", form);
}

TEST(BadInput, OverridesAreToldFromTheFile) {
  expect_override_rejected("rotor.eccentricity=-1", overrides_name, "rotor.eccentricity", "-1", "at least 0");
  expect_override_rejected("rotor.eccentricity=0.01 kg", overrides_name, "rotor.eccentricity", "\"0.01 kg\"",
                           "is a string");
  expect_override_rejected("rotr.eccentricity=1", overrides_name, "rotr", "{ eccentricity = 1 }",
                           "did you mean \"rotor\"?");
  expect_override_rejected("rotor.eccentricty=1", overrides_name, "rotor.eccentricty", "1",
                           "did you mean \"eccentricity\"?");
  expect_override_rejected("rotor={eccentricity=-1}", overrides_name, "rotor.eccentricity", "-1", "at least 0");
  expect_override_rejected("rotor={eccentricity=1}", overrides_name, "rotor.damping", "", "missing");
  expect_override_rejected("balancer.mass=[0.05]", overrides_name, "balancer.mass", "[0.05]", "has 1 entries");
  expect_override_rejected("release.speed=9", overrides_name, "release.speed", "9", "never reaches it");
  expect_override_rejected("sampling.seed=99999999999999999999", overrides_name, "sampling.seed",
                           "\"99999999999999999999\"", "is a string; must be a whole number");
  expect_override_rejected("release.time=1", overrides_name, "release.time", "1", "not both");
  expect_override_rejected("speed.profile=constant", "f.toml", "speed.speed", "", "missing");
}

TEST(BadInput, OverridesRespectWhatIsATable) {
  expect_override_rejected("speed=3", overrides_name, "speed", "3", "must be a table, [speed]");
  expect_override_rejected("rotor.eccentricity.x=1", overrides_name, "rotor.eccentricity.x", "1",
                           "\"rotor.eccentricity\" is not a table");
  expect_override_rejected("initial.phi.x=1", overrides_name, "initial.phi.x", "1", "\"initial.phi\" is not a table");
  expect_rejected(
      {{good, {"speed=3", "speed.final=2"}, overrides_name, "speed.final", "2", "\"speed\" is not a table"}});
}

TEST(BadInput, OverridesAreOneTomlValue) {
  expect_override_rejected("balancer.mass=[0.05", overrides_name, "balancer.mass", "[0.05", "not TOML: ");
  expect_override_rejected("speed.profile=\"ramp", overrides_name, "speed.profile", "\"ramp", "not TOML: ");
  expect_override_rejected("initial={psi=1", overrides_name, "initial", "{psi=1", "not TOML: ");
  expect_override_rejected("rotor.gravity=1\n[numerics]\nhorizon=1", overrides_name, "rotor.gravity",
                           "1\\u000A[numerics]\\u000Ahorizon=1", "must be a single TOML value");
}

TEST(BadInput, StudiesFilledInByCodeObeyTheSameRules) {
  const auto expect_bad = [](Study study, const std::string& key, const std::string& problem) {
    try {
      check(study);
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      EXPECT_EQ(error.key(), key);
      EXPECT_NE(error.problem().find(problem), std::string::npos) << error.problem();
      expect_one_line(error);
    }
  };
  const Study fine = parse_study(good, "f.toml");
  EXPECT_NO_THROW(check(fine));
  Study study = fine;
  study.release.time = 1.0;
  expect_bad(study, "release.time", "not both");
  study = fine;
  study.parameters.mass[1] = std::nan("");
  expect_bad(study, "balancer.mass", "entry 2 must be a finite number greater than 0");
  study = fine;
  study.parameters.balls = 9;
  expect_bad(study, "balancer.balls", "from 1 to 8");
  study = fine;
  study.speed.duration = 0.0;
  expect_bad(study, "speed.duration", "greater than 0");
}

TEST(BadInput, FilesThatCannotBeReadAreNamedWithTheReason) {
  const auto expect_unreadable = [](const std::string& path, const std::string& problem) {
    SCOPED_TRACE(path);
    try {
      read_study(path);
      ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
      EXPECT_EQ(error.where(), path);
      EXPECT_NE(error.problem().find(problem), std::string::npos) << error.problem();
      expect_one_line(error);
    }
  };
  expect_unreadable("no/such/study.toml", "cannot be read (no such file)");
  expect_unreadable("", "cannot be read (no such file)");
  expect_unreadable(EQUIPOISE_SOURCE_DIR "/studies", "cannot be read (a directory)");
}

TEST(BadInput, EmptyFileLacksItsFirstKey) {
  const std::string path = testing::TempDir() + "equipoise-empty-study.toml";
  std::ofstream(path).close();
  try {
    read_study(path);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.where(), path);
    EXPECT_EQ(error.key(), "rotor.eccentricity");
    EXPECT_NE(error.problem().find("missing"), std::string::npos);
  }
  std::remove(path.c_str());
}

}  // namespace
}  // namespace equipoise
