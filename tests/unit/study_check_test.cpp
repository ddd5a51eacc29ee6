// What "check" says of a study: understood, assumed, and which estimate matters most.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/report/explain/explain.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "../support/explained.hpp"
#include "../support/studies.hpp"

namespace equipoise {
namespace study_check_test {

const std::string checked = with(with(ramp_machine, "mass = \"60 g\"\ndrag = \"2e-4 N m s\"\n",
                                      "ball_diameter = \"10 mm\"\nball_material = \"steel\"\n"
                                      "oil = { grade = \"ISO VG 32\", at = \"40 degC\" }\n"),
                                 "eccentricity = \"0.2 mm\"", "unbalance = \"120 g mm\"");

StudyCheck check_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return check_study(text, "m.toml", overrides);
}

bool assumes(const std::string& text, const std::string& words, const std::vector<std::string>& overrides = {}) {
  const std::vector<std::string> all = check_of(text, overrides).assumed;
  return std::any_of(all.begin(), all.end(), [&](const std::string& one) { return holds(one, words); });
}

TEST(StudyCheck, SaysWhatItUnderstood) {
  const StudyCheck c = check_of(ramp_machine);
  EXPECT_EQ(c.machine, "12 kg on 48 kN/m, critical speed 600.95 rpm with its balls; runs at 3000 rpm, 4.99 times that");
  EXPECT_EQ(c.unbalance,
            "2.4 kg mm, its centre of mass 200 um from the shaft; G 62.8 (within grade G 100) at 3000 rpm");
  EXPECT_EQ(c.balls,
            "2 of 60 g each on a circle of 30 mm; they cancel from 0 to 3.6 kg mm, up to 1.5 times the unbalance");
  const std::string text = c.text();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 5);
  EXPECT_TRUE(holds(check_of(ramp_machine, {"rotor.eccentricity=0.4 mm"}).balls,
                    "at most 0.75 times the unbalance: balance is impossible"));
  EXPECT_TRUE(holds(check_of(ramp_machine, {"rotor.eccentricity=0 mm"}).balls, "there is nothing to cancel"));
  EXPECT_TRUE(holds(check_of(constant_speed).machine, "2.4 omega_c"));
  // One ratio and one unbalance for one machine, as explain has them.
  const std::vector<std::string> unequal{"rotor.stiffness=['40 kN/m', '56 kN/m']"},
      offset{"balancer.race_offset=['0.05 mm', '0 mm']"};
  EXPECT_TRUE(holds(check_of(ramp_machine, unequal).machine, "; runs at 3000 rpm, 4.62 times the higher"));
  EXPECT_TRUE(holds(explain_text(explained(ramp_machine, unequal)), "3000 rpm, 4.62 times the higher critical speed"));
  EXPECT_TRUE(holds(check_of(ramp_machine, offset).unbalance, "; the off-centre race makes it 1.8254 kg mm"));
  EXPECT_TRUE(holds(explain_text(explained(ramp_machine, offset)), "unbalance 1.8254 kg mm"));
  EXPECT_FALSE(holds(c.unbalance, "race"));
}

TEST(StudyCheck, SaysFirstThatNoBalancerHelpsBelowTheCriticalSpeed) {
  const std::string slow = check_of(ramp_machine, {"speed.final=500 rpm"}).text();
  EXPECT_TRUE(
      slow.starts_with("Leave the balancer out: the rotor runs at 500 rpm, below its critical speed of 600.95 "
                       "rpm with balls: there balls gather on the heavy side and add to the unbalance.\n"))
      << slow;
  EXPECT_TRUE(check_of(ramp_machine, {"speed.final=500 rpm", "rotor.eccentricity={uniform=['0.1 mm','0.2 mm']}"})
                  .text()
                  .starts_with("Leave the balancer out: the rotor runs below its critical speed with balls, whatever"));
  EXPECT_TRUE(holds(check_of(ramp_machine, {"speed.final=500 rpm", "rotor.gravity=9.81 m/s2"}).leave_out,
                    "there balls cancel no unbalance"));
  EXPECT_TRUE(check_of(ramp_machine, {"speed.final=700 rpm"}).leave_out.empty());
}

