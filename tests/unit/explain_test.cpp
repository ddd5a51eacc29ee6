// A study explained: figures against hand calculations and closed forms; each warning with a study that causes it.
#include <cmath>
#include <ctime>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/report/explain/explain.hpp"
#include "../support/snapshots.hpp"
#include "../support/studies.hpp"
#include "../support/explained.hpp"

namespace equipoise {
namespace explain_test {

const std::string machine = with(ramp_machine, "3000 rpm", "2000 rpm");

Explanation of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return explained(text, overrides);
}

double quantity(const Explanation& e, const std::string& symbol) {
  for (const auto& q : e.quantities)
    if (q.symbol == symbol) return q.value;
  ADD_FAILURE() << symbol;
  return 0.0;
}

TEST(Explain, HasTheCriticalSpeedsAndWhatTheBallsCancel) {
  const Explanation e = of(machine);
  EXPECT_EQ(e.critical_alone[0], 1.0);
  EXPECT_DOUBLE_EQ(e.critical_with_balls[1], 1.0 / std::sqrt(1.0 + 0.12 / 12.0));
  EXPECT_DOUBLE_EQ(*e.speed, 2000.0 * pi / 30.0 / machine_omega_c);
  EXPECT_DOUBLE_EQ(e.largest_unbalance, 0.01);
  EXPECT_EQ(e.least_unbalance, 0.0);
  EXPECT_DOUBLE_EQ(quantity(e, "M eps"), 0.2 / 30.0);
  EXPECT_DOUBLE_EQ(quantity(e, "D"), 2e-4 / (12.0 * 9e-4 * machine_omega_c));
}

TEST(Explain, FindsTheLeastUnbalanceOfUnequalBalls) {
  // Sides 2, 7, 3 (per mille): the polygon closes from 7 - 3 = 4 to 10.
  const Explanation e = of(machine, {"balancer.mass=['84 g', '36 g']", "rotor.eccentricity=0.06 mm"});
  EXPECT_NEAR(e.least_unbalance, 0.004, 1e-16);
  EXPECT_NEAR(e.largest_unbalance, 0.01, 1e-16);
  EXPECT_EQ(e.balanced.kind, model::BalancedStates::Kind::none);
}

TEST(Explain, ShowsTheSagAndWarnsWhereItExceedsTheClearance) {
  // (12 + 0.12) kg 9.81 m/s2 / 48 kN/m = 2.477 mm.
  const std::vector<std::string> lying{"rotor.gravity='9.81 m/s2'", "limits.displacement='2 mm'"};
  const Explanation e = of(machine, lying);
  EXPECT_NEAR(e.sag * 30.0, 12.12 * 9.81 / 48.0, 1e-12);
  EXPECT_TRUE(holds(explain_text(e), "2.477 mm")) << explain_text(e);
  const auto json = nlohmann::json::parse(json_text(e));
  EXPECT_NEAR(json["static_sag"]["si"], 12.12 * 9.81 / 48000.0, 1e-12);
  EXPECT_NEAR(json["weight"]["si"], 12.12 * 9.81, 1e-9);
  EXPECT_FALSE(holds(explain_text(of(machine)), "sag"));
}

TEST(Explain, KnowsTheVibrationOfTheBareRotor) {
  const Explanation e = of(machine);
  const double w = *e.speed, zeta = 400.0 / std::sqrt(48000.0 * 12.0), lambda = 0.2 / 30.0;
  const double r = lambda * w * w / std::sqrt((1.0 - w * w) * (1.0 - w * w) + zeta * zeta * w * w);
  EXPECT_DOUBLE_EQ(e.bare->displacement[0], r);
  EXPECT_DOUBLE_EQ(e.bare->force[1], r * std::sqrt(1.0 + zeta * zeta * w * w));
  const Explanation x = of(machine, {"rotor.stiffness=['40 kN/m', '56 kN/m']"});
  EXPECT_GT(x.bare->displacement[1], x.bare->displacement[0]);  // the stiffer direction is nearer to resonance
  EXPECT_DOUBLE_EQ(x.critical_alone[0], std::sqrt(40.0 / 48.0));
}

TEST(Explain, LinearisesTheWayIntoBalance) {
  const Explanation e = of(machine);
  ASSERT_TRUE(e.motion.has_value());
  EXPECT_TRUE(e.motion->stable);
  EXPECT_EQ(e.motion->eigenvalues.size(), 8u);
  // Equal balls: cos phi = -lambda/(2 mu).
  EXPECT_NEAR(std::cos(e.motion->angles[0]), -(0.2 / 30.0) / (2.0 * 0.005), 1e-12);
  for (const auto& v : e.motion->eigenvalues) EXPECT_LE(v.real(), e.motion->slowest_rate);
  // The sensitivity shows which way the slowest rate moves.
  const Explanation more = of(machine, {"balancer.drag=2.02e-4 N m s"});
  EXPECT_EQ(e.motion->drag_sensitivity > 0.0, more.motion->slowest_rate < e.motion->slowest_rate);
  // Of WP's first table: unstable at Omega = 1.5, beta = 0.01 with rate 0.0218.
  const Explanation u = of(constant_speed, {"speed.speed=1.5", "balancer.drag=0.01"});
  EXPECT_FALSE(u.motion->stable);
  EXPECT_NEAR(u.motion->slowest_rate, 0.0218, 5e-5);  // printed digits of docs/explanation/equations.md
}

TEST(Explain, SaysWhatRollingChanges) {
  const std::vector<std::string> size{"balancer.ball_diameter=8 mm"}, thick{size[0], "balancer.drag=1 N m s"};
  const Explanation slides = of(machine), rolls = of(machine, size);
  EXPECT_EQ(quantity(rolls, "m_eff/m"), 1.4);
  EXPECT_DOUBLE_EQ(quantity(rolls, "r"), 4.0 / 30.0);
  EXPECT_FALSE(slides.motion->slowest_if_sliding);
  EXPECT_EQ(*rolls.motion->slowest_if_sliding, slides.motion->slowest_rate);
  EXPECT_NE(rolls.motion->slowest_rate, slides.motion->slowest_rate);
  EXPECT_TRUE(holds(explain_text(rolls), "if the balls slid instead of rolled"));
  EXPECT_FALSE(holds(explain_text(slides), "slid"));
  EXPECT_EQ(nlohmann::json::parse(json_text(rolls))["balanced"]["slowest_rate_if_sliding"],
            slides.motion->slowest_rate);
  // Strong drag slows a ball by 5/7 beta and more, as far as the rotor, a hundred times heavier, yields.
  const auto fastest = [](const Explanation& e) { return e.motion->eigenvalues.back().real(); };
  EXPECT_NEAR(fastest(of(machine, {thick[1]})) / fastest(of(machine, thick)), 1.4, 0.02);
}

// A turn of the rotor is then up to a million periods of its fastest vibration, which nobody waits for.
TEST(Explain, AnswersSoonForSupportsHoweverStiff) {
  for (const char* stiffness : {"[1e9, 1.0]", "[1e12, 1.0]", "[1.0, 1e300]"})
    for (const char* gravity : {"0.0", "0.001"}) {
      const std::clock_t begin = std::clock();
      const Explanation e =
          of(constant_speed, {std::string("rotor.stiffness=") + stiffness, std::string("rotor.gravity=") + gravity});
      EXPECT_LT(std::clock() - begin, 2 * CLOCKS_PER_SEC) << stiffness;
      EXPECT_TRUE(holds(e.no_motion, "too many periods of its fastest vibration")) << e.no_motion;
    }
}

TEST(Explain, LeavesTheContinuumsOwnZerosOut) {
  const Explanation e = of(machine, {"balancer.balls=4"});
  ASSERT_TRUE(e.motion.has_value());
  EXPECT_EQ(e.motion->eigenvalues.size(), 12u - 2u);  // n - 2 zeros of 4 + 2 n
  double x = 0.2 / 30.0, y = 0.0;
  for (int i = 0; i < 4; ++i) {
    x += 0.005 * std::cos(e.motion->angles[static_cast<std::size_t>(i)]);
    y += 0.005 * std::sin(e.motion->angles[static_cast<std::size_t>(i)]);
  }
  EXPECT_LT(std::hypot(x, y), 1e-14);
}

TEST(Explain, SaysAndWarnsWhatTheSnapshotSays) {
  expect_said("explanations.txt", {{"machine", machine}, {"constant", constant_speed}, {"crowded", crowded_machine}},
              [](const StudyCase& c) {
                const Explanation e = explained(c.text, c.overrides);
                std::string said = "can balance: " + verdict_text(e) + "\n";
                if (!e.no_motion.empty()) said += "no linear theory: " + e.no_motion + "\n";
                for (const std::string& warning : e.warnings) said += "warning: " + warning + "\n";
                return said;
              });
  // By default balls touch, and there is no such study if they do not fit.
  EXPECT_THROW(of(machine, {"balancer.ball_diameter=59 mm", "balancer.balls=4"}), InputError);
}

TEST(Explain, LeavesGravityOutOfWhatTheBallsCancel) {
  const Explanation e = of(machine, {"rotor.gravity=9.81 m/s2"});
  EXPECT_EQ(e.balanced.kind, model::BalancedStates::Kind::isolated);
  const double omega = 2000.0 * pi / 30.0;
  EXPECT_NEAR(*e.gravity_ratio, 9.81 / (0.03 * omega * omega), 1e-14);
  EXPECT_TRUE(holds(explain_text(e), "yes, apart from what gravity adds"));
}

TEST(Explain, TakesTheTargetOfAMotorForTheFinalSpeed) {
  const auto driven = [](const char* torque) {
    return of(machine,
              {"speed={profile='torque'}", "rotor.inertia=0.0108 kg m2", std::string("speed.torque=") + torque});
  };
  const Explanation e = driven("{gain='0.1 N m s', target={profile='ramp', final='2000 rpm', duration='5 s'}}");
  EXPECT_DOUBLE_EQ(*e.speed, 2000.0 * pi / 30.0 / machine_omega_c);
  EXPECT_DOUBLE_EQ(*e.spin_up, 5.0 * machine_omega_c);
  EXPECT_DOUBLE_EQ(quantity(e, "K_p"), 0.1 / (12.0 * 9e-4 * machine_omega_c));
  EXPECT_TRUE(holds(explain_text(e), "at constant speed"));
  EXPECT_DOUBLE_EQ(*driven("{stall='1 N m', no_load_speed='2000 rpm'}").speed, *e.speed);
  // A constant torque aims at no speed.
  const Explanation free = driven("{constant='1 N m'}");
  EXPECT_FALSE(free.speed.has_value());
  EXPECT_TRUE(holds(explain_text(free), "final speed           none: the motor's last torque never ends"));
}

TEST(Explain, HasTheReynoldsNumberOfASlippingBall) {
  std::string oiled = machine;
  oiled.replace(oiled.find("drag = \"2e-4 N m s\""), 19,
                "ball_diameter = \"10 mm\"\noil_viscosity = \"1 Pa s\"\noil_density = \"900 kg/m3\"");
  const Explanation e = of(oiled);
  const double slip = 2000.0 * pi / 30.0 - machine_omega_c / std::sqrt(1.01);
  EXPECT_NEAR(*e.reynolds, 900.0 * slip * 0.03 * 0.01 / 1.0, 1e-9);
  EXPECT_TRUE(warned(e, "Reynolds"));
  EXPECT_FALSE(of(machine).reynolds.has_value());
}

TEST(ExplainText, ShowsBothFormsOrTheOneThereIs) {
  const std::string both = explain_text(of(machine));
  for (const char* part :
       {"physical", "12 kg", "30 mm", "603.95 rpm", "48 kN/m", "2.4 kg mm", "3.6 kg mm",
        "rms velocity in one direction", "ISO 21940-11", "(within grade G 100)", "not a certification", "no warnings"})
    EXPECT_NE(both.find(part), std::string::npos) << part << "\n" << both;
  const std::string plain = explain_text(of(constant_speed));
  for (const char* part : {"rpm", "physical", "ISO"}) EXPECT_EQ(plain.find(part), std::string::npos) << plain;
  const std::string units = explain_text(of(constant_speed + "[units]\nmass=12\nlength=0.03\nfrequency=63.2\n"));
  EXPECT_TRUE(holds(units, "12 kg")) << units;
}

TEST(ExplainJson, HasEveryFigureInBothForms) {
  const auto json = nlohmann::json::parse(json_text(of(machine)));
  EXPECT_EQ(json["quantities"][0]["symbol"], "M");
  EXPECT_EQ(json["quantities"][0]["unit"], "kg");
  EXPECT_DOUBLE_EQ(json["critical_speed"][0]["si"].get<double>(), machine_omega_c);
  EXPECT_TRUE(json["can_balance"]);
  EXPECT_DOUBLE_EQ(json["largest_unbalance"]["si"].get<double>(), 3.6e-3);
  // 0.2 mm at 209.4 rad/s.
  EXPECT_NEAR(json["balance_grade"]["mm_per_s"].get<double>(), 41.89, 0.01);
  EXPECT_EQ(json["balance_grade"]["standard"], 100.0);
  EXPECT_EQ(json["study"]["units"]["mass"], 12.0);
  const auto plain = nlohmann::json::parse(json_text(of(constant_speed)));
  EXPECT_TRUE(plain["balance_grade"].is_null());
  EXPECT_FALSE(plain["final_speed"].contains("si"));
}

}  // namespace explain_test
}  // namespace equipoise
