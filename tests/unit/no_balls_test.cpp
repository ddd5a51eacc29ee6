// A study without balls: what is told of it, and who refuses it.
#include <cmath>
#include <functional>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../support/studies.hpp"
#include "equipoise/analyses/one_study/attractors.hpp"
#include "equipoise/extras/proof/certify.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/report/explain/explain.hpp"
#include "equipoise/report/answers/answer.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/report/shown/machine_page.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"

namespace equipoise {
namespace no_balls_test {

const std::string bare = R"([rotor]
eccentricity = 0.01
damping = 0.5
[balancer]
balls = 0
[speed]
profile = "ramp"
final = 2.4
duration = 50.0
)";
const std::string bare_machine =
    with(with(machine_rotor, "balls = 2", "balls = 0"), "mass = \"60 g\"\ndrag = \"2e-4 N m s\"\n", "") +
    "[speed]\nprofile = \"ramp\"\nfinal = \"2000 rpm\"\nduration = \"5 s\"\n";

std::string error_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(NoBalls, NeedNeitherMassNorDrag) {
  for (const std::string& text : {bare, bare_machine}) {
    const Study study = parse_study(text, "s");
    EXPECT_EQ(study.parameters.balls, 0);
    EXPECT_EQ(study.parameters.total_mass(), 0.0);
    EXPECT_EQ(study.release_time(), 0.0);
    check(study);
    EXPECT_EQ(to_toml(parse_study(to_toml(study), "again")), to_toml(study));
    EXPECT_FALSE(holds(to_toml(study), "mass = []"));
  }
}

TEST(NoBalls, TheCheckSpeaksOfNone) {
  for (const std::string& text : {bare, bare_machine}) {
    const std::string said = check_study(text, "s").text();
    EXPECT_TRUE(holds(said, "\nBalls: none: nothing cancels the unbalance.\n")) << said;
    EXPECT_TRUE(holds(said, "\nMost sensitive to: not judged: there are no balls.\n")) << said;
    EXPECT_FALSE(holds(said, "its balls")) << said;
  }
  EXPECT_TRUE(holds(check_study(bare, "s", {"balancer.balls=2", "balancer.mass=0.1", "balancer.drag=0.1"}).text(),
                    "its balls"));
}

TEST(NoBalls, SimulateGivesTheRotor) {
  std::vector<double> times;
  for (int k = 0; k <= 2000; ++k) times.push_back(0.1 * k);
  const Trajectory one = simulate(parse_study(bare, "s"), times);
  EXPECT_TRUE(one.phi.empty());
  // By the textbook.
  EXPECT_NEAR(one.radial.back(), 0.01 * 5.76 / std::hypot(1.0 - 5.76, 1.2), 1e-9);
}

// Without unbalance the error had no scale, and no step was small enough.
TEST(NoBalls, FreeDecayAndRestNeedNoUnbalance) {
  const std::string balanced = with(bare, "eccentricity = 0.01", "eccentricity = 0.0");
  std::vector<double> times;
  for (int k = 0; k <= 200; ++k) times.push_back(0.1 * k);
  const std::string driven = with(balanced, "profile = \"ramp\"\nfinal = 2.4\nduration = 50.0\n",
                                  "profile = \"torque\"\ntorque = { stall = 0.5, no_load_speed = 2.4 }\n");
  for (const std::string& text : {balanced, with(driven, "damping = 0.5", "damping = 0.5\ninertia = 1.0")}) {
    const Trajectory rest = simulate(parse_study(text, "s"), times);
    ASSERT_EQ(rest.radial.size(), times.size()) << text;
    EXPECT_EQ(rest.radial.back(), 0.0) << text;
    const Trajectory decay = simulate(parse_study(text + "[initial]\nx = 0.1\n", "s"), times);
    ASSERT_EQ(decay.radial.size(), times.size()) << text;
    const double c = 0.5, w = std::sqrt(1.0 - c * c / 4.0), t = times.back();
    // The textbook's free vibration; the error allowed is 1e-12 a step.
    const double x = 0.1 * std::exp(-c * t / 2.0) * (std::cos(w * t) + c / (2.0 * w) * std::sin(w * t));
    EXPECT_NEAR(decay.radial.back(), std::fabs(x), 1e-11) << text;
  }
}

TEST(NoBalls, BasinTellsOfOneRun) {
  const BasinResult r = basin(parse_study(bare, "s"));
  ASSERT_TRUE(r.without_balls);
  EXPECT_TRUE(r.without_balls->bare.one);
  EXPECT_EQ(r.without_balls->held.runs, 0u);
  const std::string text = basin_text(r);
  EXPECT_TRUE(holds(text, "no balls; rotor: eccentricity 0.01"));
  EXPECT_TRUE(holds(text, "There are no balls: nothing is random, so one run is enough."));
  EXPECT_FALSE(holds(text, "balanced"));
  const auto json = nlohmann::json::parse(json_text(r));
  EXPECT_NEAR(json["without_balls"]["no_balls"]["figures"]["rms_velocity"]["value"].get<double>(),
              2.4 * 0.01 * 5.76 / std::hypot(1.0 - 5.76, 1.2), 1e-8);
  EXPECT_FALSE(json["without_balls"].contains("balls_held"));
  EXPECT_TRUE(holds(answer_sentence(r), "There are no balls: the rotor's peak displacement is "));
}

TEST(NoBalls, UncertainValuesAreDrawn) {
  const std::string text =
      with(bare, "eccentricity = 0.01", "eccentricity = { uniform = [0.005, 0.015] }") + "[sampling]\nstarts = 50\n";
  const BasinResult r = basin(parse_study(text, "s"));
  EXPECT_EQ(r.without_balls->bare.runs, 50u);
  EXPECT_FALSE(r.without_balls->bare.one);
  EXPECT_TRUE(holds(basin_text(r), "There are no balls: 50 runs draw the uncertain values."));
}

TEST(NoBalls, ARunIsThatOfTheBareRotorOfTheSameStudyWithBalls) {
  BasinOptions options;
  options.transients = true;
  const std::string balls =
      with(bare, "balls = 0", "balls = 2\nmass = 0.05\ndrag = 0.05") + "[sampling]\nstarts = 10\n";
  const BasinResult with_balls = basin(parse_study(balls, "s"), options), without = basin(parse_study(bare, "s"));
  for (const auto figure : {&TransientRow::peak_radial, &TransientRow::peak_force, &TransientRow::rms_force})
    EXPECT_FLOAT_EQ(static_cast<float>(with_balls.without_balls->bare.figures.figure(figure).largest),
                    static_cast<float>(without.without_balls->bare.figures.figure(figure).largest));
}

TEST(NoBalls, ARotorThatCoastsComesToNoSteadyMotion) {
  const auto text_of = [](const std::string& torque) {
    const std::string driven =
        with(bare.substr(0, bare.find("[speed]")), "damping = 0.5", "damping = 0.2\ninertia = 0.5");
    return basin_text(basin(parse_study(driven + "[speed]\nprofile = \"torque\"\ntorque = { " + torque + " }\n", "s")));
  };
  const std::string words =
      "Without balls the rotor never settles into a steady motion: figures at the end are the last seen.";
  EXPECT_TRUE(holds(text_of("constant = 0.12, slope = -0.04, until = 30.0"), words));
  EXPECT_FALSE(holds(text_of("constant = 0.12, slope = -0.04"), words));
}

TEST(NoBalls, ExplainTellsOfTheRotor) {
  const std::string text = explain_text(explain(parse_study(bare_machine, "s")));
  EXPECT_TRUE(holds(text, "no: there are no balls"));
  EXPECT_TRUE(holds(text, "without balls"));  // its vibration
  EXPECT_FALSE(holds(text, "Rules of thumb"));
  EXPECT_FALSE(holds(text, "cancel"));
}

TEST(NoBalls, APageTellsOfTheRotor) {
  const std::string page =
      machine_html(machine_page(parse_study(bare_machine, "s"), given_machine(bare_machine, "s", {}), BasinOptions{}));
  EXPECT_TRUE(holds(page, "The rotor alone"));
  EXPECT_TRUE(holds(page, "nothing is random, so one run is enough"));
  for (const char* words : {"Where starts end", "balls can cancel", "rule of thumb"}) EXPECT_FALSE(holds(page, words));
  EXPECT_TRUE(holds(page, "How it vibrates during start-up"));
  EXPECT_TRUE(holds(page, "<li>viscous damping</li>"));
  EXPECT_FALSE(holds(page, "<li>balls"));
  EXPECT_FALSE(holds(page, "class=\"notice"));
}

TEST(NoBalls, EverybodyElseRefusesThem) {
  const Study study = parse_study(bare, "s");
  for (const auto& error : {error_of([&] { attractors(study); }), error_of([&] { replay_start(study, 0); })})
    EXPECT_TRUE(holds(error, "balancer.balls = 0: leaves nothing to balance with; must be 1 to 16 here")) << error;
  BasinOptions file;
  file.output = testing::TempDir() + "no_balls.nc";
  EXPECT_TRUE(holds(error_of([&] { basin(study, file); }), "leaves no starts for an output file"));
  BasinOptions narrow;
  narrow.half_width = 0.01;
  EXPECT_TRUE(holds(error_of([&] { basin(study, narrow); }), "leaves no starts for a half-width"));
}

TEST(NoBalls, MinusOneBallIsNone) {
  EXPECT_TRUE(holds(error_of([] { parse_study(with(bare, "balls = 0", "balls = -1"), "s"); }), "from 0 to 16"));
}

}  // namespace no_balls_test
}  // namespace equipoise