// Held against the rotor itself, without balls and from rest, after ten times a run-up without losses.
TEST(StudyCheck, SaysWhereAMotorMayStall) {
  const std::string driven = R"([rotor]
mass = "12 kg"
stiffness = "25 kN/m"
damping_ratio = 0.07
unbalance = "1500 g mm"
inertia = "0.005 kg m2"
[balancer]
balls = 2
mass = "12 g"
race_radius = "70 mm"
drag = "1e-3 N m s"
[speed]
profile = "torque"
torque = { stall = "1.5 mN m", no_load_speed = "3000 rpm" }
)";
  for (const bool weak : {true, false}) {
    const std::string stall = weak ? "1.5 mN m" : "15 mN m";
    const std::string override = "speed.torque.stall=" + stall;
    const std::string line = check_of(driven, {override}).machine;
    EXPECT_EQ(holds(line, "made to run at 3000 rpm, but may stall at 4"), weak) << line;
    EXPECT_EQ(holds(line, "runs at 3000 rpm, 6.89 times that"), !weak) << line;
    const Study alone = parse_study(driven, "m.toml", {override, "balancer.balls=0"});
    const double to_resonance = 0.005 * 45.6 / (weak ? 1.5e-3 : 15e-3) / alone.scales->time();
    const double speed = simulate(alone, {0.0, 10.0 * to_resonance}).psi_dot.back();
    EXPECT_EQ(speed < 1.0, weak) << speed;
  }
}

TEST(StudyCheck, ListsWhatTheStudyLeavesOpen) {
  EXPECT_TRUE(assumes(checked, "balls free from t = 0"));
  EXPECT_FALSE(assumes(checked, "balls free", {"release.time=2 s"}));
  EXPECT_FALSE(assumes(constant_machine, "balls free"));  // nothing is run up
  EXPECT_TRUE(assumes(checked, "balls touch"));
  EXPECT_FALSE(assumes(checked, "balls touch", {"balancer.contact=true"}));
  EXPECT_TRUE(assumes(ramp_machine, "balls pass through each other"));
  EXPECT_TRUE(assumes(checked, "restitution 0.5"));
  EXPECT_FALSE(assumes(checked, "restitution", {"balancer.restitution=0.8"}));
  EXPECT_TRUE(assumes(checked, "balls roll without sliding"));
  EXPECT_TRUE(assumes(ramp_machine, "balls are points that slide"));
  EXPECT_TRUE(assumes(checked, "no rolling resistance"));
  EXPECT_FALSE(assumes(checked, "no rolling resistance", {"balancer.rolling=0.1 %"}));
  EXPECT_TRUE(assumes(checked, "race centred on the shaft"));
  EXPECT_TRUE(assumes(checked, "typical density of steel"));
  EXPECT_FALSE(assumes(ramp_machine, "typical density"));
  EXPECT_TRUE(assumes(checked, "oil of 27.8 mPa s, in the middle of its class, viscosity index 95"));
  EXPECT_FALSE(assumes(checked, "viscosity index", {"balancer.oil.viscosity_100=5.4 cSt"}));
  EXPECT_TRUE(assumes(checked, "Stokes drag, without walls"));
  EXPECT_TRUE(assumes(checked, "axis of a tube", {"balancer.channel_diameter=16 mm"}));
  EXPECT_FALSE(assumes(ramp_machine, "drag of"));
  EXPECT_TRUE(assumes(checked, "supports alike in x and y"));
  EXPECT_FALSE(assumes(checked, "supports alike", {"rotor.stiffness=['40 kN/m', '50 kN/m']"}));
  EXPECT_TRUE(assumes(checked, "no gravity across the shaft"));
  EXPECT_FALSE(assumes(checked, "no gravity", {"rotor.gravity=9.81 m/s2"}));
  EXPECT_TRUE(assumes(checked, "at their medians", {"rotor.unbalance={uniform=['90 g mm', '120 g mm']}"}));
  EXPECT_FALSE(assumes(checked, "at their medians"));
  const std::string place = checked + "[[place]]\nmass = '10 g'\nradius = '20 mm'\nangle = { uniform = ['0 degree', '";
  EXPECT_TRUE(assumes(place + "360 degree'] }\n", "angles that are drawn all round at a quarter turn"));
  EXPECT_FALSE(assumes(place + "90 degree'] }\n", "quarter turn"));
}

