// The study reader on bad input: every message names the place, the key, the value and what is allowed, on one line.
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../support/refusals.hpp"
#include "../support/snapshots.hpp"
#include "../support/studies.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/toml/overrides.hpp"

namespace equipoise {
namespace study_errors_test {

// The cases below depend on its line numbers.
const std::string good =
    ramp_speed + "[release]\nspeed = 2.2\n[initial]\nphi = [1.0, 4.0]\n[sampling]\nstarts = 1000\n";

std::string with(const std::string& from, const std::string& to) { return equipoise::with(good, from, to); }

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

TEST(BadInput, IsRefusedInTheWordsOfTheSnapshot) {
  const std::map<std::string, std::string> studies{
      {"ramp", good},
      {"rotor without profile", rotor_and_balancer + "[speed]\n"},
      {"constant", constant_speed},
      {"free balls", constant_speed + "[initial]\nx = 0.01\ny = -0.02\nphi_dot = 0.125\n"},
      {"machine", ramp_machine},
      {"unbalanced machine", equipoise::with(ramp_machine, "eccentricity = \"0.2 mm\"", "unbalance = \"200 g mm\"")}};
  for (const auto& [name, text] : studies)
    EXPECT_EQ(refusal([&] { parse_study(text, name); }).has_value(), name == "rotor without profile") << name;
  expect_said("study_refusals.txt", studies, [](const StudyCase& bad) {
    return std::string(refused([&] { parse_study(bad.text, "study.toml", bad.overrides); }).what());
  });
}

// Cases whose words or column are not the reader's own.
struct Bad {
  std::string text;
  std::vector<std::string> overrides;
  std::string where;  // all of it, or up to the line of a "file:line:column"
  std::string key, value;
  std::string problem;  // a part of it
};

void expect_rejected(const std::vector<Bad>& cases) {
  for (const Bad& bad : cases) {
    std::string trace = bad.text == good ? "" : bad.text.substr(0, 500);
    for (const auto& item : bad.overrides) trace += "\n--set " + item.substr(0, 200);
    SCOPED_TRACE(trace);
    const InputError error = refused([&] { parse_study(bad.text, "f.toml", bad.overrides); });
    EXPECT_EQ(bad.where.ends_with(':') ? error.where().substr(0, bad.where.size()) : error.where(), bad.where);
    EXPECT_EQ(error.key(), bad.key);
    EXPECT_EQ(error.value(), bad.value);
    EXPECT_NE(error.problem().find(bad.problem), std::string::npos) << error.problem();
  }
}

// The same for --set alone, with a good file.
void expect_override_rejected(const std::string& item, const std::string& where, const std::string& key,
                              const std::string& value, const std::string& problem) {
  expect_rejected({{good, {item}, where, key, value, problem}});
}

// The column and most of the wording come from the TOML library.
TEST(BadInput, WhatIsNotTomlIsNamedByLineAndColumn) {
  expect_rejected({
      {"this is not TOML\n", {}, "f.toml:1:", "", "", "not TOML: "},
      {with("damping = 0.5", "damping = 0.5\ndamping = 0.6"), {}, "f.toml:4:", "", "", "cannot redefine existing"},
      {good + "[rotor]\ngravity = 1\n", {}, "f.toml:18:", "", "", "cannot redefine existing table 'rotor'"},
      {with("0.01", "1e400"), {}, "f.toml:2:", "", "", "not TOML: "},
      {with("0.01", "99999999999999999999"), {}, "f.toml:2:", "", "", "not representable in 64 bits"},
      {with("1000", "1000\nseed = 9223372036854775808"), {}, "f.toml:18:", "", "", "not representable in 64 bits"},
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
  // Dots outside keys do not matter.
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
    expect_override_rejected(item, fmt::format("{} {}", overrides_name, item), "", "", form);
}

TEST(BadInput, OverridesAreOneTomlValue) {
  expect_override_rejected("balancer.mass=[0.05", overrides_name, "balancer.mass", "[0.05", "not TOML: ");
  expect_override_rejected("speed.profile=\"ramp", overrides_name, "speed.profile", "\"ramp", "not TOML: ");
  expect_override_rejected("initial={psi=1", overrides_name, "initial", "{psi=1", "not TOML: ");
  expect_override_rejected("rotor.gravity=1\n[numerics]\nhorizon=1", overrides_name, "rotor.gravity",
                           "1\\u000A[numerics]\\u000Ahorizon=1", "must be a single TOML value");
}

TEST(BadInput, StudiesFilledInByCodeObeyTheSameRules) {
  const Study fine = parse_study(good, "f.toml");
  EXPECT_NO_THROW(check(fine));
  const auto expect_bad = [&](auto change, const std::string& key, const std::string& problem) {
    Study study = fine;
    change(study);
    const InputError error = refused([&] { check(study); });
    EXPECT_EQ(error.key(), key);
    EXPECT_NE(error.problem().find(problem), std::string::npos) << error.problem();
  };
  expect_bad([](Study& s) { s.release.time = 1.0; }, "release.time", "not both");
  expect_bad([](Study& s) { s.parameters.mass[1] = std::nan(""); }, "balancer.mass",
             "entry 2 must be a finite number greater than 0");
  expect_bad([](Study& s) { s.parameters.balls = 17; }, "balancer.balls", "from 0 to 16");
  expect_bad([](Study& s) { s.speed.duration = 0.0; }, "speed.duration", "greater than 0");
}

TEST(BadInput, FilesThatCannotBeReadAreNamedWithTheReason) {
  const std::string empty = testing::TempDir() + "equipoise-empty-study.toml";
  std::ofstream(empty).close();
  for (const auto& [path, problem] : std::vector<std::pair<std::string, std::string>>{
           {"no/such/study.toml", "cannot be read (no such file)"},
           {"", "cannot be read (no such file)"},
           {EQUIPOISE_SOURCE_DIR "/studies", "cannot be read (a directory)"},
           {empty, "missing"}}) {
    const InputError error = refused([&] { read_study(path); });
    EXPECT_EQ(error.where(), path);
    EXPECT_NE(error.problem().find(problem), std::string::npos) << error.problem();
    EXPECT_EQ(error.key(), path == empty ? "rotor.eccentricity" : "");
  }
  std::remove(empty.c_str());
}

}  // namespace study_errors_test
}  // namespace equipoise
