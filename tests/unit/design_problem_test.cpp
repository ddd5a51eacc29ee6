// [design] read and refused; spin-ups within their limits; the ranking of candidates.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../support/refusals.hpp"
#include "../support/snapshots.hpp"
#include "../support/studies.hpp"
#include "equipoise/analyses/design/problem.hpp"
#include "equipoise/analyses/design/search.hpp"
#include "equipoise/analyses/design/settings.hpp"
#include "equipoise/analyses/design/standing.hpp"
#include "equipoise/core/base/random.hpp"
#include "equipoise/machine/drives/spin_up_shape.hpp"
#include "equipoise/report/answers/design_words.hpp"

namespace equipoise {
namespace design_problem_test {

const std::string plain_design = constant_speed + "[design]\nmethod = \"latin\"\nobjective = [\"balanced\"]\n";

const std::string machine = R"([rotor]
mass = "10 kg"
stiffness = "100 kN/m"
damping_ratio = 0.1
eccentricity = "0.1 mm"
[balancer]
balls = 2
race_radius = "50 mm"
mass = "20 g"
drag = "0.01 N m s"
[speed]
profile = "constant"
speed = "3000 rpm"
[design]
method = "latin"
objective = ["peak_radial.0.5"]
[design.vary]
"balancer.mass" = ["15 g", "30 g"]
[design.require]
"peak_radial.0.5" = { below = "200 um" }
ball_mass = { below = "50 g" }
)";

DesignProblem problem_of(const std::string& toml) { return DesignProblem(StudySource{toml, "study.toml", {}}); }

TEST(DesignProblem, IsRefusedInTheWordsOfTheSnapshot) {
  const std::string vary = plain_design + "[design.vary]\n", mass = vary + "\"balancer.mass\" = [0.01, 0.1]\n",
                    spin_up = "speed = { points = 2, until = 500.0, range = [0.0, 5.0], slope = 0.05 }\n",
                    energy = "[design.require]\n\"energy.0.9\" = { below = 1.0 }\n";
  for (const std::string& good : {mass, vary + spin_up, machine})
    EXPECT_EQ(refusal_text([&] { problem_of(good); }), "");
  EXPECT_EQ(refusal_text([&] { problem_of(mass + energy); }), "");  // at constant speed inertia has no effect
  const std::string drawn = with(vary, "= 0.01", "= { uniform = [0.005, 0.02] }");
  expect_said("design_refusals.txt",
              {{"design", plain_design},
               {"design.vary", vary},
               {"design.vary of drawn values", drawn},
               {"design of the mass", mass},
               {"design of a machine", machine}},
              [](const StudyCase& bad) { return std::string(refused([&] { problem_of(bad.text); }).what()); });
}

TEST(DesignProblem, EverySpinUpKeepsToItsLimits) {
  RandomStream draws(11);
  SpinUpShape shape;
  shape.points = 3;
  shape.until = 100.0;
  shape.low = 0.0;
  shape.high = 5.0;
  shape.slope = 0.05;  // too small for most requests: going from 0 to 5 takes all the time there is
  shape.final = 2.0;
  double latest = 0.0;
  for (int k = 0; k < 2000; ++k) {
    std::vector<double> at(coordinates(shape));
    for (double& x : at) x = k == 0 ? 0.0 : k == 1 ? 1.0 : draws.uniform();
    const SpinUpPoints points = spin_up_at(shape, at);
    ASSERT_EQ(points.times.size(), 5u);
    EXPECT_EQ(points.times.front(), 0.0);
    EXPECT_EQ(points.speeds.front(), 0.0);
    EXPECT_EQ(points.speeds.back(), 2.0);
    // Times are sums of five terms.
    EXPECT_LE(points.times.back(), shape.until * (1.0 + 1e-12));
    latest = std::max(latest, points.times.back());
    for (std::size_t p = 1; p < points.times.size(); ++p) {
      const double duration = points.times[p] - points.times[p - 1];
      EXPECT_GE(duration, shape.least_duration() * (1.0 - 1e-9));
      EXPECT_LE(std::fabs(points.speeds[p] - points.speeds[p - 1]), *shape.slope * duration * (1.0 + 1e-9));
      EXPECT_GE(points.speeds[p], shape.low);
      EXPECT_LE(points.speeds[p], shape.high);
    }
  }
  EXPECT_GT(latest, 0.999 * shape.until);  // all of the time can be used
}

TEST(DesignProblem, SpinUpTakesThePlaceOfTheSpeedAndOneReleaseThatOfTheOther) {
  const DesignProblem problem =
      problem_of(constant_speed +
                 "law = \"published\"\n[release]\nspeed = 2.4\n[design]\nmethod = \"latin\"\n"
                 "objective = [\"balanced\"]\n[design.vary]\n\"release.time\" = [0.0, 400.0]\n"
                 "speed = { points = 1, until = 500.0, range = [0.0, 5.0] }\n");
  const std::vector<double> at{0.25, 0.6, 0.5, 0.5};
  const Study study = problem.study_of(problem.settings_at(at), 10, 1);
  EXPECT_EQ(study.speed.profile, Profile::points);
  EXPECT_EQ(study.speed.speeds, (std::vector<double>{0.0, 3.0, 2.4}));
  EXPECT_EQ(study.speed.law, model::SpeedLaw::published);
  EXPECT_EQ(study.release_time(), 100.0);
  EXPECT_FALSE(study.release.speed);
}

TEST(DesignProblem, ChoicesWholeNumbersAndScalesAreReached) {
  const DesignProblem problem = problem_of(plain_design +
                                           "[design.vary]\n\"balancer.balls\" = [2, 4]\n"
                                           "\"balancer.drag\" = { range = [0.01, 1.0], scale = \"log\" }\n"
                                           "\"balancer.mass\" = { choices = [0.03, 0.05] }\n");
  const auto at = [&](std::vector<double> x) { return text_of(problem.settings_at(x)); };
  EXPECT_EQ(at({0.0, 0.0, 0.0}), "balancer.balls = 2; balancer.drag = 0.01; balancer.mass = 0.03");
  EXPECT_EQ(at({0.5, 0.5, 0.6}), "balancer.balls = 3; balancer.drag = 0.1; balancer.mass = 0.05");
  EXPECT_EQ(at({1.0, 1.0, 1.0}), "balancer.balls = 4; balancer.drag = 1.0; balancer.mass = 0.05");
}

const std::string oiled = R"([rotor]
mass = "10 kg"
stiffness = "100 kN/m"
damping_ratio = 0.1
eccentricity = "0.1 mm"
[balancer]
balls = 3
race_radius = "50 mm"
ball_diameter = "10 mm"
ball_material = "steel"
oil = { grade = "ISO VG 32", at = "40 degC" }
[speed]
profile = "constant"
speed = "3000 rpm"
)";
const std::string oiled_design = oiled + "[design]\nmethod = \"latin\"\nobjective = [\"balanced\"]\n[design.vary]\n";