TEST(StudyCheck, SaysWhereUnbalanceInPlacesPoints) {
  const std::string place = "[[place]]\nmass = \"24 g\"\nradius = \"100 mm\"\nangle = \"90 degree\"\n";
  EXPECT_TRUE(
      holds(check_of(ramp_machine + place).unbalance, "3.3941 kg mm, its centre of mass 282.84 um from the shaft"));
  EXPECT_TRUE(holds(check_of(ramp_machine + place).unbalance,
                    "; the resultant of the rotor's own and of 1 place, at 45 degrees, where x of the model points"));
  const std::string bare = with(ramp_machine, "eccentricity = \"0.2 mm\"\n", "");
  EXPECT_TRUE(holds(check_of(bare + place + place, {"place.2.mass={uniform=['1 g', '2 g']}"}).unbalance,
                    "; the resultant of 2 places, at 90 degrees"));
  EXPECT_FALSE(holds(check_of(ramp_machine).unbalance, "resultant"));
}

// The balls cancel 1.1 times the unbalance: a fifth more of it, or less of the balls, and they do not.
// The paper's rotor at speed 2.4: balance loses its stability at drag 0.00176884 (equipoise stability).
TEST(StudyCheck, SaysThatBalanceIsUnstableWhereItIs) {
  for (const auto& [drag, stable] : {std::pair{"0.0005", false}, {"0.0017", false}, {"0.0018", true}, {"0.05", true}}) {
    const StudyCheck check = check_of(constant_speed, {std::string("balancer.drag=") + drag});
    EXPECT_EQ(holds(check.balls, ", but balance is not stable at the final speed"), !stable) << drag << check.balls;
    EXPECT_EQ(holds(check.most, "balance becomes stable") || holds(check.most, "balance stays unstable"), !stable)
        << drag << check.most;
  }
  // Of 20 % more drag the second becomes stable, the first does not.
  EXPECT_TRUE(holds(check_of(constant_speed, {"balancer.drag=0.0017"}).most, "balance becomes stable"));
  EXPECT_TRUE(holds(check_of(constant_speed, {"balancer.drag=0.0005"}).most, "balance stays unstable"));
}

TEST(StudyCheck, PutsFirstWhatDecidesWhetherBalanceIsPossible) {
  const std::string most = check_of(ramp_machine, {"rotor.eccentricity=0.27 mm"}).most;
  EXPECT_TRUE(holds(most, "unbalance. With 20 % more, balance becomes impossible")) << most;
  const std::string spare = check_of(ramp_machine, {"rotor.eccentricity=0.02 mm"}).most;
  EXPECT_FALSE(holds(spare, "impossible")) << spare;
  EXPECT_TRUE(holds(spare, "by formulas and linear theory only")) << spare;
  // Twice what the balls can cancel stays too much.
  const std::string far = check_of(ramp_machine, {"rotor.eccentricity=0.6 mm"}).most;
  EXPECT_FALSE(holds(far, "possible")) << far;
}

TEST(StudyCheck, SaysWhereDragIsOfAFormula) {
  const std::string most = check_of(checked).most;
  EXPECT_TRUE(holds(most, "ball drag, here from a formula")) << most;
  EXPECT_FALSE(holds(check_of(ramp_machine).most, "from a formula"));
}

}  // namespace study_check_test
}  // namespace equipoise
