// What explain says of a tilting rotor, against the equations' eigenvalues and against trajectories.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/machine/mechanics/whirl.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/report/explain/explain.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "../support/explained.hpp"
#include "../support/refusals.hpp"
#include "tilt_fixed_flow.hpp"

namespace equipoise {
namespace tilt_explain_test {

const char* const drum = R"([rotor]
mass = "45 kg"
[rotor.tilt]
transverse_inertia = "2.2 kg m2"
polar_inertia = "1.1 kg m2"
bearings = [
  { at = "0.10 m", stiffness = "9 kN/m", damping = "300 N s/m" },
  { at = "-0.16 m", stiffness = "9 kN/m", damping = "300 N s/m" },
]
unbalance = [
  { at = "0.12 m", size = "60 kg mm", angle = "0 degree" },
  { at = "-0.12 m", size = "40 kg mm", angle = "90 degree" },
]
[balancer]
balls = 4
race_radius = "0.24 m"
plane = ["0.15 m", "0.15 m", "-0.15 m", "-0.15 m"]
mass = "200 g"
drag = "1.3 N s/m"
[speed]
profile = "constant"
speed = "1200 rpm"
)";

std::string told(const std::vector<std::string>& overrides = {}) { return explain_text(explained(drum, overrides)); }

// Of the rotor alone without damping, at constant speed in turning axes.
Eigen::VectorXcd eigenvalues(model::Parameters p, double speed) {
  p.balls = 0;
  p.damping = {0.0, 0.0};
  p.tilt.damping = {};
  p.eccentricity = p.tilt.misalignment = 0.0;
  const model::System system(p, speed);
  return dense::eigenvalues(model::jacobian(system, Eigen::VectorXd::Zero(system.dimension())));
}

double nearest(const Eigen::VectorXcd& values, std::complex<double> wanted) {
  return (values.array() - wanted).abs().minCoeff();
}

// A whirl once a turn stands still in turning axes, backwards it turns twice as fast.
TEST(TiltExplain, WhirlSpeedsAreThoseOfTheEquations) {
  for (const std::vector<std::string>& changes :
       {std::vector<std::string>{}, {"rotor.tilt.polar_inertia=3 kg m2"}, {"rotor.tilt.polar_inertia=0 kg m2"}}) {
    const model::Parameters p = parse_study(drum, "drum", changes).parameters;
    const model::WhirlSpeeds w = model::whirl_speeds(p, false);
    ASSERT_EQ(w.forward.size(), p.tilt.polar_inertia > p.tilt.transverse_inertia ? 1u : 2u);
    ASSERT_EQ(w.backward.size(), 2u);
    EXPECT_TRUE(w.of_both.empty());
    for (const double speed : w.forward) EXPECT_LT(nearest(eigenvalues(p, speed), 0.0), 1e-6) << speed;
    for (const double speed : w.backward) EXPECT_LT(nearest(eigenvalues(p, speed), {0.0, 2.0 * speed}), 1e-6) << speed;
    // Elsewhere there is none.
    EXPECT_GT(nearest(eigenvalues(p, 1.05 * w.forward.front()), 0.0), 1e-3);
    std::vector<double> all = w.forward;
    all.insert(all.end(), w.backward.begin(), w.backward.end());
    std::sort(all.begin(), all.end());
    model::Parameters unequal = p;
    unequal.stiffness[1] *= 1.0 + 1e-10;  // found in another way
    const std::vector<double> again = model::whirl_speeds(unequal, false).of_both;
    ASSERT_EQ(again.size(), all.size());
    for (std::size_t k = 0; k < all.size(); ++k) EXPECT_NEAR(again[k], all[k], 1e-7);
  }
}

// Held balls add to the mass and to the transverse inertia, not to the gyroscopic moment.
TEST(TiltExplain, HeldBallsLowerWhirlSpeeds) {
  const model::Parameters p =
      parse_study(drum, "drum",
                  {"rotor.tilt.bearings=[{at='0.13 m', stiffness='9 kN/m', damping='0 N s/m'}, {at='-0.13 m', "
                   "stiffness='9 kN/m', damping='0 N s/m'}]"})
          .parameters;
  const double n = p.total_mass(), z = 0.15 / 0.24, jt = p.tilt.transverse_inertia, jp = p.tilt.polar_inertia;
  const double k22 = p.tilt.stiffness[0][1];
  const std::vector<double> forward = model::whirl_speeds(p, true).forward;
  ASSERT_EQ(forward.size(), 2u);
  std::vector<double> wanted{std::sqrt(1.0 / (1.0 + n)), std::sqrt(k22 / (jt + n * z * z - jp))};
  std::sort(wanted.begin(), wanted.end());
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(forward[k], wanted[k], 1e-14);
}

// With supports that differ unbalance meets every one of them: next to it the shaft shakes less.
TEST(TiltExplain, UnequalSupportsHaveFourResonances) {
  model::Parameters p = parse_study(drum, "drum",
                                    {"rotor.tilt.bearings.1.stiffness=['9 kN/m', '14 kN/m']",
                                     "rotor.tilt.bearings.2.stiffness=['9 kN/m', '20 kN/m']"})
                            .parameters;
  p.damping = {1e-5, 1e-5};
  p.tilt.damping = {{{0.0, 1e-5}, {0.0, 1e-5}}};
  const model::WhirlSpeeds w = model::whirl_speeds(p, false);
  ASSERT_EQ(w.of_both.size(), 4u);
  for (const double speed : w.of_both) {
    const auto size = [&](double at) { return model::shaft_vibration(p, at).farthest(0.7); };
    EXPECT_GT(size(speed), 5.0 * size(0.999 * speed)) << speed;
    EXPECT_GT(size(speed), 5.0 * size(1.001 * speed)) << speed;
  }
}

TEST(TiltExplain, VibrationAtBearingsIsThatOfTheTrajectory) {
  const std::vector<std::string> bare{
      "balancer={balls=0, race_radius='0.24 m'}", "rotor.tilt.bearings.1.stiffness=['9 kN/m', '14 kN/m']",
      "rotor.tilt.bearings.2.damping=['600 N s/m', '400 N s/m']", "speed.speed=300 rpm"};
  const Explanation e = explained(drum, bare);
  ASSERT_TRUE(e.tilt && e.bare);
  ASSERT_EQ(e.tilt->at_bearings.size(), 2u);
  std::vector<double> times;  // two turns in the end, finely
  const double turn = 2.0 * 3.141592653589793 / *e.speed;
  for (int k = 0; k <= 2000; ++k) times.push_back(200.0 + k * turn / 1000.0);
  const Trajectory run = simulate(e.study, times);
  for (std::size_t b = 0; b < 2; ++b) {
    const std::vector<double>& r = run.bearing_radial[b];
    EXPECT_NEAR(*std::max_element(r.begin(), r.end()), e.tilt->at_bearings[b], 1e-5 * e.tilt->at_bearings[b]);
  }
  // Of each bearing: of spring and damper, from the trajectory of the shaft there.
  ASSERT_EQ(e.tilt->forces.size(), 2u);
  const model::Scales& s = *e.study.scales;
  const double k[2][2] = {{9e3, 14e3}, {9e3, 9e3}}, c[2][2] = {{300.0, 300.0}, {600.0, 400.0}};
  for (std::size_t b = 0; b < 2; ++b) {
    double most = 0.0, told = 0.0;
    for (std::size_t i = 1; i + 1 < times.size(); ++i) {
      double square = 0.0;
      for (std::size_t d = 0; d < 2; ++d) {
        const auto at = [&](std::size_t j) {  // in fixed axes
          const double x = run.x[j] + e.study.bearings[b] * run.tilt_x[j], sine = std::sin(run.psi[j]);
          const double y = run.y[j] + e.study.bearings[b] * run.tilt_y[j], cosine = std::cos(run.psi[j]);
          return d == 0 ? x * cosine - y * sine : x * sine + y * cosine;
        };
        const double speed = (at(i + 1) - at(i - 1)) / (times[i + 1] - times[i - 1]) * s.frequency;
        const double force = s.length * (k[b][d] * at(i) + c[b][d] * speed);
        square += force * force;
      }
      most = std::max(most, std::sqrt(square));
      told = std::max(told, run.bearing_force[b][i] * s.force());
    }
    EXPECT_NEAR(told, most, 2e-5 * most);
    EXPECT_NEAR(e.tilt->forces[b] * s.force(), most, 2e-5 * most);
  }
  std::vector<double> fx;
  for (const double f : run.bearing_x) fx.push_back(std::abs(f));
  EXPECT_NEAR(*std::max_element(fx.begin(), fx.end()), e.bare->force[0], 1e-5 * e.bare->force[0]);
}

// Balls put where it says keep rotor and shaft at rest.
TEST(TiltExplain, BallsBalanceWhereItSays) {
  const Explanation e = explained(drum);
  ASSERT_TRUE(e.motion);
  EXPECT_TRUE(e.motion->stable);
  EXPECT_EQ(verdict_text(e), "yes");
  Study s = e.study;
  for (std::size_t i = 0; i < 4; ++i) s.initial.phi[i] = e.motion->angles[i];
  s.angles_stated = true;
  const Trajectory run = simulate(s, {20.0, 50.0, 100.0});
  for (const auto& bearing : run.bearing_radial)
    for (const double r : bearing) EXPECT_LT(r, 1e-9);
  // 60 kg mm at 120 mm and 40 kg mm at -120 mm, as two planes at 150 mm and -150 mm share them.
  const double front = std::hypot(54.0, 4.0), back = std::hypot(6.0, 36.0);
  ASSERT_EQ(e.tilt->planes.size(), 2u);
  for (const ExplainedPlane& plane : e.tilt->planes) {
    const double unbalance = plane.unbalance * s.scales->unbalance() * 1e3;
    EXPECT_NEAR(unbalance, plane.at > 0.0 ? front : back, 1e-12 * front);
    EXPECT_NEAR(plane.most * s.scales->unbalance() * 1e3, 96.0, 1e-9);
  }
}

TEST(TiltExplain, SaysWhatHolds) {
  const std::string text = told();
  for (const char* words :
       {"forward whirl: ", "unbalance does not excite it", "static unbalance", "couple unbalance", "plane at 150 mm",
        "plane at -150 mm", "from the couple unbalance", "at the bearings", "of the shaft at the centre of mass",
        "highest critical speed with balls", "force at the bearings, at the largest", "all supports together"})
    EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
  for (const char* words : {"leaves no second critical speed", "rules of thumb", "heavy side"})
    EXPECT_EQ(text.find(words), std::string::npos) << words << "\n" << text;
  EXPECT_NE(told({"rotor.tilt.polar_inertia=3 kg m2"}).find("leaves no second critical speed"), std::string::npos);
  const std::string unequal = told({"rotor.tilt.bearings.1.stiffness=['9 kN/m', '14 kN/m']"});
  EXPECT_EQ(unequal.find("forward whirl"), std::string::npos);
  const std::string light = told({"balancer.mass=100 g"});
  EXPECT_NE(light.find("no: "), std::string::npos) << light;
  const std::string still = told({"rotor.tilt.unbalance=[{at='0 m', size='60 kg mm', angle=0}]"});
  EXPECT_NE(still.find("from the rotor's angle 0"), std::string::npos) << still;
  const std::string three =
      told({"rotor.tilt.bearings=[{at='0.1 m', stiffness='9 kN/m', damping='0 N s/m'}, {at='0 m', "
            "stiffness='9 kN/m', damping='0 N s/m'}, {at='-0.1 m', stiffness='9 kN/m', "
            "damping='0 N s/m'}]"});
  EXPECT_NE(three.find("force at the bearings"), std::string::npos) << three;
  EXPECT_EQ(three.find("in which a couple does not show"), std::string::npos) << three;
  // Where Jp > Jt a couple points the other way than angles count from.
  const std::string disk = explain_text(explained(tilting::long_rotor, {"rotor.tilt.polar_inertia=4"}));
  EXPECT_EQ(disk.find("from the couple unbalance"), std::string::npos) << disk;
  EXPECT_NE(disk.find("from the rotor's angle 0"), std::string::npos) << disk;
  const std::string unknown = explain_text(explained(tilting::long_rotor, {"rotor.tilt.bearings_at=[3, 0, -3]"}));
  EXPECT_EQ(unknown.find("force at the bearings"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("in which a couple does not show"), std::string::npos) << unknown;
  EXPECT_NE(json_text(explained(drum)).find("force_at_bearings"), std::string::npos);
  EXPECT_NE(json_text(explained(drum)).find("displacement_at_bearings"), std::string::npos);
}

// In the front plane, 0.10 m from the centre of mass, is (C + 0.16 m U)/0.26 m = 64.615 + 6.154 i kg mm, over a share
// of 0.16/0.26, and at the back, (0.10 m U - C)/0.26 m over 0.10/0.26, less: 105.48 kg mm/45 kg at 1200 rpm.
TEST(TiltExplain, GradesTheWorsePlane) {
  const double grade = std::hypot(16.8, 1.6) / 0.26 / (0.16 / 0.26) / 45.0 * 1200.0 * pi / 30.0;
  const auto json = nlohmann::json::parse(json_text(explained(drum)));
  EXPECT_NEAR(json["balance_grade"]["mm_per_s"].get<double>(), grade, 1e-9 * grade);
  EXPECT_EQ(json["balance_grade"]["standard"], 630.0);
  EXPECT_NE(told().find("balance quality"), std::string::npos);
  EXPECT_NE(told().find("in the worse of the outermost bearings' planes, each by its share"), std::string::npos)
      << told();
}

// At the speed of a whirl and below the lowest it warns, far above it does not.
TEST(TiltExplain, WarnsNearWhirlSpeeds) {
  const char *near = "within 10 % of a critical speed", *below = "below the critical speed";
  EXPECT_FALSE(warned(explained(drum), near));
  EXPECT_FALSE(warned(explained(drum), below));
  const Explanation far = explained(drum);
  const double rpm = far.study.scales->frequency * 30.0 / 3.141592653589793;
  for (const double speed : far.tilt->alone.forward)
    EXPECT_TRUE(warned(explained(drum, {"speed.speed=" + std::to_string(speed * rpm) + " rpm"}), near)) << speed;
  EXPECT_TRUE(warned(explained(drum, {"speed.speed=50 rpm"}), below));
}

TEST(TiltExplain, WarnsBetweenAndLittleAboveWhirlSpeeds) {
  const char *between = "lies between critical speeds", *little = "sqrt(2) times the highest critical speed";
  const std::vector<std::string> stiffer{
      "rotor.tilt.bearings.1={at='0.3 m', stiffness='9 kN/m', damping='300 N s/m'}",
      "rotor.tilt.bearings.2={at='-0.3 m', stiffness='9 kN/m', damping='300 N s/m'}"};
  const auto at = [&](double part, double of_highest) {
    const Explanation far = explained(drum, stiffer);
    const double rpm = far.study.scales->frequency * 30.0 / 3.141592653589793;
    const double speed = part * far.critical_with_balls[0] + of_highest * far.critical_alone[1];
    std::vector<std::string> changes = stiffer;
    changes.push_back("speed.speed=" + std::to_string(speed * rpm) + " rpm");
    return explained(drum, changes);
  };
  EXPECT_TRUE(warned(at(0.5, 0.5), between));
  EXPECT_FALSE(warned(at(0.5, 0.5), little));
  EXPECT_TRUE(warned(at(0.0, 1.39), little));
  EXPECT_FALSE(warned(at(0.0, 1.39), between));
  EXPECT_FALSE(warned(at(0.0, 1.43), little));
}

// Of the balls of each plane, by what they have to cancel: two balls of 200 g at 240 mm cancel up to 96 kg mm.
TEST(TiltExplain, WarnsOfUnbalance) {
  const auto of = [](const std::string& what) { return explained(drum, {"rotor.tilt.unbalance=[" + what + "]"}); };
  EXPECT_TRUE(of("{at='0.15 m', size='50 kg mm', angle=0}, {at='-0.15 m', size='50 kg mm', angle=0}").warnings.empty());
  EXPECT_TRUE(warned(of("{at='0.15 m', size='120 kg mm', angle=0}, {at='-0.15 m', size='50 kg mm', angle=0}"),
                     "plane at 150 mm: the unbalance is 1.25 times what all balls together can cancel"));
  EXPECT_TRUE(warned(of("{at='0.15 m', size='50 kg mm', angle=0}, {at='-0.15 m', size='92 kg mm', angle=0}"),
                     "plane at -150 mm: the unbalance is within 10 % of the most"));
  const Explanation couple = explained(drum, {"balancer.plane=0.1 m"});
  EXPECT_TRUE(warned(couple, "balance is impossible: the balls run in one plane"));
}

// A bearing far from the centre of mass may sag more.
TEST(TiltExplain, WarnsOfTheBearingThatSagsMost) {
  const auto on = [](const std::string& stiffness) {
    return explained(drum, {"rotor.gravity=9.81 m/s2", "rotor.tilt.bearings.1.stiffness=" + stiffness,
                            "rotor.tilt.bearings.2.stiffness=" + stiffness, "limits.displacement=1 mm"});
  };
  const Explanation e = on("1 kN/m");
  const double length = e.study.scales->length;
  // (45.8 kg g) shared by the lever rule; the race's radius is 0.24 m.
  const double front = 45.8 * 9.81 * 0.16 / 0.26 / 1000.0, back = 45.8 * 9.81 * 0.10 / 0.26 / 1000.0;
  EXPECT_LT(e.sag * length, 0.24);
  EXPECT_GT(front, 0.24);
  EXPECT_LT(back, 0.24);
  EXPECT_TRUE(warned(e, "mm at the bearing at 100 mm under its weight, more than the race's radius"));
  // A limit of displacement counts from where the rotor rests: its sag says nothing of that.
  EXPECT_FALSE(warned(on("1.2 kN/m"), "sags"));
}

TEST(TiltExplain, WeightIsThatOfRotorAndBalls) {
  const Explanation e = explained(drum, {"rotor.gravity=9.81 m/s2"});
  EXPECT_NEAR(e.weight() * e.study.scales->force(), 45.8 * 9.81, 1e-9);
}

// One line after the other, with figures that are known by hand.
TEST(TiltExplain, ChecksAStudyInWords) {
  const StudyCheck check = check_study(drum, "drum", {});
  // Roots of (18000 - 45.8 w^2)(320.4 - 1.118 w^2) = 540^2, in N/m, N m, kg and kg m^2.
  EXPECT_EQ(check.machine,
            "45 kg on 18 kN/m, tilting, critical speeds 150.22 rpm, 198.51 rpm with its balls; runs at 1200 rpm, 6.05 "
            "times the highest");
  // C = 0.12 m (60 - 40 i) kg mm.
  EXPECT_EQ(check.unbalance,
            "72.111 kg mm static and 0.0086533 kg m2 couple, its centre of mass 1.6025 mm from the shaft; G 295 "
            "(within grade "
            "G 630) in the worse plane of its bearings at 1200 rpm; x of the model points along the couple, at -33.7 "
            "degrees");
  EXPECT_EQ(
      check.balls,
      "4 of 200 g each on a circle of 240 mm; at -150 mm they cancel up to 2.63 times the unbalance; at 150 mm they "
      "cancel up to 1.77 times the unbalance");
  EXPECT_NE(check.text().find("small slopes"), std::string::npos);
  EXPECT_EQ(check.most.find("drag against capture"), std::string::npos);
  EXPECT_NE(check.most.find("20 %"), std::string::npos);
  const std::string light = check_study(drum, "drum", {"balancer.mass=100 g"}).balls;
  EXPECT_NE(light.find("balance is impossible"), std::string::npos) << light;
  const std::string one =
      check_study(drum, "drum", {"rotor.tilt.unbalance=[{at='0.15 m', size='60 kg mm', angle=0}]"}).balls;
  EXPECT_NE(one.find("at -150 mm there is nothing to cancel"), std::string::npos) << one;
}

// A fifth less of the balls in the plane with the least to spare decides where that is a tenth.
// The static unbalance alone, in the plane of the centre of mass, leaves no couple to point anywhere.
TEST(TiltExplain, CheckSpeaksOfACoupleOnlyWhereThereIsOne) {
  const StudyCheck none =
      check_study(drum, "drum", {"rotor.tilt.unbalance=[{at='0 m', size='60 kg mm', angle='40 degree'}]"});
  EXPECT_NE(none.unbalance.find("x of the model points at 0 degrees"), std::string::npos) << none.unbalance;
  EXPECT_EQ(none.unbalance.find("along the couple"), std::string::npos) << none.unbalance;
  const StudyCheck some =
      check_study(drum, "drum", {"rotor.tilt.unbalance=[{at='0.1 m', size='60 kg mm', angle='40 degree'}]"});
  EXPECT_NE(some.unbalance.find("along the couple, at 40 degrees"), std::string::npos) << some.unbalance;
}

TEST(TiltExplain, CheckFindsWhatMakesBalanceImpossible) {
  const StudyCheck check = check_study(drum, "drum", {"balancer.mass=125 g"});
  EXPECT_NE(check.most.find("balance becomes impossible"), std::string::npos) << check.most;
  EXPECT_NE(explained(drum, {"balancer.mass=125 g"}).balanced.kind, model::BalancedStates::Kind::none);
  EXPECT_EQ(explained(drum, {"balancer.mass=100 g"}).balanced.kind, model::BalancedStates::Kind::none);
}

// One ball is too heavy where there is less to cancel, and no lighter ones help a plane that cannot cancel a couple.
TEST(TiltExplain, CheckSaysWhyBalanceIsImpossible) {
  const StudyCheck lone =
      check_study(drum, "drum", {"balancer.plane=['0.15 m', '0.15 m', '0.15 m', '-0.15 m']", "balancer.mass=260 g"});
  EXPECT_NE(lone.balls.find("at -150 mm they cancel no less than"), std::string::npos) << lone.balls;
  EXPECT_NE(lone.balls.find("impossible (of the share of one plane, one ball alone cancels its own"), std::string::npos)
      << lone.balls;
  EXPECT_EQ(lone.most.find("the balls can cancel"), std::string::npos) << lone.most;
  const StudyCheck plane = check_study(drum, "drum", {"balancer.plane=0.1 m"});
  EXPECT_NE(plane.balls.find("balance is impossible (the balls run in one plane"), std::string::npos) << plane.balls;
  EXPECT_NE(plane.most.find("balance stays impossible"), std::string::npos) << plane.most;
}

TEST(TiltExplain, PagesTakeIt) { EXPECT_NO_THROW(check_pages(parse_study(drum, "drum", {}))); }

}  // namespace tilt_explain_test
}  // namespace equipoise