TEST(DesignProblem, OnlyAllowedValuesAreReached) {
  const DesignProblem problem = problem_of(oiled_design +
                                           "\"balancer.ball_diameter\" = { stock = [\"9 mm\", \"13 mm\"] }\n"
                                           "\"balancer.oil.grade\" = { stock = [\"ISO VG 10\", \"ISO VG 100\"] }\n"
                                           "\"release.time\" = { range = [\"0 s\", \"2 s\"], step = \"0.5 s\" }\n"
                                           "\"rotor.damping_ratio\" = { range = [0.095, 0.3], digits = 2 }\n");
  std::vector<std::vector<std::string>> choices;
  for (const DesignVariable& v : problem.variables()) {
    choices.emplace_back();
    for (const StudyValue& choice : v.choices) choices.back().push_back(text_of(choice));
  }
  // Variables are by key.
  std::map<std::string, std::vector<std::string>> of;
  for (std::size_t k = 0; k < choices.size(); ++k) of[problem.variables()[k].key] = choices[k];
  EXPECT_EQ(of["balancer.ball_diameter"],
            (std::vector<std::string>{"\"9.525 mm\"", "\"10 mm\"", "\"10.3187 mm\"", "\"11.1125 mm\"", "\"11.9062 mm\"",
                                      "\"12 mm\"", "\"12.7 mm\""}));
  EXPECT_EQ(of["balancer.oil.grade"],
            (std::vector<std::string>{"\"ISO VG 10\"", "\"ISO VG 15\"", "\"ISO VG 22\"", "\"ISO VG 32\"",
                                      "\"ISO VG 46\"", "\"ISO VG 68\"", "\"ISO VG 100\""}));
  EXPECT_EQ(of["release.time"], (std::vector<std::string>{"\"0 s\"", "\"0.5 s\"", "\"1 s\"", "\"1.5 s\"", "\"2 s\""}));
  EXPECT_EQ(of["rotor.damping_ratio"].front(), "0.095");
  EXPECT_EQ(of["rotor.damping_ratio"][5], "0.1");
  EXPECT_EQ(of["rotor.damping_ratio"][6], "0.11");
  EXPECT_EQ(of["rotor.damping_ratio"].back(), "0.3");
  RandomStream draws(3);
  for (int n = 0; n < 200; ++n) {
    std::vector<double> at(problem.dimensions());
    for (double& x : at) x = draws.uniform();
    for (const DesignSetting& s : problem.settings_at(at))
      EXPECT_NE(std::find(of[s.key].begin(), of[s.key].end(), text_of(s.value)), of[s.key].end()) << text_of(s.value);
  }
}

