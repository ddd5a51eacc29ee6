// Rules of thumb against hand calculations, exact geometry and the balance of power. (drawn_rules_test.cpp: over drawn
// rotors, against the linearised equations.)
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/report/explain/parts.hpp"
#include "equipoise/report/explain/explain.hpp"
#include "equipoise/report/explain/rules_of_thumb.hpp"
#include "../support/studies.hpp"
#include "../support/explained.hpp"

namespace equipoise {
namespace rules_of_thumb_test {

const std::string& machine = constant_machine;

double figure(const RuleOfThumb& rule, const std::string& name) {
  const auto found =
      std::find_if(rule.figures.begin(), rule.figures.end(), [&](const auto& f) { return f.name == name; });
  if (found == rule.figures.end()) throw std::logic_error(rule.id + " has no figure " + name);
  return found->value;
}

TEST(CriticalSpeedRule, KnowsGravityAndSupportsThatDiffer) {
  const Explanation e = explained(machine, {"rotor.gravity='9.81 m/s2'", "rotor.stiffness=['40 kN/m', '56 kN/m']"});
  const RuleOfThumb& r = rule(e, "critical_speed");
  EXPECT_DOUBLE_EQ(figure(r, "critical speed with the balls, x"), std::sqrt(40.0 / 48.0 / 1.01));
  EXPECT_DOUBLE_EQ(figure(r, "their weight makes balls vibrate twice per turn, resonance at"),
                   0.5 * std::sqrt(40.0 / 48.0 / 1.01));
  EXPECT_DOUBLE_EQ(figure(r, "run above"), std::sqrt(2.0 * 56.0 / 48.0 / 1.01));
  EXPECT_EQ(r.kept, true);
  const Explanation between = explained(machine, {"rotor.stiffness=['24 kN/m', '72 kN/m']", "speed.speed=600 rpm"});
  EXPECT_EQ(rule(between, "critical_speed").kept, false);
  EXPECT_TRUE(holds(rule(between, "critical_speed").words, "between the critical speeds"));
}

TEST(RoomRule, CountsBallsAndSpacing) {
  // 2 asin(10/60) = 19.19 degrees: 18 fit; in balance the two are 2 acos(lambda/(2 mu)) = 96.4 degrees apart.
  const Explanation e = explained(machine, {"balancer.ball_diameter=10 mm"});
  const RuleOfThumb& r = rule(e, "room");
  EXPECT_EQ(figure(r, "balls of this size that fit"), 18.0);
  EXPECT_NEAR(figure(r, "angle between them in balance"), 2.0 * std::acos(0.2 / 30.0 / 0.01), 1e-12);
  EXPECT_EQ(r.kept, true);
  // Balls of 50 mm are 112.9 degrees wide: side by side they cancel 2 mu cos(56.4 degrees), less than there is.
  const Explanation wide = explained(machine, {"balancer.ball_diameter=50 mm"});
  EXPECT_TRUE(holds(rule(wide, "room").words, "overlap"));
  EXPECT_EQ(rule(wide, "room").kept, false);
  EXPECT_EQ(rule(wide, "ball_mass").kept, false);
  EXPECT_NEAR(figure(rule(wide, "ball_mass"), "most that they cancel side by side"),
              0.01 * std::sqrt(1.0 - 25.0 / 36.0), 1e-15);
  EXPECT_FALSE(rule(explained(machine), "room").kept.has_value());
}

TEST(TorqueRule, IsWhatDampersTakeInTheSteadyState) {
  model::Parameters p;
  p.balls = 2;
  p.mass = {0.02, 0.03};
  p.damping = {0.3, 0.3};
  const double w = rules::critical_speeds(p)[0], r = 0.04 * w * w / (0.3 * w);
  EXPECT_NEAR(rules::shaking_torque(p, 0.04, w), 0.3 * r * r * w, 1e-15);  // ten roundings of 0.004
  EXPECT_NEAR(rules::shaking_torque(p, 0.04, w), 0.04 * 0.04 * w * w * w / 0.3, 1e-15);
  p.damping = {0.0, 0.0};
  EXPECT_TRUE(std::isinf(rules::shaking_torque(p, 0.04, w)));
}

TEST(TorqueRule, JudgesMotors) {
  const std::string driven = rotor_and_balancer + "[speed]\nprofile = \"torque\"\n";
  const auto judged = [&](const std::string& torque) {
    const Explanation e = explained(driven, {"rotor.inertia=0.5", "speed.torque={" + torque + "}"});
    return rule(e, "torque");
  };
  // (0.01 + 0.1)^2 omega^3/0.5 = 0.02098 and 0.01^2 omega^3/0.5 = 0.000173 at omega = 0.953.
  EXPECT_EQ(judged("stall=0.1, no_load_speed=3.0").kept, true);
  EXPECT_FALSE(judged("stall=0.01, no_load_speed=3.0").kept.has_value());
  EXPECT_EQ(judged("stall=0.0002, no_load_speed=3.0").kept, false);
  EXPECT_NEAR(figure(judged("stall=0.1, no_load_speed=3.0"), "given by the motor at the critical speed"),
              0.1 * (1.0 - 1.0 / std::sqrt(1.1) / 3.0), 1e-15);
  EXPECT_NEAR(figure(judged("gain=0.1, limit=0.05, target={profile='ramp', final=3.0, duration=10.0}"),
                     "given by the motor at the critical speed"),
              0.05, 1e-15);
  EXPECT_EQ(judged("gain=0.1, integral=0.01, target={profile='ramp', final=3.0, duration=10.0}").kept, true);
  EXPECT_NEAR(figure(judged("times=[0.0, 5.0], values=[0.03, 0.01]"), "largest torque of the motor"), 0.03, 0.0);
  EXPECT_TRUE(holds(judged("stall=0.1, no_load_speed=0.5").words, "below the critical speed"));
  EXPECT_TRUE(
      holds(rule(explained(driven, {"rotor.inertia=0.5", "rotor.damping=0.0", "speed.torque={constant=0.1}"}), "torque")
                .words,
            "without damping"));
}

TEST(DragRule, TwoEqualBallsByHand) {
  // lambda = 0.01, mu = 0.05: the slower of mu (1 -+ cos 2 phi) is lambda^2/(2 mu) = 0.001.
  const Explanation e = explained(constant_speed);
  const double w2 = 2.4 * 2.4, spring = 1.1 * w2 - 1.0;
  const double stiffness = 0.001 * w2 * w2 * spring / (spring * spring + 0.25 * w2);
  EXPECT_NEAR(rules::ball_stiffness(e.study.parameters, 2.4, e.motion->angles.data()), stiffness, 1e-12);
  EXPECT_NEAR(figure(rule(e, "drag"), "from"), std::sqrt(stiffness), 1e-12);
  EXPECT_NEAR(figure(rule(e, "drag"), "to"), 4.0 * std::sqrt(stiffness), 1e-12);
  EXPECT_EQ(rule(e, "drag").kept, true);
  EXPECT_TRUE(holds(rule(explained(constant_speed, {"balancer.drag=0.001"}), "drag").words, "too little"));
  EXPECT_TRUE(holds(rule(explained(constant_speed, {"balancer.drag=5.0"}), "drag").words, "too much: the balls creep"));
  // Below 0.1 omega^3/(0.5 (2.4 - omega)) = 0.1198 all balls can lag behind, and do: the paper's V1.
  EXPECT_NEAR(figure(rule(e, "drag"), "below it balls may lag at the critical speed"), 0.1198, 1e-4);
  EXPECT_TRUE(holds(rule(e, "drag").words, "may lag behind"));
}

TEST(DragRule, TheScansEndsAreWhereItSays) {
  const Explanation e = explained(constant_speed);
  const DragScan scan(e.study.parameters, 2.4, e.motion->angles, false);
  EXPECT_NEAR(scan.slowest(1.0), e.motion->slowest_rate, 1e-13);  // one Jacobian split in two: roundings
  const auto range = scan.range(0.25, 1e-3, 1e3);
  ASSERT_TRUE(range.has_value());
  // Bisected to 1.2^(1/4096) = 4e-5 of the factor, on which the rate depends about linearly; the best of the grid.
  EXPECT_NEAR(scan.slowest(range->low), 0.25 * scan.slowest(range->best), 1e-4 * std::abs(scan.slowest(range->best)));
  EXPECT_NEAR(scan.slowest(range->high), 0.25 * scan.slowest(range->best), 1e-4 * std::abs(scan.slowest(range->best)));
  // Whatever drag the scan is scaled by: found to 0.2 % of 0.16.
  const Explanation other = explained(constant_speed, {"balancer.drag=0.37"});
  EXPECT_NEAR(figure(rule(other, "drag"), "fastest (linear theory)"),
              figure(rule(e, "drag"), "fastest (linear theory)"), 5e-4);
  EXPECT_FALSE(DragScan(e.study.parameters, 0.9, e.motion->angles, false).range(0.25, 1e-3, 1e3).has_value());
}

TEST(RulesOfThumb, SpeakOfEverySystemOrSayWhyNot) {
  const std::vector<std::vector<std::string>> systems{{},
                                                      {"rotor.gravity='9.81 m/s2'"},
                                                      {"rotor.stiffness=['40 kN/m', '56 kN/m']"},
                                                      {"balancer.race_offset=['0.01 mm', '0 mm']"},
                                                      {"balancer.balls=5"},
                                                      {"balancer.ball_diameter=10 mm", "balancer.contact=true"},
                                                      {"rotor.eccentricity=1 mm"},
                                                      {"speed.speed=300 rpm"},
                                                      {"balancer.drag=0 N m s"},
                                                      {"rotor.damping=0 N s/m"},
                                                      {"rotor.eccentricity=0 mm"}};
  for (const auto& overrides : systems) {
    const Explanation e = explained(machine, overrides);
    const std::size_t rules = e.carrying ? 7 : 6;
    EXPECT_EQ(e.advice.size(), rules);
    for (const RuleOfThumb& r : e.advice) {
      EXPECT_FALSE(r.words.empty()) << r.id;
      for (const auto& f : r.figures) EXPECT_TRUE(std::isfinite(f.value)) << r.id << " " << f.name;
    }
    const auto json = nlohmann::json::parse(json_text(e));
    EXPECT_EQ(json["advice"].size(), rules);
    EXPECT_EQ(json["carried_round"].is_null(), !e.carrying);
    EXPECT_TRUE(holds(explain_text(e), "Rules of thumb: estimates"));
  }
  const Explanation lying = explained(machine, systems[1]);
  EXPECT_TRUE(holds(rule(lying, "settling").words, "without gravity"));
  EXPECT_GT(figure(rule(lying, "settling"), "by linear theory"), 0.0);
  EXPECT_TRUE(holds(rule(explained(machine, systems[7]), "drag").words, "below the critical speed"));
  const auto json = nlohmann::json::parse(json_text(explained(machine)));
  EXPECT_EQ(json["advice"][3]["id"], "drag");
  EXPECT_EQ(json["advice"][4]["figures"][0]["unit"], "s");
}

}  // namespace rules_of_thumb_test
}  // namespace equipoise
