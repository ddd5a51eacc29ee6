// [design] read and refused; spin-ups within their limits; the ranking of candidates.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "../support/refusals.hpp"
#include "../support/snapshots.hpp"
#include "../support/studies.hpp"
#include "equipoise/base/random.hpp"
#include "equipoise/design/problem.hpp"
#include "equipoise/design/settings.hpp"
#include "equipoise/design/standing.hpp"
#include "equipoise/drives/spin_up_shape.hpp"

namespace equipoise {
namespace {

const std::string plain_design = constant_speed + "[design]\nmethod = \"random\"\nobjective = [\"balanced\"]\n";

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
method = "random"
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
              {{"constant", constant_speed},
               {"design", plain_design},
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
                 "law = \"published\"\n[release]\nspeed = 2.4\n[design]\nmethod = \"random\"\n"
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
        "[design]\nmethod = \"random\"\nobjective = [\"-balancer.mass\"]\n"
        "[design.vary]\n\"balancer.mass\" = [\"15 g\", \"30 g\"]\n");
    return problem.figures()[0].own;
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
                 "[design]\nmethod = \"random\"\nobjective = [\"balanced\", \"peak_radial.0.5\"]\n"
                 "[design.vary]\n\"balancer.mass\" = [0.01, 0.1]\n"
                 "[design.require]\n\"balanced\" = { above = 0.5 }\n");
  const DesignStanding standing(problem.figures(), problem.objectives(), problem.limits());
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

}  // namespace
}  // namespace equipoise