TEST(DesignProblem, WhatCannotBeAllowedIsRefused) {
  const auto said = [](const std::string& line) {
    return refusal_text([&] { problem_of(oiled_design + line + "\n"); });
  };
  for (const auto& [line, words] : std::map<std::string, std::string>{
           {"\"balancer.ball_diameter\" = { stock = [\"26 mm\", \"40 mm\"] }", "stock sizes"},
           {"\"balancer.ball_diameter\" = { stock = [\"9 mm\"] }", "two ends"},
           {"\"balancer.oil.grade\" = { stock = [\"VG 10\", \"VG 33\"] }", "ISO 3448"},
           {"\"rotor.mass\" = { stock = [\"9 kg\", \"12 kg\"] }", "stock is only for"},
           {"\"release.time\" = { range = [\"0 s\", \"2 s\"], step = \"5 ms\" }", "unit of the range"},
           {"\"release.time\" = { range = [\"0 s\", \"2 s\"], step = \"0.00001 s\" }", "10000 values"},
           {"\"rotor.damping_ratio\" = { range = [0.1, 0.2], digits = 2, step = 0.1 }", "either step or digits"},
           {"\"rotor.damping_ratio\" = { range = [0.1, 0.2], digits = 9 }", "1, 2 or 3"},
           {"\"balancer.balls\" = { range = [2, 4], step = 1 }", "whole numbers"}})
    EXPECT_NE(said(line).find(words), std::string::npos) << line << ": " << said(line);
  const std::string known =
      with(oiled_design, "grade = \"ISO VG 32\",", "grade = \"ISO VG 32\", viscosity_100 = \"5 cSt\",");
  EXPECT_NE(refusal_text([&] {
              problem_of(known + "\"balancer.oil.grade\" = { stock = [\"ISO VG 10\", \"ISO VG 100\"] }\n");
            }).find("viscosity_100"),
            std::string::npos);
}

TEST(DesignProblem, StudyWithoutADesignGetsOneThatCanBePasted) {
  const DesignProblem plain = problem_of(oiled);
  EXPECT_EQ(plain.proposed(), "\n[design]\nobjective = [\"peak_radial.0.95\"]\nstarts = 100\ntrajectories = 40000\n" +
                                  std::string(optimisers_built_in() ? "" : "method = \"latin\"\n") +
                                  "\n[design.vary]\n\"balancer.balls\" = [2, 5]\n"
                                  "\"balancer.ball_diameter\" = { stock = [\"6.35 mm\", \"16 mm\"] }\n"
                                  "\"balancer.oil.grade\" = { stock = [\"ISO VG 10\", \"ISO VG 460\"] }\n"
                                  "\n[design.require]\nbalanced = { above = 0.95 }\n");
  EXPECT_EQ(problem_of(oiled + plain.proposed()).identity(), plain.identity());
  EXPECT_EQ(problem_of(oiled + plain.proposed()).proposed(), "");
  const std::string limited = oiled + "[release]\ntime = \"0.4 s\"\n[limits]\ndisplacement = \"1 mm\"\nshare = 0.99\n";
  const std::string proposed = problem_of(limited).proposed();
  for (const char* words : {"peak_radial.0.99", "starts = 400", "limits_kept = { above = 0.99 }", "\"release.time\""})
    EXPECT_NE(proposed.find(words), std::string::npos) << proposed;
  // Where larger numbers do not fit next to each other, they are left out.
  const std::string tight =
      with(with(oiled, "race_radius = \"50 mm\"", "race_radius = \"12 mm\""), "balls = 3", "balls = 6");
  EXPECT_NE(problem_of(tight).proposed().find("\"balancer.balls\" = [2, 7]"), std::string::npos)
      << problem_of(tight).proposed();
}

