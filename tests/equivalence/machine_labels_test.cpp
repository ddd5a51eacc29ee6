// Names of machines' outcomes, against the same starts followed ten times as long, mirror images, and the lanes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "../support/sizes.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/report/explain/explain.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "equipoise/classification/balanced_regions/balanced_analysis.hpp"
#include "machine_follow.hpp"

namespace machine_labels_test {

using equipoise::Outcome;
using equipoise::OutcomeKind;
using equipoise::parse_study;
using equipoise::Study;

std::string text(const std::string& rotor, const std::string& balancer, const std::string& speed) {
  return "[rotor]\neccentricity = 0.01\n" + rotor + "\n[balancer]\n" + balancer + "\n[speed]\n" + speed + "\n";
}
std::string motor(const std::string& law, const std::string& initial = "0.0") {
  return "profile = \"torque\"\ninitial = " + initial + "\ntorque = " + law;
}
std::string constant(double speed) { return fmt::format("profile = \"constant\"\nspeed = {}", speed); }

struct Named {
  Outcome outcome;
  std::string name;  // of the motion, without recurrence and joined balls
};

std::vector<Named> outcomes_of(Study study, std::size_t count) {
  study.sampling.starts = count;
  std::vector<Named> named;
  equipoise::BasinOptions options;
  options.outcome = [&](const Outcome& outcome) { named.push_back({outcome, ""}); };
  const auto listed = equipoise::basin(study, options).attractors;
  for (Named& one : named) {
    one.name = one.outcome.kind == OutcomeKind::attracted ? "?" : name_of(one.outcome.kind);
    for (const auto& a : listed)
      if (one.outcome.kind == OutcomeKind::attracted && a.id == one.outcome.attractor) one.name = a.name;
    one.name = one.name.substr(0, std::min(one.name.find(", "), one.name.find(" (")));
  }
  return named;
}

bool rests(const std::string& name) {
  return name == "balanced" || name == "locked" || name == "both captured" || name == "all captured";
}

// Decisions are judged by what the start does ten times later, not by the deciding rule.
struct Case {
  std::string name, toml;
  bool exact;         // balance is x = y = 0
  int undecided = 0;  // at most, of ten
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

std::vector<Case> cases() {
  const std::string two = "balls = 2\nmass = 0.05\ndrag = 0.05\n", three = "balls = 3\nmass = 0.03\ndrag = 0.05\n",
                    four = "balls = 4\nmass = 0.02\ndrag = 0.05\n", heavy = "damping = 0.5\ninertia = 0.5\n",
                    brief = motor("{ constant = 0.1, until = 20 }"), linear = motor("{ constant = 0.3, slope = -0.1 }");
  return {
      {"linear", text(heavy, two, linear), true},
      {"backwards", text(heavy, two, motor("{ constant = -0.3, slope = -0.1 }")), true},
      {"four_balls", text(heavy, four, linear), true},
      {"five_light_balls", text(heavy, "balls = 5\nmass = 0.01\ndrag = 0.1\n", linear), true},
      {"one_ball", text(heavy, "balls = 1\nmass = 0.01\ndrag = 0.05\n", linear), true},
      {"until", text(heavy, two, motor("{ constant = 0.1, until = 20 }")), true},
      {"until_under_gravity", text(heavy + "gravity = 0.01\n", two, brief), false},
      {"until_with_contact", text(heavy, four + "contact_angle = 0.5\n", brief), true},
      {"until_off_centre", text(heavy, two + "race_offset = [0.005, 0.002]\n", brief), false},
      {"until_unequal_supports", text(heavy + "stiffness = [1.0, 1.3]\n", three, brief), true},
      {"until_held_by_friction", text(heavy, two + "rolling = 1e-3\nstiction = 2e-3\n", brief), false, 2},
      {"contact_under_gravity",
       text("damping = 0.5\ngravity = 0.01\n", "balls = 6\nmass = 0.012\ndrag = 0.05\ncontact_angle = 0.3\n",
            constant(2.4)),
       false},
      {"contact_off_centre_on_unequal_supports",
       text("damping = 0.5\nstiffness = [1.0, 1.3]\n", four + "contact_angle = 0.3\nrace_offset = [0.003, 0.001]\n",
            constant(2.4)),
       false},
      {"contact_on_unequal_supports", text(heavy + "stiffness = [1.0, 1.3]\n", four + "contact_angle = 0.3\n", linear),
       false},
      {"table", text(heavy, two, motor("{ times = [0, 20, 30], values = [0.1, 0.1, 0.0] }")), true},
      {"control",
       text(heavy, two,
            motor("{ gain = 2.0, integral = 0.5, limit = 0.5, target = { profile = \"ramp\", initial = 1.0, "
                  "final = 2.5, duration = 10.0 } }")),
       true},
      {"anisotropic", text(heavy + "stiffness = [1.0, 1.3]\n", two, linear), true},
      {"gravity", text(heavy + "gravity = 0.01\n", two, linear), false},
      {"off_centre", text(heavy, two + "race_offset = [0.005, 0.002]\n", linear), false},
      {"contact", text(heavy, four + "contact_angle = 0.5\n", linear), true},
      {"contact_of_three", text("damping = 0.5\n", three + "contact_angle = 1.0\nrestitution = 0.2\n", constant(3.0)),
       true},
      // Drifts apart chaotically for thousands of time units on its way to pair drift; some until the horizon.
      {"contact_with_a_long_transient",
       "[rotor]\neccentricity = 0.0025\ndamping = 1.48\n[balancer]\nballs = 2\nmass = [0.00363, 0.00355]\n"
       "drag = [0.0166, 0.0159]\ncontact_angle = 0.205\nrestitution = 0.3\n[speed]\n" +
           constant(3.36) + "\n",
       true, 3},
      {"rolling", text(heavy, two + "rolling = 1e-3\n", linear), false},
      {"a_weak_motor",
       "[rotor]\neccentricity = 0.05\ndamping = 0.1\ninertia = 0.5\n[balancer]\n" + two + "[speed]\n" +
           motor("{ stall = 0.02, no_load_speed = 3.0 }") + "\n",
       true},
  };
}

class MachineLabels : public testing::TestWithParam<Case> {};

TEST_P(MachineLabels, HoldTenTimesLater) {
  const Case& c = GetParam();
  const Study study = parse_study(c.toml, c.name);
  const std::size_t starts = equipoise::sized(10, 3);
  const std::vector<Named> outcomes = outcomes_of(study, starts);
  int undecided = 0;
  for (std::size_t i = 0; i < starts; ++i) {
    const auto& [outcome, name] = outcomes[i];
    undecided += name == "undecided";
    if (name == "undecided") continue;
    // Or 60 000 later: three times as long as a motion that never repeats was watched.
    const double until = std::min(10.0 * std::max(300.0, outcome.time), outcome.time + 60000.0);
    const auto seen = machine_follow::follow(study, i, until);
    ASSERT_FALSE(seen.lost);
    const std::string then = machine_follow::kind_of(study, seen);
    EXPECT_EQ(rests(name) ? "rest" : name, then) << "start " << i;
    // A step's tolerance is 1e-6 of the unbalances, and less of it remains on the axis.
    if (name == "balanced" && c.exact) {
      EXPECT_LT(seen.last_r, 1e-6) << "start " << i;
    }
    if (name == "locked" && c.exact) {
      EXPECT_GT(seen.last_r, 1e-4) << "start " << i;
    }
    if (!study.speed.driven()) {
      EXPECT_TRUE(std::isnan(outcome.mean_speed));
    } else if (name == "stalled") {  // a coasting rotor keeps losing speed
      EXPECT_LT(std::fabs(outcome.mean_speed), study.stall_speed()) << "start " << i;
    } else {
      // Chaos changes a mean over hundreds of time units by about one per cent.
      EXPECT_NEAR(outcome.mean_speed, seen.speed, 0.02 * std::fabs(seen.speed)) << "start " << i;
    }
  }
  EXPECT_LE(undecided, c.undecided);
}

INSTANTIATE_TEST_SUITE_P(Case, MachineLabels, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });

// Four balls on a machine in kilograms: the last ball's drift dies slowly, and is no capture, whatever the motor.
TEST(SlowBalance, IsNotTakenForCapture) {
  for (const char* stall : {"1 N m", "2 N m", "4 N m"}) {
    const Study study = parse_study(
        fmt::format(
            "[rotor]\nmass = \"4 kg\"\nstiffness = \"10 kN/m\"\ndamping_ratio = 0.05\nunbalance = \"300 g mm\"\n"
            "inertia = \"0.02 kg m2\"\n[balancer]\nballs = 4\nrace_radius = \"60 mm\"\nball_diameter = \"8 mm\"\n"
            "ball_density = \"7800 kg/m3\"\ndrag = \"2e-5 N m s\"\n[speed]\nprofile = \"torque\"\n"
            "torque = {{ stall = \"{}\", no_load_speed = \"3000 rpm\" }}\n[numerics]\nhorizon = \"200 s\"\n",
            stall),
        "slow");
    for (const Named& start : outcomes_of(study, 40)) EXPECT_EQ(start.name, "balanced") << stall;
  }
}

// The mirror image of a motor that turns backwards, with every ball's angle mirrored, turns forwards: the balanced
// shares of one sample each differ only by chance.
TEST(Backwards, IsTheMirrorImage) {
  const auto count = [](const char* law) {
    const Study study = parse_study(
        text("damping = 0.5\ninertia = 0.5\n", "balls = 2\nmass = 0.05\ndrag = 0.05\n", motor(law)), "mirror");
    std::map<std::string, int> names;
    for (const Named& start : outcomes_of(study, 300)) ++names[start.name];
    return names;
  };
  auto forwards = count("{ constant = 0.3, slope = -0.1 }"), backwards = count("{ constant = -0.3, slope = -0.1 }");
  EXPECT_EQ(forwards["stalled"], backwards["stalled"]);
  // 300 starts each: five standard deviations of the difference of two shares of 0.6.
  EXPECT_NEAR(forwards["balanced"], backwards["balanced"], 5.0 * std::sqrt(2.0 * 300.0 * 0.6 * 0.4));
  EXPECT_GT(backwards["balanced"], 100);
}

// Balls held by friction are decided alike however long starts are followed: three balls next to a member of the
// continuum that hardly attracts.
TEST(DryFriction, IsJudgedAlikeAtEveryHorizon) {
  for (const char* horizon : {"9000", "50000"}) {
    const Study study = parse_study(
        std::string("[rotor]\neccentricity = 0.0042\ndamping = 0.391\n[balancer]\nballs = 3\nmass = 0.00234\n"
                    "drag = 0.0177\nrolling = 0.000814\nstiction = 0.001628\n[speed]\nprofile = \"constant\"\n"
                    "speed = 2.73\n[sampling]\nseed = 6\n[numerics]\nhorizon = ") +
            horizon + "\n",
        "stiction");
    EXPECT_EQ(outcomes_of(study, 56)[55].name, "balanced") << horizon;
  }
}

// A motor that does not reach the speed of release: the start is given up, and a note says so.
TEST(Release, ThatIsNeverReachedIsSaid) {
  const auto answer = [](const std::string& law, double release) {
    const Study study =
        parse_study(text("damping = 0.5\ninertia = 0.5\n", "balls = 2\nmass = 0.05\ndrag = 0.05\n", motor(law)) +
                        fmt::format("[release]\nspeed = {}\n[sampling]\nstarts = 20\n", release),
                    "release");
    double latest = 0.0;
    equipoise::BasinOptions options;
    options.outcome = [&](const Outcome& outcome) { latest = std::max<double>(latest, outcome.time); };
    std::string note = equipoise::basin(study, options).note;
    const bool said = note.find("never released") != std::string::npos;
    bool warned = false;
    for (const std::string& warning : equipoise::explain(study).warnings)
      warned = warned || warning.find("never let their balls go") != std::string::npos;
    EXPECT_EQ(warned, said) << note;
    EXPECT_LT(latest, 10000.0);  // not followed to the horizon of 50 000
    return note;
  };
  const char *strong = "{ stall = 0.3, no_load_speed = 2.4 }", *weak = "{ stall = 0.005, no_load_speed = 2.4 }";
  const std::string held = answer(strong, 3.0), stalled = answer(weak, 2.0), free = answer(strong, 1.5);
  EXPECT_NE(held.find("8 whose balls are never released (the rotor comes to 0.8 of release.speed at most)"),
            std::string::npos)
      << held;
  EXPECT_EQ(held.find("followed for"), std::string::npos) << held;
  EXPECT_NE(stalled.find("balls of stalled starts are never released"), std::string::npos) << stalled;
  EXPECT_EQ(free.find("never released"), std::string::npos) << free;
}

// Notes on what undecided machines do.
TEST(UndecidedMachines, SayWhatTheyDo) {
  const std::string two = "balls = 2\nmass = 0.05\ndrag = 0.05\n", heavy = "damping = 0.5\ninertia = 0.5\n";
  const auto note = [&](const std::string& law, const std::string& more) {
    return equipoise::basin(parse_study(text(heavy, two, motor(law)) + "[sampling]\nstarts = 6\n" + more, "undecided"))
        .note;
  };
  const std::string speeding = note("{ constant = 0.1 }", ""),
                    brief = note("{ constant = 0.3, slope = -0.1 }", "[numerics]\nhorizon = 100\n"),
                    rising = note("{ constant = 0.0003, slope = -0.0001 }", "[numerics]\nhorizon = 800\n"),
                    exploding = note("{ constant = 0.3, slope = 0.2 }", "");  // ten thousandfold in 25 units
  EXPECT_NE(speeding.find("speeds the rotor up without end"), std::string::npos) << speeding;
  EXPECT_NE(exploding.find("speeds the rotor up without end"), std::string::npos) << exploding;
  EXPECT_NE(brief.find("watched for too short a time"), std::string::npos) << brief;
  EXPECT_NE(brief.find("followed for 100 (numerics.horizon)"), std::string::npos) << brief;
  EXPECT_NE(rising.find("whose rotor still speeds up (at "), std::string::npos) << rising;
  // Inertia times speed over torque would be 6000 units of time: vibration absorbs all of the torque at resonance.
  EXPECT_NE(rising.find("; the motor's target is 3; even without balls the rotor stalls at "), std::string::npos)
      << rising;
}

// Notes on balance concern its linear stability.
TEST(BalanceNote, IsAboutStability) {
  const auto note = [](const std::string& toml) {
    const Study study = parse_study(toml, "note");
    const auto found = equipoise::analyse_balanced(study.system());
    return equipoise::BalanceNote{found.stable, found.note};
  };
  const std::string two = "balls = 2\nmass = 0.05\ndrag = 0.05\n", heavy = "damping = 0.5\ninertia = 0.5\n";
  const auto driven = [&](double speed, const std::string& more = "") {
    return text(heavy + more, two, motor(fmt::format("{{ stall = 0.3, no_load_speed = {} }}", speed)));
  };
  EXPECT_TRUE(note(driven(2.4)).stable);
  EXPECT_TRUE(note(driven(2.4, "stiffness = [1.0, 1.3]\n")).stable);
  EXPECT_TRUE(note(driven(2.4, "gravity = 0.01\n")).stable);
  EXPECT_TRUE(note(text(heavy, two + "race_offset = [0.003, 0.0]\n", constant(2.4))).stable);
  for (const auto& toml : {driven(0.8), driven(0.8, "stiffness = [1.0, 1.05]\n"), driven(0.8, "gravity = 0.001\n"),
                           text(heavy, two + "race_offset = [0.003, 0.0]\n", constant(0.8))}) {
    const auto answer = note(toml);
    EXPECT_FALSE(answer.stable) << toml;
    EXPECT_NE(answer.note.find("unstable"), std::string::npos) << answer.note;
  }
  const auto speeding = note(text(heavy, two, motor("{ constant = 0.1 }")));
  EXPECT_FALSE(speeding.stable);
  EXPECT_NE(speeding.note.find("never vanishes"), std::string::npos) << speeding.note;
  const Study coasting =
      parse_study(text(heavy, two, motor("{ constant = 0.1, until = 20 }")) + "[sampling]\nstarts = 4\n", "coasting");
  EXPECT_NE(equipoise::basin(coasting).note.find("the speed that the rotor then keeps is not known"),
            std::string::npos);
}

// A motor so weak that no start is decided, with three horizons: before, in and after the passage through resonance.
// Statements about passing agree with separately followed trajectories.
TEST(Passed, OfUndecidedStartsIsToldByWhereTheyWereLastSeen) {
  for (const double horizon : {18000.0, 29000.0, 36000.0}) {
    Study study = parse_study(R"(
[rotor]
mass = "12 kg"
stiffness = "25 kN/m"
damping_ratio = 0.07
unbalance = "1500 g mm"
inertia = "0.05 kg m2"
[balancer]
balls = 2
mass = "11.207 g"
race_radius = "70 mm"
drag = "1e-3 N m s"
[speed]
profile = "torque"
torque = { stall = "0.006 N m", no_load_speed = "3000 rpm" }
)",
                              "weak");
    study.sampling.starts = 3;
    study.numerics.horizon = horizon;
    equipoise::BasinOptions options;
    options.keep_starts = true;
    const equipoise::BasinResult r = equipoise::basin(study, options);
    ASSERT_EQ(r.undecided.count, 3u);
    std::uint64_t passed = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      Study alone = study;
      alone.numerics.tolerance = 1e-8;  // to within 1e-4 of the speed, for a slow start that is not chaotic
      std::copy_n(&r.every_start->phi[2 * i], 2, alone.initial.phi.begin());
      const auto followed = equipoise::simulate(alone, {horizon, horizon + 50.0});
      const double speed = followed.psi_dot.back();
      // Over fifty units of time the motor adds 0.01; the start's figure is the mean over them.
      EXPECT_NEAR(r.every_start->mean_speed[i], speed, 0.02) << i;
      passed += speed > study.passed_speed();
    }
    EXPECT_EQ(r.passed->count, passed) << horizon;
    EXPECT_EQ(r.not_passed->count, 0u);
    EXPECT_EQ(r.passed->most, 1.0);
    EXPECT_EQ(passed, horizon < 20000.0 ? 0u : horizon > 35000.0 ? 3u : passed);
    const std::string told = equipoise::basin_text(r);
    EXPECT_NE(told.find(passed == 3   ? "resonance: 100.0 %"
                        : passed == 0 ? "resonance: 0.0 %"
                                      : "resonance: "),
              std::string::npos)
        << told;
    EXPECT_EQ(told.find("not known yet") == std::string::npos, passed == 3) << told;
    EXPECT_NE(told.find("whose rotor still speeds up (at "), std::string::npos) << told;
    // As explain says of the same motor, 7860 s: three e-foldings of the way to its no-load speed.
    const double run_up = *equipoise::explain(study).run_up->shaken * study.scales->time();
    EXPECT_NE(
        told.find(fmt::format("; the motor's target is 3000 rpm; a run-up to 2850 rpm takes about {:.0f} s", run_up)),
        std::string::npos)
        << told << run_up;
    EXPECT_EQ(told.find("longer than they were followed") != std::string::npos,
              run_up > horizon * study.scales->time());
  }
}

