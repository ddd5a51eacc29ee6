// What an explained study says of balance: each sentence where it is true and where it is not, against trajectories.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/report/explain/explain.hpp"
#include "equipoise/report/text/grade_text.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "../support/studies.hpp"
#include "../support/explained.hpp"

namespace equipoise {
namespace explain_balance_test {

// For a start that is `off` balance: the rate at which the difference between successive strobes changes, from `from`
// to `to` strobes, with the largest value within each period of the slow oscillation.
double measured_rate(const Explanation& e, double off, int from, int to) {
  Study study = e.study;
  for (int i = 0; i < study.parameters.balls; ++i)
    study.initial.phi[static_cast<std::size_t>(i)] =
        e.motion->angles[static_cast<std::size_t>(i)] + (i ? 0.5 : 1.0) * off;
  const auto rest = model::rest_position(study.parameters, 0.0);
  study.initial.x = rest[0] - study.parameters.race_offset[0];
  study.initial.y = rest[1] - study.parameters.race_offset[1];
  const double strobe = two_pi / std::fabs(*e.speed);
  constexpr int window = 40;
  std::vector<double> times;
  for (int k = 0; k <= to + window; ++k) times.push_back(k * strobe);
  const Trajectory t = simulate(study, times);
  const auto largest = [&](int first) {
    double most = 0.0;
    for (int k = first; k < first + window; ++k) {
      const auto at = static_cast<std::size_t>(k);
      for (std::size_t i = 0; i < t.phi.size(); ++i) most = std::max(most, std::fabs(t.phi[i][at + 1] - t.phi[i][at]));
    }
    return most;
  };
  return std::log(largest(to) / largest(from)) / ((to - from) * strobe);
}

// Features that each remove the equilibrium of a plain rotor.
const std::vector<std::vector<std::string>> not_plain{
    {"rotor.gravity=0.05"},
    {"rotor.stiffness=[0.8,1.2]"},
    {"balancer.race_offset=[0.004,0.002]"},
    {"rotor.gravity=0.03", "rotor.damping=[0.4,0.6]"},
    {"balancer.race_offset=[0.004,0.002]", "rotor.stiffness=[0.9,1.1]"}};

TEST(ExplainedBalance, RatesOfRotorsThatAreNotPlainAreThoseOfTrajectories) {
  for (const auto& overrides : not_plain) {
    const Explanation e = explained(constant_speed, overrides);
    ASSERT_TRUE(e.motion.has_value()) << overrides.front() << e.no_motion;
    EXPECT_TRUE(e.motion->stable);
    EXPECT_EQ(e.motion->less, "") << overrides.front();
    // A slow pair, and one half as fast again that has died out by then. Maxima over a period of 31 strobes give the
    // envelope to a few percent.
    EXPECT_NEAR(measured_rate(e, 0.05, 200, 280), e.motion->slowest_rate, 0.05 * std::fabs(e.motion->slowest_rate))
        << overrides.front();
  }
}

TEST(ExplainedBalance, InstabilityUnderGravityIsTold) {
  const std::vector<std::string> unstable{"rotor.gravity=0.001", "speed.speed=1.5", "balancer.drag=0.01"};
  const Explanation e = explained(constant_speed, unstable);
  EXPECT_NEAR(e.motion->slowest_rate, 0.0218, 5e-5);  // gravity this weak leaves the published digits
  EXPECT_GT(measured_rate(e, 1e-4, 0, 120), 0.2 * e.motion->slowest_rate);  // until it is far away
  EXPECT_TRUE(warned(e, "balance is unstable at the final speed"));
  EXPECT_TRUE(holds(explain_text(e), "can balance           yes, but balance is not stable at the final speed\n"));
  EXPECT_EQ(rule(e, "drag").kept, false);
  const Explanation stable = explained(constant_speed, {unstable[0]});
  EXPECT_LT(measured_rate(stable, 1e-4, 0, 120), 0.0);
  EXPECT_FALSE(warned(stable, "unstable"));
  EXPECT_TRUE(holds(explain_text(stable), "can balance           yes, apart from what gravity adds\n"));
  EXPECT_TRUE(holds(explain_text(stable), "approach to balance   stable; slowest time constant"));
  EXPECT_TRUE(holds(explain_text(stable), "rate, by multipliers"));
  EXPECT_TRUE(holds(rule(stable, "settling").words, "the rule without gravity"));
}

TEST(ExplainedBalance, GravityLeavesTheDisplacementThatItSays) {
  Explanation e = explained(constant_speed, {"rotor.gravity=0.05"});
  ASSERT_TRUE(e.motion && e.motion->left);
  EXPECT_TRUE(holds(explain_text(e), "the balls rock as the rotor turns"));
  Study study = e.study;
  std::copy_n(e.motion->angles.begin(), 2, study.initial.phi.begin());
  std::vector<double> times{0.0};
  constexpr int looks = 64;  // a turn, on the same grid as the orbit's
  for (int k = 0; k <= looks; ++k) times.push_back((400.0 + k / static_cast<double>(looks)) * two_pi / 2.4);
  const Trajectory t = simulate(study, times);
  const double most = *std::max_element(t.radial.begin() + 1, t.radial.end());
  EXPECT_NEAR(*e.motion->left, most, 1e-6 * most);  // 25 time constants after the start: e^-25
  EXPECT_FALSE(explained(constant_speed).motion->left);
  EXPECT_FALSE(holds(explain_text(explained(constant_speed)), "rock"));
  EXPECT_FALSE(explained(constant_speed, {"rotor.stiffness=[0.8,1.2]"}).motion->left);  // the rotor rests
}

TEST(ExplainedBalance, SaysWhatLinearTheoryLeavesOut) {
  const Explanation many = explained(constant_speed, {"rotor.gravity=0.01", "balancer.balls=4", "balancer.drag=1"});
  EXPECT_EQ(many.motion->less, "without gravity");
  EXPECT_TRUE(holds(explain_text(many), "stable, without gravity; slowest time constant"));
  const auto json = nlohmann::json::parse(json_text(many));
  EXPECT_EQ(json["balanced"]["left_out"], "without gravity");
  const Explanation dry = explained(constant_speed, {"balancer.rolling=0.001"});
  EXPECT_EQ(dry.motion->less, "without dry friction");
  EXPECT_TRUE(holds(rule(dry, "settling").words, "friction stops the balls short of it"));
  // One state of a continuum represents only itself.
  const Explanation unstable = explained(constant_speed, {"balancer.balls=4"});
  EXPECT_TRUE(warned(unstable, "unstable at the final speed, in the state shown of a continuum"));
  EXPECT_TRUE(holds(verdict_text(unstable), "in the state shown of a continuum"));
  EXPECT_FALSE(holds(verdict_text(explained(constant_speed, {"speed.speed=1.5", "balancer.drag=0.01"})), "continuum"));
  // Unequal supports as well: with three balls or more, multipliers are shown without the continuum's own.
  const Explanation uneven = explained(constant_speed, {"rotor.stiffness=[0.8,1.2]", "balancer.balls=4"});
  EXPECT_EQ(uneven.motion->less, "");
  EXPECT_EQ(uneven.motion->eigenvalues.size(), 12u - 2u);
  // 9.81 m/s2 = R omega^2 at 172.7 rpm: below that balls fall.
  const Explanation falls = explained(constant_machine, {"speed.speed=170 rpm", "rotor.gravity=9.81 m/s2"});
  EXPECT_EQ(falls.motion->less, "without gravity");
}

TEST(ExplainedBalance, SoftSpringsUnderGravityHaveABalancedMotionToo) {
  // The rotor sags by 33 race radii, 12 000 times the movement that the balls cause.
  const Explanation e = explained(constant_speed, {"rotor.gravity=30", "speed.speed=150", "balancer.drag=8"});
  ASSERT_TRUE(e.motion.has_value()) << e.no_motion;
  EXPECT_EQ(e.motion->less, "");
  EXPECT_LT(*e.motion->left, 1e-3);
}

TEST(ExplainedBalance, GravityMayLeaveNoBalancedMotion) {
  const Explanation e = explained(constant_speed, {"rotor.gravity=1"});
  EXPECT_EQ(verdict_text(e), "the balls have the mass and the room, but no balanced motion was found with gravity");
  // A ball that begins where it would balance without gravity does not stay: it moves by more than half a turn.
  Study study = e.study;
  const double phi = std::acos(-0.1);
  study.initial.phi = {phi, -phi};
  const Trajectory t = simulate(study, {0.0, 500.0});
  EXPECT_GT(std::max(std::fabs(t.phi[0][1] - phi), std::fabs(t.phi[1][1] + phi)), pi);
  EXPECT_FALSE(holds(verdict_text(explained(constant_speed, {"rotor.gravity=0.05"})), "no balanced motion"));
}

TEST(ExplainedBalance, BallsCancelWhatTheyHaveRoomFor) {
  const Explanation fits = explained(crowded_machine);
  const double unit = 10.0 * 0.04;  // kg m
  EXPECT_NEAR(fits.largest_unbalance * unit, 5.2198e-3, 1e-6);
  EXPECT_TRUE(holds(explain_text(fits), "these balls cancel from 0 kg mm (0) to 5.2198 kg mm (0.013049) side by side"));
  const Explanation more = explained(crowded_machine, {"rotor.unbalance=6000 g mm"});
  EXPECT_EQ(rule(more, "ball_mass").kept, false);
  EXPECT_FALSE(more.motion.has_value());
  EXPECT_FALSE(nlohmann::json::parse(json_text(more))["can_balance"]);
  // The same masses without a size can balance it.
  const std::string& points = constant_machine;
  EXPECT_EQ(verdict_text(explained(points)), "yes");
  EXPECT_FALSE(holds(explain_text(explained(points)), "side by side\n"));
}

TEST(ExplainedBalance, TheStateShownHasRoom) {
  for (const char* unbalance : {"100 g mm", "1000 g mm", "4000 g mm", "5200 g mm"}) {
    const Explanation e = explained(crowded_machine, {std::string("rotor.unbalance=") + unbalance});
    ASSERT_TRUE(e.motion.has_value()) << unbalance;
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_GT(std::fabs(std::remainder(e.motion->angles[i] - e.motion->angles[k], two_pi)),
                  e.ball_width[0] * (1.0 - 1e-6))  // Newton's last steps towards balance
            << unbalance;
  }
}

TEST(ExplainedBalance, OneBallIsNotSeveral) {
  const Explanation just = explained(constant_speed, {"balancer.balls=1", "rotor.eccentricity=0.05"});
  // One ball has only one way out of balance, and on that it is pulled back.
  EXPECT_FALSE(holds(rule(just, "drag").words, "nothing brings"));
  EXPECT_TRUE(just.motion->stable);
}

TEST(ExplainedBalance, WithoutUnbalanceTwoBallsAreBroughtBack) {
  const Explanation e = explained(constant_speed, {"rotor.eccentricity=0"});
  EXPECT_TRUE(e.motion->stable);
  EXPECT_FALSE(holds(rule(e, "drag").words, "nothing brings"));
  // Three balls in line with the unbalance lack a pull of first order.
  const Explanation line = explained(constant_speed, {"rotor.eccentricity=0.1"});
  EXPECT_TRUE(holds(rule(line, "drag").words, "nothing brings the balls of this balanced state back"));
  EXPECT_FALSE(line.motion->stable);
  EXPECT_TRUE(warned(line, "its largest rate is within 1e-9 of 0"));
  EXPECT_TRUE(holds(rule(line, "settling").words, "the largest rate is within 1e-9 of 0"));
}

TEST(ExplainedBalance, DoesNotContradictItself) {
  // The rule holds from half to twice the drag of its formula, and there nothing is overdamped.
  for (const double drag : {0.05, 0.1, 0.2, 0.3, 0.5, 1.0, 3.0}) {
    const Explanation e = explained(constant_speed, {"balancer.drag=" + std::to_string(drag)});
    const RuleOfThumb& r = rule(e, "drag");
    EXPECT_FALSE(r.kept == true && warned(e, "overdamped")) << drag;
    EXPECT_EQ(warned(e, "overdamped"), holds(r.words, "too much")) << drag;
  }
  // Negligible rates are called so everywhere.
  const Explanation slow = explained(constant_speed, {"speed.speed=0.0017"});
  EXPECT_TRUE(holds(explain_text(slow), "NOT stable: the largest rate is within 1e-9 of 0"));
  EXPECT_FALSE(holds(explain_text(slow), "growth rate"));
  EXPECT_FALSE(holds(explain_text(slow), "grows"));
  EXPECT_TRUE(warned(slow, "its largest rate is within 1e-9 of 0"));
  // With four balls as well: the continuum's own zeros are two, not all small values.
  EXPECT_FALSE(explained(constant_speed, {"speed.speed=0.0017", "balancer.balls=4"}).motion->stable);
}

TEST(ExplainedBalance, SaysOfDragWhatDragDoes) {
  // With strong drag on weak supports the rotor's own decay is the slowest, and no ball's drag helps.
  const std::vector<std::string> weak{"rotor.damping=0.002", "balancer.drag=0.3", "speed.speed=12",
                                      "rotor.eccentricity=0.07"};
  const Explanation e = explained(constant_speed, weak);
  EXPECT_EQ(e.motion->more_drag(), 0);
  EXPECT_TRUE(warned(e, "in more than 1000 units of time; the balls' drag hardly changes that"));
  EXPECT_TRUE(holds(explain_text(e), "hardly changed with more drag"));
  // And indeed twice the drag changes the slowest rate by less than a hundredth.
  const Explanation twice = explained(constant_speed, {weak[0], "balancer.drag=0.6", weak[2], weak[3]});
  EXPECT_NEAR(twice.motion->slowest_rate, e.motion->slowest_rate, 0.02 * std::fabs(e.motion->slowest_rate));
}

TEST(ExplainedBalance, AnOffCentreRaceChangesWhatThereIsToCancel) {
  const Explanation e = explained(constant_speed, {"balancer.race_offset=[0.01,0.002]"});
  EXPECT_LT(e.unbalance, 0.002);
  EXPECT_TRUE(holds(explain_text(e), "the rotor's own is 0.01; the off-centre race changes it to that"));
  EXPECT_FALSE(holds(explain_text(explained(constant_speed)), "the rotor's own is"));
  // Balls that could cancel the rotor's own unbalance, but not that of a race so far off centre.
  const Explanation far = explained(constant_speed, {"balancer.race_offset=[-0.2,0]"});
  EXPECT_GT(far.unbalance, 0.1);
  EXPECT_TRUE(holds(verdict_text(far), "no: the unbalance is larger"));
}

TEST(ExplainedBalance, NothingIsSaidOfASteadyVibrationThatIsNone) {
  EXPECT_FALSE(explained(constant_speed, {"rotor.damping=0", "speed.speed=1"}).bare);
  EXPECT_TRUE(explained(constant_speed, {"rotor.damping=0.1", "speed.speed=1"}).bare);
}

TEST(ExplainedBalance, EigenvaluesAreReadable) {
  const std::string text = explain_text(explained(constant_speed, {"balancer.balls=5", "balancer.drag=1"}));
  EXPECT_FALSE(holds(text, "e-15 i"));
  EXPECT_FALSE(holds(text, "e-16 i"));
  // Numbers of any length stay clear of the next column.
  const std::string slow = explain_text(explained(constant_speed, {"speed.speed=0.01"}));
  EXPECT_FALSE(holds(slow, " i0"));
  for (const std::string& all : {text, slow})
    for (std::size_t at = all.find(" i"); at != std::string::npos; at = all.find(" i", at + 1))
      EXPECT_TRUE(all[at + 2] == '\n' || all[at + 2] == ' ' || std::isalpha(static_cast<unsigned char>(all[at + 2])));
}

TEST(GradeText, HasTheFigureAndTheGradeOfTheStandard) {
  EXPECT_EQ(grade_text(147.2), "G 147 (within grade G 250)");
  EXPECT_EQ(grade_text(0.0), "G 0");
  EXPECT_EQ(grade_text(1e-9), "G 0");
  EXPECT_EQ(grade_text(0.01), "G 0.01 (within grade G 0.4)");
  EXPECT_EQ(grade_text(5000.0), "G 5e+03 (beyond grade G 4000)");
  EXPECT_EQ(grade_text(6.3), "G 6.3 (within grade G 6.3)");
}

}  // namespace explain_balance_test
}  // namespace equipoise