TEST(DesignProblem, LimitsKeptNeedLimits) {
  const std::string vary = "[design.vary]\n\"balancer.oil.grade\" = { stock = [\"ISO VG 10\", \"ISO VG 100\"] }\n";
  const auto refused_for = [&](const std::string& limits, const std::string& figure) {
    return refusal_text([&] {
      problem_of(oiled + limits + "[design]\nmethod = \"latin\"\nobjective = [\"" + figure + "\"]\n" + vary);
    });
  };
  EXPECT_NE(refused_for("", "limits_kept").find("needs [limits]"), std::string::npos);
  const std::string at_end = "[limits]\nvelocity = \"5 mm/s\"\n";
  EXPECT_EQ(refused_for(at_end, "limits_kept"), "");
  EXPECT_EQ(refused_for(at_end, "limits_kept_at_end"), "");
  EXPECT_NE(refused_for(at_end, "limits_kept_on_the_way").find("limits.displacement"), std::string::npos);
}

DesignResult chosen_of(const DesignProblem& problem, const std::vector<DesignSetting>& settings) {
  DesignResult r;
  r.study = problem.study();
  r.variables = problem.variables();
  for (const FigureSource& f : problem.figures()) r.figures.push_back(f.figure);
  r.objectives = problem.objectives();
  r.limits = problem.limits();
  r.front.push_back({settings, {}, DesignSample{100, {{1.0, 0.97, 1.0}}, {}, ""}});
  r.chosen = 0;
  r.feasible = true;
  return r;
}

TEST(DesignWords, SayThatNoOtherDesignWasTried) {
  DesignResult r =
      chosen_of(problem_of(oiled_design + "\"balancer.ball_diameter\" = { stock = [\"9 mm\", \"13 mm\"] }\n"),
                {{"balancer.ball_diameter", "10 mm"}});
  r.front[0].as_it_is = true;
  r.candidates = 1;
  r.partial = true;
  EXPECT_EQ(design_verdict(r).words,
            "PARTIAL: No other design was tried in the time. Allow more, or lower design.starts.");
  r.candidates = 2;
  EXPECT_EQ(design_verdict(r).words, "PARTIAL: Leave it as it is: nothing found is shown to be better.");
}

TEST(DesignWords, SayWhatToBuyAndWhetherItIsWorthIt) {
  const DesignProblem problem = problem_of(oiled_design +
                                           "\"balancer.ball_diameter\" = { stock = [\"9 mm\", \"13 mm\"] }\n"
                                           "\"balancer.oil.grade\" = { stock = [\"ISO VG 10\", \"ISO VG 100\"] }\n");
  DesignResult r = chosen_of(problem, {{"balancer.ball_diameter", "12 mm"}, {"balancer.oil.grade", "ISO VG 46"}});
  EXPECT_EQ(things_chosen(r.study, r.front[0].settings), "3 balls of 12 mm, ISO VG 46");
  EXPECT_EQ(things_chosen(r.study, {{"balancer.balls", 4}, {"release.speed", "840 rpm"}}),
            "4 balls of 10 mm, balls released at 840 rpm");
  r.before = DesignSample{100, {{0.5, 0.4, 0.6}}, {}, ""};
  EXPECT_EQ(design_verdict(r).words, "3 balls of 12 mm, ISO VG 46.");
  EXPECT_NE(design_verdict(r).because.find("as it is 50.0 % (40.0 to 60.0 %)"), std::string::npos)
      << design_verdict(r).because;
  EXPECT_NE(design_verdict(r).margins.find("not worked out"), std::string::npos);
  r.before = DesignSample{100, {{1.0, 0.97, 1.0}}, {}, ""};
  EXPECT_EQ(design_verdict(r).words,
            "Leave it as it is: nothing found is shown to be better. Best found: 3 balls of 12 mm, "
            "ISO VG 46.");
  r.front[0].as_it_is = true;
  EXPECT_EQ(design_verdict(r).words, "Leave it as it is: nothing found is shown to be better.");
  EXPECT_EQ(design_verdict(r).because.find("as it is"), std::string::npos);
  r.feasible = false;
  EXPECT_EQ(design_verdict(r).words, "Nothing tried is shown to keep all requirements; nearest: as it is.");
  r.front[0].as_it_is = false;
  EXPECT_EQ(design_verdict(r).words,
            "Nothing tried is shown to keep all requirements; nearest: 3 balls of 12 mm, ISO VG 46.");
  r.partial = true;
  EXPECT_EQ(design_verdict(r).words.substr(0, 9), "PARTIAL: ");
  DesignMargin m;
  m.key = "balancer.oil.grade";
  m.prefix = "ISO VG ";
  m.value = 46.0;
  m.keeps_from = 32.0;
  m.keeps_to = 100.0;
  m.fails_below = "balanced";
  r.margins.push_back(m);
  EXPECT_NE(design_verdict(r).margins.find("oil ISO VG 32 or more"), std::string::npos) << design_verdict(r).margins;
  r.margins[0].fails_above = "balanced";
  EXPECT_NE(design_verdict(r).margins.find("oil ISO VG 32 to ISO VG 100"), std::string::npos);
}