// A motor that drives the rotor below resonance has not passed it, however steadily it turns and whatever counts as
// stalled.
TEST(Passed, MeansTheResonance) {
  Study study = parse_study(text("damping = 0.5\ninertia = 0.5\n", "balls = 2\nmass = 0.05\ndrag = 0.05\n",
                                 motor("{ stall = 0.3, no_load_speed = 0.6 }")) +
                                "[sampling]\nstarts = 20\n",
                            "slow");
  const auto slow = equipoise::basin(study);
  EXPECT_EQ(slow.stalled->count, 0u);
  EXPECT_EQ(slow.passed->count, 0u);
  EXPECT_EQ(slow.not_passed->count, 20u - slow.undecided.count);
  study.speed.torque.no_load_speed = 2.4;
  study.speed.stalled_below = 2.5;  // above what the motor comes to
  const auto fast = equipoise::basin(study);
  EXPECT_EQ(fast.stalled->count, 20u);
  EXPECT_EQ(fast.passed->count, 20u);
}

// Passing is decided by each start's own mean speed, the same from the file as from the run.
TEST(Passed, HasBoundsAndSurvivesTheFile) {
  const std::string path = (std::filesystem::temp_directory_path() / "equipoise_machine_passed.nc").string();
  std::filesystem::remove(path);
  Study study = parse_study(text("damping = 0.5\ninertia = 0.5\n", "balls = 2\nmass = 0.05\ndrag = 0.05\n",
                                 motor("{ constant = 0.1, until = 20 }")) +
                                "[sampling]\nstarts = 40\n",
                            "passed");
  equipoise::BasinOptions options;
  options.output = path;
  const auto first = equipoise::basin(study, options), again = equipoise::basin(study, options);
  EXPECT_EQ(again.resumed_from, 40u);
  ASSERT_TRUE(first.passed && again.passed);
  EXPECT_GT(first.passed->count, 20u);  // three quarters keep more than sqrt 2
  EXPECT_EQ(first.passed->count, again.passed->count);
  ASSERT_TRUE(first.not_passed && again.not_passed);
  EXPECT_EQ(first.not_passed->count, again.not_passed->count);
  EXPECT_EQ(first.not_passed->count, first.stalled->count);
  const std::uint64_t open = 40 - first.passed->count - first.not_passed->count;  // of the undecided, the slower ones
  EXPECT_LE(open, first.undecided.count);
  const auto possible = equipoise::wilson_share(first.passed->count + open, 40);
  EXPECT_EQ(first.passed->most, possible.high);
  EXPECT_EQ(first.passed->least, first.passed->low);
  std::filesystem::remove(path);
}

}  // namespace machine_labels_test
