// Studies of tilting rotors: read, refused and echoed; and their trajectories against an integration in fixed axes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/mechanics/capability.hpp"
#include "equipoise/machine/mechanics/forced_vibration.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "equipoise/simulation/trajectory/study_equations.hpp"
#include "equipoise/study/contents/study.hpp"
#include "../support/refusals.hpp"
#include "tilt_fixed_flow.hpp"

namespace equipoise {
namespace tilt_study_test {

using namespace tilting;

Study study(const std::vector<std::string>& overrides = {}) { return long_rotor_with(overrides); }

std::string refusal_of(const std::vector<std::string>& overrides) {
  return refusal_text([&] { study(overrides); });
}

std::vector<double> times(double until, double every) {
  std::vector<double> result;
  for (int k = 0; k * every <= until; ++k) result.push_back(k * every);
  return result;
}

TEST(TiltStudy, IsReadAndWrittenAgain) {
  const Study s = study({"rotor.tilt.stiffness={ x = [0.1, 9], y = [0.2, 8] }", "rotor.stiffness=[1, 2]",
                         "initial.tilt_x=0.01", "initial.tilt_y_dot=-0.02"});
  const model::Parameters& p = s.parameters;
  ASSERT_TRUE(p.tilts());
  EXPECT_EQ(p.eccentricity_angle, 1.0);
  EXPECT_EQ(p.tilt.transverse_inertia, 3.25);
  EXPECT_EQ(p.tilt.couple(), 0.005 * 2.75);
  EXPECT_EQ(p.tilt.stiffness[0], (std::array{0.1, 9.0}));
  EXPECT_EQ(p.tilt.stiffness[1], (std::array{0.2, 8.0}));
  EXPECT_EQ(p.tilt.damping[0], p.tilt.damping[1]);
  EXPECT_EQ(p.tilt.plane[1], 2.0);
  EXPECT_EQ(p.tilt.plane[3], -2.0);
  EXPECT_EQ(p.inertia, 0.5 + 0.005 * 0.005 * 2.75);
  EXPECT_EQ(s.initial.tilt_x, 0.01);
  EXPECT_EQ(s.initial.tilt_y_dot, -0.02);
  EXPECT_FALSE(p.isotropic());
  const std::string echo = to_toml(s);
  EXPECT_EQ(to_toml(parse_study(echo, "echo")), echo);
  EXPECT_EQ(to_toml(study({"rotor.inertia=0.7"})).find("inertia = 0.7") == std::string::npos, false);
}

TEST(TiltStudy, SaysWhatIsWrong) {
  const auto says = [](const std::vector<std::string>& overrides, const char* what) {
    const std::string text = refusal_of(overrides);
    EXPECT_NE(text.find(what), std::string::npos) << text;
  };
  says({"rotor.tilt.stiffness=[3, 9]"}, "k12^2 less than 1 k22");
  says({"rotor.tilt.stiffness=[0, -9]"}, "k22 greater than 0");
  says({"rotor.tilt.stiffness=9"}, "rotor.tilt.stiffness");
  says({"rotor.tilt.stiffness={ x = [0, 9] }"}, "rotor.tilt.stiffness.y");
  says({"rotor.tilt.stiffness={ x = [0, 9], y = [0, 9], z = 1 }"}, "z");
  says({"rotor.tilt.damping=[0.1, 0.18]"}, "c12^2 at most 0.02 c22");
  says({"rotor.tilt.polar_inertia=6.6"}, "at most twice rotor.tilt.transverse_inertia");
  says({"rotor.tilt.transverse_inertia=0"}, "greater than 0");
  says({"balancer.plane=[2, 2, -2]"}, "one per ball");
  says({"balancer.contact_angle=0.1"}, "its balls slide in a centred race and pass each other");
  says({"balancer.rolling=0.01"}, "its balls slide in a centred race and pass each other");
  says({"balancer.stiction=0.01"}, "its balls slide in a centred race and pass each other");
  says({"balancer.race_offset=[0.01, 0]"}, "its balls slide in a centred race and pass each other");
  says({"balancer.rolls=true"}, "its balls slide in a centred race and pass each other");
  const std::string plane = R"(
[rotor]
eccentricity = 0.01
damping = 0.5
[balancer]
balls = 2
mass = 0.01
drag = 0.1
[speed]
profile = "constant"
speed = 2.0
)";
  for (const char* key : {"rotor.eccentricity_angle=1", "balancer.plane=1", "initial.tilt_x=0.1"})
    EXPECT_NE(refusal_text([&] { parse_study(plane, "plane", {key}); }).find("only with rotor.tilt"), std::string::npos)
        << key;
}

TEST(TiltStudy, LacksNoResult) {
  const Study s = study();
  for (const model::Capability& c : model::capabilities) EXPECT_FALSE(model::lacking(s.system(), c.result)) << c.name;
}

TEST(TiltStudy, IsFollowedAsItIsSimulated) {
  const Study s = study({"rotor.tilt.bearings_at=[2, -2]"});
  const std::vector<double> times{0.0, 3.0, 8.0};
  const Trajectory expected = simulate(s, times);
  FollowedRun run(s);
  Trajectory out;
  out.phi.resize(4);
  out.phi_dot.resize(4);
  for (const double t : times) {
    EXPECT_EQ(run.advance(t), IntegrationStatus::done);
    run.record(out);
  }
  EXPECT_FALSE(run.clamped());
  ASSERT_EQ(out.t, times);
  for (std::size_t k = 0; k < times.size(); ++k) {
    EXPECT_NEAR(out.x[k], expected.x[k], 1e-10);
    EXPECT_NEAR(out.tilt_y[k], expected.tilt_y[k], 1e-10);
    EXPECT_NEAR(out.phi[3][k], expected.phi[3][k], 1e-8);
    EXPECT_NEAR(out.bearing_radial[1][k], expected.bearing_radial[1][k], 1e-10);
  }
}

// Rodrigues and others (2008), (19): the conical one; and with unequal springs on either side.
TEST(TiltStudy, KnowsTheHighestCriticalSpeed) {
  const auto highest = [](const std::vector<std::string>& overrides) {
    return model::highest_critical_speed(study(overrides).parameters);
  };
  EXPECT_NEAR(highest({}), std::sqrt(9.0 / (3.25 - 0.5)), 1e-12);
  EXPECT_NEAR(highest({"rotor.tilt.stiffness=[3, 45]"}), 4.071091, 5e-7);
  EXPECT_NEAR(highest({"rotor.stiffness=[1, 5]", "rotor.tilt.stiffness={ x = [0, 9], y = [0, 45] }"}), 3.77692, 5e-6);
  EXPECT_NEAR(highest({"rotor.tilt.polar_inertia=4"}), 1.0, 1e-12);  // a disk has no conical one
  const Study driven =
      study({"speed={ profile = \"torque\", initial = 3.0, torque = { stall = 0.35, no_load_speed = 3.5 } }"});
  EXPECT_NEAR(driven.passed_speed(), 1.809068, 5e-7);  // not where it still hangs at the conical resonance
}

// Both sums that balance makes 0.
double left_over(const model::Parameters& p, const double* phi) {
  Complex f1 = std::polar(p.eccentricity, p.eccentricity_angle), f2 = p.tilt.couple();
  for (int i = 0; i < p.balls; ++i) {
    f1 += std::polar(p.mass[i], phi[i]);
    f2 += p.tilt.plane[i] * std::polar(p.mass[i], phi[i]);
  }
  return std::abs(f1) + std::abs(f2);
}

TEST(TiltStudy, SaysWhyNothingBalances) {
  const auto reason = [](const std::vector<std::string>& overrides) {
    const model::BalancedStates states = model::balanced_states(study(overrides).parameters);
    EXPECT_EQ(states.kind, model::BalancedStates::Kind::none);
    return states.reason;
  };
  EXPECT_NE(reason({"balancer.plane=2"}).find("a couple stays"), std::string::npos);
  EXPECT_EQ(reason({"balancer.mass=0.0026"}).find("of the share of one plane, the unbalance is larger"), 0u);
  EXPECT_NE(reason({"balancer.plane=[2, 1, -1, -2]", "balancer.mass=0.001"}).find("no angles"), std::string::npos);
  // One plane balances where it holds the whole unbalance, which the couple then follows from.
  const model::BalancedStates held = model::balanced_states(
      study({"balancer.plane=2", "rotor.eccentricity_angle=0", "rotor.eccentricity=0.006875"}).parameters);
  EXPECT_EQ(held.kind, model::BalancedStates::Kind::continuum);
}

TEST(TiltStudy, EveryPlaneTakesPartInBalance) {
  using Kind = model::BalancedStates::Kind;
  struct Case {
    std::vector<std::string> overrides;
    Kind kind;
    int freedom;
  };
  const std::string six = "initial.phi=[0, 1, 2, 3, 4, 5]";
  for (const Case& c :
       {Case{{}, Kind::isolated, 0}, Case{{"balancer.plane=[2, 1, -1, -2]"}, Kind::isolated, 0},
        Case{{"balancer.plane=[3, 2, -2, -3]", "balancer.mass=[0.004, 0.005, 0.006, 0.005]"}, Kind::isolated, 0},
        Case{{six, "balancer.balls=6", "balancer.plane=[2, 2, 2, -2, -2, -2]"}, Kind::continuum, 2},
        Case{{six, "balancer.balls=6", "balancer.plane=[2, 2, 0, 0, -2, -2]"}, Kind::continuum, 2}}) {
    const model::Parameters p = study(c.overrides).parameters;
    const model::BalancedStates states = model::balanced_states(p);
    ASSERT_EQ(states.kind, c.kind) << states.reason;
    for (const auto& phi : states.angles) EXPECT_LT(left_over(p, phi.data()), 1e-14);
    const model::System system(p, 3.5);
    EXPECT_EQ(model::balanced_freedom(system), c.freedom);
    std::array<double, model::max_balls> phi{2.0, -2.0, 1.0, -1.0, 2.5, -2.5};
    if (c.kind == Kind::isolated) phi = states.angles.front();
    ASSERT_TRUE(model::project_to_balanced(p, phi.data()));
    EXPECT_LT(left_over(p, phi.data()), 1e-14);
    // As many angles are free as there are eigenvalues at 0.
    const VectorXd y = model::balanced_state(system, 3.5, phi.data());
    const Eigen::VectorXcd rates = equipoise::dense::eigenvalues(model::jacobian(system, y));
    EXPECT_EQ((rates.cwiseAbs().array() < 1e-6).count(), c.freedom);
    EXPECT_LT(model::rate(system, y).lpNorm<Eigen::Infinity>(), 1e-13);
  }
}

// The largest difference between row `k` of a run and a state in fixed axes.
double difference(const Trajectory& run, std::size_t k, const FixedFlow& flow, const std::array<double, most>& y) {
  const Fixed f = flow.state(y.data());
  const Complex back = std::polar(1.0, -f.psi);
  const auto apart = [](Complex v, double x, double there) { return std::abs(v - Complex(x, there)); };
  const Complex z = f.q1 * back, s = f.q2 * back;
  double worst = std::max({apart(z, run.x[k], run.y[k]), apart(s, run.tilt_x[k], run.tilt_y[k]),
                           apart(f.v1 * back - i1 * f.w * z, run.x_dot[k], run.y_dot[k]),
                           apart(f.v2 * back - i1 * f.w * s, run.tilt_x_dot[k], run.tilt_y_dot[k]),
                           std::fabs(f.w - run.psi_dot[k]), std::fabs(f.psi - run.psi[k])});
  for (Eigen::Index i = 0; i < f.theta.size(); ++i)
    worst = std::max(
        {worst, std::fabs(f.theta[i] - f.psi - run.phi[i][k]), std::fabs(f.rate[i] - f.w - run.phi_dot[i][k])});
  return worst;
}

// Both integrations err by 1e-12 a step, and nearby trajectories part by less than a thousandfold in this time.
constexpr double close_together = 1e-8;

const std::vector<std::string> everything{"balancer.mass=[0.005, 0.006, 0.007, 0.004]",
                                          "balancer.drag=[0.01, 0.02, 0.03, 0.005]",
                                          "balancer.plane=[2, 1.5, -2, -1]",
                                          "rotor.stiffness=[1, 1.7]",
                                          "rotor.damping=[0.02, 0.05]",
                                          "rotor.tilt.stiffness={ x = [0.3, 9], y = [-0.2, 12] }",
                                          "rotor.gravity=0.02",
                                          "rotor.tilt.damping={ x = [0.01, 0.18], y = [0, 0.2] }",
                                          "initial.phi=[0.1, 2, -1, 3]",
                                          "initial.phi_dot=[0.1, -0.2, 0, 0.3]",
                                          "initial.psi=0.4",
                                          "initial.x=0.01",
                                          "initial.y_dot=0.02",
                                          "initial.tilt_x=0.01",
                                          "initial.tilt_y=-0.02",
                                          "initial.tilt_y_dot=0.01"};

TEST(TiltStudy, SimulatesAsFixedAxesDo) {
  for (const std::vector<std::string>& overrides : {std::vector<std::string>{}, everything}) {
    const Study s = study(overrides);
    const Trajectory run = simulate(s, times(40.0, 5.0));
    ASSERT_EQ(run.tilt_x.size(), run.t.size());
    const FixedFlow flow{s.parameters, false, 0.0};
    std::array<double, most> y = first_state(s, 3.5);
    for (std::size_t k = 0; k < run.t.size(); ++k) {
      if (k > 0) {
        ASSERT_TRUE(advance(flow, run.t[k - 1], run.t[k], y));
      }
      EXPECT_LT(difference(run, k, flow, y), close_together) << run.t[k];
    }
  }
}

// Rates next to those in fixed axes, slopes next to differences, and the energy that the powers account for.
TEST(TiltStudy, HasEquationsForOtherIntegrators) {
  std::vector<std::string> at_zero = everything;
  at_zero.push_back("initial.psi=0");
  std::vector<std::string> ramp = at_zero, motor = at_zero;
  ramp.push_back("initial.phi_dot=0");
  ramp.push_back("speed={ profile = \"ramp\", initial = 0.0, final = 3.5, duration = 20 }");
  motor.push_back("speed={ profile = \"torque\", initial = 1.0, torque = { constant = 0.2, slope = -0.05 } }");
  for (const std::vector<std::string>& overrides : {at_zero, ramp, motor}) {
    const Study s = study(overrides);
    const StudyEquations equations(s);
    const int size = equations.dimension();
    EXPECT_EQ(size, 4 + 2 * 4 + 4 + (s.speed.driven() ? 2 : 0));
    EXPECT_EQ(equations.variables().back().name, "tilt_v");
    std::vector<double> y = equations.initial_state();
    y[4] += 0.3;
    for (std::size_t piece = 0; piece < equations.pieces().size(); ++piece) {
      const double t = equations.pieces()[piece].begin;
      const auto rates = [&](double at, const std::vector<double>& z) {
        std::vector<double> rate(z.size());
        equations.rhs(piece, at, z.data(), rate.data());
        return rate;
      };
      const std::vector<double> rate = rates(t, y);
      const auto moved = [&](double h, const std::vector<double>& by) {
        std::vector<double> z = y;
        for (std::size_t k = 0; k < z.size(); ++k) z[k] += h * by[k];
        return z;
      };
      constexpr double h = 1e-5;
      const double change = (equations.energy(piece, t + h, moved(h, rate).data()) -
                             equations.energy(piece, t - h, moved(-h, rate).data())) /
                            (2.0 * h);
      const model::Powers powers = equations.powers(piece, t, y.data());
      EXPECT_NEAR(change, powers.drive - powers.supports - powers.balls, 1e-9) << piece;
      std::vector<double> slopes(y.size() * y.size());
      equations.jacobian(piece, t, y.data(), slopes.data());
      for (std::size_t column = 0; column < y.size(); ++column) {
        std::vector<double> unit(y.size(), 0.0);
        unit[column] = 1.0;
        const std::vector<double> up = rates(t, moved(h, unit)), down = rates(t, moved(-h, unit));
        for (std::size_t row = 0; row < y.size(); ++row)
          EXPECT_NEAR(slopes[row * y.size() + column], (up[row] - down[row]) / (2.0 * h), 1e-7);
      }
      const std::vector<double> again = equations.state(piece, t, equations.motion(piece, t, y.data()));
      for (std::size_t k = 0; k < y.size(); ++k)
        if (!equations.pieces()[piece].held) {
          EXPECT_NEAR(again[k], y[k], 1e-15) << k;
        }
    }
    if (s.speed.driven() || s.release_time() > 0.0) continue;
    std::vector<double> rate(y.size());
    equations.rhs(0.0, y.data(), rate.data());
    const VectorXd fixed = fixed_rate(s.system(), Eigen::Map<const VectorXd>(y.data(), size));
    EXPECT_LT((fixed - Eigen::Map<const VectorXd>(rate.data(), size)).norm(), 1e-13);
  }
}

// Balls held until the end of a ramp, then free.
TEST(TiltStudy, HoldsBallsThroughARamp) {
  const Study s =
      study({"speed={ profile = \"ramp\", initial = 0.0, final = 3.5, duration = 20 }", "initial.phi=[0.1, 2, -1, 3]"});
  const Trajectory run = simulate(s, times(40.0, 5.0));
  std::array<double, most> y = first_state(s, 0.0);
  const FixedFlow held{s.parameters, true, 3.5 / 20.0}, free{s.parameters, false, 0.0};
  for (std::size_t k = 1; k < run.t.size(); ++k) {
    const FixedFlow& flow = run.t[k] <= 20.0 ? held : free;
    ASSERT_TRUE(advance(flow, run.t[k - 1], run.t[k], y));
    EXPECT_LT(difference(run, k, flow, y), close_together) << run.t[k];
  }
}

TEST(TiltStudy, IsDrivenByAMotor) {
  const Study s = study({"speed={ profile = \"torque\", initial = 1.0, torque = { constant = 0.2, slope = -0.05 } }",
                         "rotor.inertia=0.8"});
  const Trajectory run = simulate(s, times(40.0, 5.0));
  std::array<double, most> y = first_state(s, 1.0);
  FixedFlow flow{s.parameters, false, 0.0};
  flow.driven = true;
  flow.constant = 0.2;
  flow.slope = -0.05;
  for (std::size_t k = 1; k < run.t.size(); ++k) {
    ASSERT_TRUE(advance(flow, run.t[k - 1], run.t[k], y));
    EXPECT_LT(difference(run, k, flow, y), close_together) << run.t[k];
  }
}

// Mean deflection of the sections at one race radius to either side.
double deflection(const Trajectory& run, std::size_t k) {
  return 0.5 * (std::hypot(run.x[k] + run.tilt_x[k], run.y[k] + run.tilt_y[k]) +
                std::hypot(run.x[k] - run.tilt_x[k], run.y[k] - run.tilt_y[k]));
}

// Figures 11 (i), 11 (iii) and 12 (a) of Rodrigues and others (2008), read to two per cent of the axis: first peaks of
// .048, .048 and .0255, then balance.
TEST(TiltStudy, HasThePublishedHistories) {
  struct History {
    std::vector<std::string> overrides;
    double peak, until, left;
  };
  const std::vector<std::string> unbalance{"rotor.eccentricity=0.01", "rotor.eccentricity_angle=0",
                                           "rotor.tilt.misalignment=0"};
  std::vector<std::string> first = unbalance, third = unbalance;
  first.insert(first.end(), {"speed.speed=2", "balancer.mass=0.025"});
  third.push_back("speed.speed=4");
  for (const History& h : {History{first, 0.04843, 800.0, 0.0015}, History{third, 0.04826, 800.0, 0.0005},
                           History{{}, 0.0252, 1200.0, 0.0001}}) {
    const Trajectory run = simulate(study(h.overrides), times(h.until, 0.05));
    double peak = 0.0;
    for (std::size_t k = 0; k < run.t.size(); ++k) peak = std::max(peak, deflection(run, k));
    EXPECT_NEAR(peak, h.peak, 0.0001);
    double left = 0.0;
    for (std::size_t k = run.t.size() - 400; k < run.t.size(); ++k) left = std::max(left, deflection(run, k));
    EXPECT_LT(left, h.left);
  }
}

// All balls together, outward or inward: the centre whirls as that of one body, and the shaft stays straight.
TEST(TiltStudy, BallsTogetherWhirlAsOneBody) {
  const Study s = study({"rotor.eccentricity=0.01", "rotor.eccentricity_angle=0", "rotor.tilt.misalignment=0"});
  const double w = 3.5, all = 4 * 0.005;
  const model::System system = s.system();
  for (const double side : {1.0, -1.0}) {
    // [r (1 - (1 + N) w^2) - w^2 N s]^2 + (c r w)^2 = w^4 lambda^2
    const double a = 1.0 - (1.0 + all) * w * w, b = w * w * all * side, c = 0.02 * w, d = w * w * 0.01;
    const double square = a * a + c * c, root = std::sqrt(a * a * b * b - square * (b * b - d * d));
    for (const double r : {(a * b + root) / square, (a * b - root) / square}) {
      if (!(r > 0.0)) continue;
      // Z ((1 - (1 + N) w^2) + i c w) = w^2 (lambda + N s Z/r)
      const Complex direction = d / Complex(a * r - b, c * r);
      VectorXd y = VectorXd::Zero(system.dimension());
      const Complex z = r * direction, u = i1 * w * z;
      y.head(4) << z.real(), z.imag(), u.real(), u.imag();
      for (int i = 0; i < 4; ++i) y[4 + i] = std::arg(z) + (side > 0.0 ? 0.0 : pi);
      const auto found = refine_equilibrium(system, y);
      ASSERT_TRUE(found);
      EXPECT_LT((found->state - y).lpNorm<Eigen::Infinity>(), 1e-9) << r;
      EXPECT_EQ(found->eigenvalues.size(), 16);
    }
  }
}

}  // namespace tilt_study_test
}  // namespace equipoise