TEST(DesignProblem, LimitsInOtherUnitsAreThoseOfTheFigure) {
  const DesignProblem problem = problem_of(machine);
  EXPECT_EQ(problem.figures()[0].figure.unit, "mm");
  for (const DesignLimit& limit : problem.limits())
    EXPECT_NEAR(*limit.below, limit.figure == 0 ? 0.2 : 0.05, 1e-12);  // roundings of two conversions
}

// What the original study says of a wanted number, whatever its unit.
TEST(DesignProblem, WantedNumbersOfTheStudyAsItIsAreKnown) {
  const auto own = [](const std::string& of_balls) {
    const DesignProblem problem = problem_of(
        "[rotor]\nmass = \"10 kg\"\nstiffness = \"100 kN/m\"\ndamping_ratio = 0.1\n"
        "eccentricity = \"0.1 mm\"\n[balancer]\nballs = 2\nrace_radius = \"50 mm\"\n" +
        of_balls +
        "drag = \"0.01 N m s\"\n[speed]\nprofile = \"constant\"\nspeed = \"3000 rpm\"\n"
        "[design]\nmethod = \"latin\"\nobjective = [\"-balancer.mass\"]\n"
        "[design.vary]\n\"balancer.mass\" = [\"15 g\", \"30 g\"]\n");
    return problem.figures()[0].stated(problem.study(), {});
  };
  EXPECT_EQ(own("mass = \"20 g\"\n"), 20.0);
  EXPECT_NEAR(own("mass = \"0.02 kg\"\n"), 20.0, 1e-12);  // roundings of a conversion
  EXPECT_TRUE(std::isnan(own("mass = [\"20 g\", \"25 g\"]\n")));
}

DesignSample sample(double balanced, double peak, double arm = 0.0) {
  return {1000, {{balanced, balanced - arm, balanced + arm}, {peak, peak - arm, peak + arm}}, {}, ""};
}

TEST(DesignStanding, LimitsComeFirstThenEveryObjective) {
  const DesignProblem problem =
      problem_of(constant_speed +
                 "[design]\nmethod = \"latin\"\nobjective = [\"balanced\", \"peak_radial.0.5\"]\n"
                 "[design.vary]\n\"balancer.mass\" = [0.01, 0.1]\n"
                 "[design.require]\n\"balanced\" = { above = 0.5 }\n");
  const DesignStanding standing(problem);
  const auto beats = [&](const DesignSample& a, const DesignSample& b) {
    return standing.beats(a, Side::estimate, b, Side::estimate);
  };
  EXPECT_TRUE(beats(sample(0.9, 0.1), sample(0.9, 0.2)));
  EXPECT_FALSE(beats(sample(0.9, 0.2), sample(0.8, 0.1)));
  EXPECT_TRUE(beats(sample(0.6, 0.9), sample(0.4, 0.1)));  // the second misses a limit
  EXPECT_TRUE(beats(sample(0.4, 0.9), sample(0.3, 0.1)));  // the first comes nearer
  EXPECT_EQ(standing.violation(sample(0.52, 0.1, 0.03), Side::estimate), 0.0);
  EXPECT_NEAR(standing.violation(sample(0.52, 0.1, 0.03), Side::worst), 0.02, 1e-12);
  const std::vector<DesignSample> all{sample(0.9, 0.3), sample(0.8, 0.2), sample(0.7, 0.25), sample(0.99, 0.9),
                                      sample(0.2, 0.0)};
  std::vector<const DesignSample*> samples;
  for (const DesignSample& s : all) samples.push_back(&s);
  EXPECT_EQ(standing.front(samples, Side::estimate), (std::vector<std::size_t>{3, 0, 1}));
  EXPECT_EQ(standing.middle({&all[3], &all[0], &all[1]}), 1u);
  EXPECT_LT(standing.worth(all[2])[0], standing.worth(all[4])[0]);
}

}  // namespace design_problem_test
}  // namespace equipoise
