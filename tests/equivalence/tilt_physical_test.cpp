// A tilting rotor, as a data sheet states it: bearings, inertias and unbalance in planes in SI units. The reference
// is written in metres and kilograms, bearing by bearing and mass by mass, in fixed axes, with an integrator of its
// own.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/echo/physical_echo.hpp"
#include "../support/refusals.hpp"
#include "../support/study_difference.hpp"

namespace equipoise {
namespace tilt_physical_test {

using Complex = std::complex<double>;
constexpr Complex i1(0.0, 1.0);
constexpr double degree = pi / 180.0;

const char* const drum = R"(
[rotor]
mass = "40 kg"
gravity = "9.81 m/s2"
[rotor.tilt]
transverse_inertia = "2.4 kg m2"
polar_inertia = "1.5 kg m2"
bearings = [
  { at = "0.15 m", stiffness = ["22 kN/m", "30 kN/m"], damping = "500 N s/m" },
  { at = "-200 mm", stiffness = "18 kN/m", damping = ["400 N s/m", "450 N s/m"] },
]
unbalance = [
  { at = "0.12 m", size = "30 kg mm", angle = "20 degree" },
  { at = "-0.18 m", size = "20 kg mm", angle = "100 degree" },
]
[balancer]
balls = 3
race_radius = "0.25 m"
mass = ["150 g", "180 g", "160 g"]
plane = ["0.2 m", "-22 cm", "0.2 m"]
drag = ["0.05 N m s", "0.05 N m s", "0.06 N m s"]
[speed]
profile = "constant"
speed = "700 rpm"
[initial]
phi = ["10 degree", "140 degree", "250 degree"]
phi_dot = ["5 rpm", "-3 rpm", "0 rpm"]
x = "1 mm"
y_dot = "20 mm/s"
tilt_x = "0.1 degree"
tilt_y_dot = "0.5 rpm"
)";

Study study(const std::vector<std::string>& overrides = {}) { return parse_study(drum, "drum", overrides); }

struct Bearing {
  double at;
  std::array<double, 2> stiffness, damping;
};
struct Plane {
  double at, size, angle;
};

// In SI units, written again from the text above.
struct Drum {
  double mass = 40.0, gravity = 9.81, transverse = 2.4, polar = 1.5, radius = 0.25;
  std::vector<Bearing> bearings{{0.15, {22e3, 30e3}, {500.0, 500.0}}, {-0.2, {18e3, 18e3}, {400.0, 450.0}}};
  std::vector<Plane> planes{{0.12, 0.030, 20.0 * degree}, {-0.18, 0.020, 100.0 * degree}};
  std::vector<double> ball_mass{0.15, 0.18, 0.16}, plane{0.2, -0.22, 0.2}, drag{0.05, 0.05, 0.06};
  double speed = 700.0 * pi / 30.0;

  Complex couple() const {
    Complex sum;
    for (const Plane& u : planes) sum += u.at * std::polar(u.size, u.angle);
    return sum;
  }

  // y: X, Y, SX, SY, theta of every ball, and the rates of all. `mark`: where the rotor's angle 0 is.
  Eigen::VectorXd rate(double mark, const Eigen::VectorXd& y) const {
    const int n = static_cast<int>(ball_mass.size()), h = 4 + n;
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(h, h);
    Eigen::VectorXd force = Eigen::VectorXd::Zero(h);
    const auto push = [&](double at, Complex f) {
      force[0] += f.real();
      force[1] += f.imag();
      force[2] += at * f.real();
      force[3] += at * f.imag();
    };
    m(0, 0) = m(1, 1) = mass;
    m(2, 2) = m(3, 3) = transverse;
    push(0.0, Complex(0.0, -mass * gravity));
    for (const Plane& u : planes) push(u.at, speed * speed * std::polar(u.size, mark + u.angle));
    // The change of the spin's momentum asks for a moment; with slopes (sx, sy) it is (-sy', sx') of polar times speed.
    force[2] -= speed * polar * y[h + 3];
    force[3] += speed * polar * y[h + 2];
    for (const Bearing& b : bearings)
      for (int d = 0; d < 2; ++d) {
        const double pull = b.stiffness[d] * (y[d] + b.at * y[2 + d]) + b.damping[d] * (y[h + d] + b.at * y[h + 2 + d]);
        force[d] -= pull;
        force[2 + d] -= b.at * pull;
      }
    for (int i = 0; i < n; ++i) {
      const double mu = ball_mass[i], z = plane[i], theta = y[4 + i], spin = y[h + 4 + i];
      const std::array<double, 2> along{-std::sin(theta), std::cos(theta)};
      for (int d = 0; d < 2; ++d) {
        m(d, d) += mu;
        m(2 + d, 2 + d) += mu * z * z;
        m(d, 2 + d) += mu * z;
        m(2 + d, d) += mu * z;
        m(d, 4 + i) = m(4 + i, d) = mu * radius * along[d];
        m(2 + d, 4 + i) = m(4 + i, 2 + d) = mu * z * radius * along[d];
      }
      m(4 + i, 4 + i) = mu * radius * radius;
      push(z, mu * radius * spin * spin * std::polar(1.0, theta) - i1 * mu * gravity);
      force[4 + i] = -drag[i] * (spin - speed) - mu * gravity * radius * std::cos(theta);
    }
    Eigen::VectorXd dy(2 * h);
    dy << y.tail(h), m.llt().solve(force);
    return dy;
  }

  // Runge and Kutta's fourth order at a fixed step.
  void advance(double& t, double until, double mark, Eigen::VectorXd& y) const {
    const int steps = static_cast<int>(std::ceil((until - t) / 1e-5));
    const double dt = (until - t) / std::max(steps, 1);
    for (int k = 0; k < steps; ++k) {
      const auto at = [&](double ahead, const Eigen::VectorXd& there) {
        return rate(mark + speed * (t + ahead), there);
      };
      const Eigen::VectorXd a = at(0.0, y), b = at(0.5 * dt, y + 0.5 * dt * a), c = at(0.5 * dt, y + 0.5 * dt * b),
                            d = at(dt, y + dt * c);
      y += dt / 6.0 * (a + 2.0 * b + 2.0 * c + d);
      t += dt;
    }
  }
};

// Both integrate to 1e-12 a step. Lengths in race radii, angles in rad.
constexpr double close_together = 1e-8;

TEST(TiltPhysical, MovesAsInSIUnits) {
  const Drum d;
  const Study s = study();
  const double omega = s.scales->frequency;
  EXPECT_NEAR(omega, std::sqrt(44e3 / 40.0), 1e-12);  // the mean of 40 and 48 kN/m
  std::vector<double> times;
  for (int k = 0; k <= 12; ++k) times.push_back(0.05 * k * omega);
  const Trajectory run = simulate(s, times);
  ASSERT_EQ(run.status, IntegrationStatus::done);
  ASSERT_EQ(run.bearing_radial.size(), 2u);

  const int n = 3, h = 4 + n;
  Eigen::VectorXd y = Eigen::VectorXd::Zero(2 * h);
  const double rpm = pi / 30.0;
  const double mark = -std::arg(d.couple());  // the model's x axis, along the couple unbalance, is at angle 0 at first
  y[0] = 1e-3;
  y[h + 1] = 0.02 + d.speed * 1e-3;
  y[2] = 0.1 * degree;
  y[h + 3] = 0.5 * rpm + d.speed * 0.1 * degree;
  const std::array<double, 3> phi{10.0, 140.0, 250.0}, rate{5.0, -3.0, 0.0};
  for (int i = 0; i < n; ++i) {
    y[4 + i] = phi[i] * degree;
    y[h + 4 + i] = d.speed + rate[i] * rpm;
  }
  // Under their weight the two bearings are pressed down by these two, solved from force and moment.
  Eigen::Matrix2d springs = Eigen::Matrix2d::Zero();
  Eigen::Vector2d weight(-d.mass * d.gravity, 0.0);
  for (const Bearing& b : d.bearings)
    springs += b.stiffness[1] * Eigen::Vector2d(1.0, b.at) * Eigen::RowVector2d(1.0, b.at);
  for (int i = 0; i < n; ++i) weight -= d.ball_mass[i] * d.gravity * Eigen::Vector2d(1.0, d.plane[i]);
  const Eigen::Vector2d rest = springs.inverse() * weight;

  double t = 0.0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    d.advance(t, times[k] / omega, mark, y);
    const double psi = d.speed * times[k] / omega;
    const Complex back = std::polar(1.0, -psi), centre(y[0], y[1]), slope(y[2], y[3]);
    EXPECT_LT(std::abs(centre * back / d.radius - Complex(run.x[k], run.y[k])), close_together) << t;
    EXPECT_LT(std::abs(slope * back - Complex(run.tilt_x[k], run.tilt_y[k])), close_together) << t;
    const Complex turning = (Complex(y[h + 2], y[h + 3]) - i1 * d.speed * slope) * back;
    EXPECT_LT(std::abs(turning / omega - Complex(run.tilt_x_dot[k], run.tilt_y_dot[k])), close_together) << t;
    for (int i = 0; i < n; ++i) {
      EXPECT_NEAR(y[4 + i] - psi, run.phi[i][k], close_together) << t;
      EXPECT_NEAR((y[h + 4 + i] - d.speed) / omega, run.phi_dot[i][k], close_together) << t;
    }
    for (std::size_t b = 0; b < 2; ++b) {
      const double at = d.bearings[b].at;
      const Complex from_rest = centre + at * slope - i1 * (rest[0] + at * rest[1]);
      EXPECT_NEAR(std::abs(from_rest) / d.radius, run.bearing_radial[b][k], close_together) << t;
    }
  }
}

// Unbalances as they add up.
TEST(TiltPhysical, AddsUnbalancesOfPlanes) {
  const auto of = [](const std::string& planes) { return study({"rotor.tilt.unbalance=" + planes}); };
  const auto couple = [](const Study& s) {  // kg m^2
    return s.parameters.tilt.couple() * s.scales->inertia();
  };
  const auto force = [](const Study& s) { return s.parameters.eccentricity * s.scales->unbalance(); };
  const Study like =
      of("[{at='0.2 m', size='50 g mm', angle='30 degree'}, {at='-0.2 m', size='50 g mm', angle='30 degree'}]");
  EXPECT_EQ(like.parameters.tilt.misalignment, 0.0);
  EXPECT_NEAR(force(like), 1e-4, 1e-16);
  EXPECT_NEAR(like.parameters.eccentricity_angle, pi / 6.0, 1e-15);
  const Study opposite =
      of("[{at='0.2 m', size='50 g mm', angle='30 degree'}, {at='-0.2 m', size='50 g mm', angle='210 degree'}]");
  EXPECT_EQ(opposite.parameters.eccentricity, 0.0);
  EXPECT_NEAR(couple(opposite), 2e-5, 1e-17);
  EXPECT_EQ(opposite.parameters.eccentricity_angle, 0.0);
  // 0.2 m times 50 g mm, at 90 degrees to the couple of 0.1 m times 50 g mm at the other end.
  const Study both =
      of("[{at='0.2 m', size='50 g mm', angle='30 degree'}, {at='-0.1 m', size='50 g mm', angle='120 degree'}]");
  const Complex u1 = std::polar(5e-5, pi / 6.0), u2 = std::polar(5e-5, 2.0 * pi / 3.0), c = 0.2 * u1 - 0.1 * u2;
  EXPECT_NEAR(couple(both), std::abs(c), 1e-17);
  EXPECT_NEAR(force(both), std::abs(u1 + u2), 1e-16);
  EXPECT_NEAR(both.parameters.eccentricity_angle, std::arg(u1 + u2) - std::arg(c), 1e-14);
  // A disc, wider than long: the same couple.
  const Study disc = study({"rotor.tilt.unbalance=[{at='0.2 m', size='50 g mm', angle='0 degree'}]",
                            "rotor.tilt.transverse_inertia=1 kg m2"});
  EXPECT_LT(disc.parameters.tilt.misalignment, 0.0);
  EXPECT_NEAR(couple(disc), 1e-5, 1e-17);
}

// The rotor's own, masses in places and planes are one sum.
TEST(TiltPhysical, AddsPlacesAndTheRotorsOwn) {
  const Study s =
      study({"rotor.tilt.unbalance=[{at='0.2 m', size='50 g mm', angle='90 degree'}]", "rotor.unbalance=80 g mm",
             "rotor.eccentricity_angle=10 degree", "rotor.tilt.misalignment=0.001",
             "place=[{mass='2 g', radius='100 mm', angle='45 degree', at='-0.3 m'}]"});
  const Complex u1 = i1 * 5e-5, own = std::polar(8e-5, 10.0 * degree), mass = std::polar(2e-4, pi / 4.0);
  const Complex couple = 0.2 * u1 - 0.3 * mass + 0.001 * 0.9, force = u1 + own + mass;
  EXPECT_NEAR(s.parameters.tilt.couple() * s.scales->inertia(), std::abs(couple), 1e-16);
  EXPECT_NEAR(s.parameters.eccentricity * s.scales->unbalance(), std::abs(force), 1e-16);
  EXPECT_NEAR(wrapped(s.parameters.eccentricity_angle - std::arg(force) + std::arg(couple)), 0.0, 1e-13);
  // Alone, the rotor's own stays as it is written.
  const Study alone = parse_study(to_physical_toml(s), "echo");
  EXPECT_EQ(first_difference(s, alone, 1e-12), "");
}

TEST(TiltPhysical, BearingsMakeTheSupports) {
  const Study s = study();
  const double k = s.scales->stiffness(), r = s.scales->length, c = s.scales->damping();
  const model::Tilt& t = s.parameters.tilt;
  EXPECT_NEAR(s.parameters.stiffness[0] * k, 40e3, 1e-8);
  EXPECT_NEAR(s.parameters.stiffness[1] * k, 48e3, 1e-8);
  EXPECT_NEAR(t.stiffness[0][0] * k * r, 22e3 * 0.15 - 18e3 * 0.2, 1e-9);
  EXPECT_NEAR(t.stiffness[1][1] * k * r * r, 30e3 * 0.0225 + 18e3 * 0.04, 1e-9);
  EXPECT_NEAR(t.damping[1][0] * c * r, 500.0 * 0.15 - 450.0 * 0.2, 1e-11);
  EXPECT_NEAR(t.damping[0][1] * c * r * r, 500.0 * 0.0225 + 400.0 * 0.04, 1e-11);
  EXPECT_NEAR(t.transverse_inertia * s.scales->inertia(), 2.4, 1e-14);
  EXPECT_EQ(s.bearings, (std::vector<double>{0.15 / 0.25, -0.2 / 0.25}));
  const Study even =
      study({"rotor.tilt.bearings=[{at='0.15 m', stiffness='20 kN/m', damping='3 N s/m'}, "
             "{at='-0.15 m', stiffness='20 kN/m', damping='3 N s/m'}]"});
  EXPECT_EQ(even.parameters.tilt.stiffness[0][0], 0.0);
  EXPECT_EQ(even.parameters.tilt.damping[0][0], 0.0);
  EXPECT_TRUE(even.parameters.isotropic());
  // A damper alone is a bearing without stiffness.
  const Study damped =
      study({"rotor.tilt.bearings=[{at='0.1 m', stiffness='20 kN/m', damping='0 N s/m'}, {at='-0.1 m', "
             "stiffness='20 kN/m', damping='0 N s/m'}, {at='0.3 m', stiffness='0 N/m', damping='9 N "
             "s/m'}]"});
  EXPECT_NEAR(damped.parameters.tilt.damping[0][1] * damped.scales->gain(), 9.0 * 0.09, 1e-13);
  EXPECT_EQ(damped.bearings.size(), 3u);
}

TEST(TiltPhysical, IsEchoedInBothForms) {
  for (const std::vector<std::string>& changes :
       {std::vector<std::string>{}, {"rotor.gravity=0 m/s2", "rotor.inertia=1.6 kg m2"}, {"balancer.balls=0"}}) {
    const Study s = study(changes);
    EXPECT_EQ(first_difference(s, parse_study(to_toml(s), "echo")), "");
    EXPECT_EQ(to_toml(parse_study(to_toml(s), "echo")), to_toml(s));
    const Study back = parse_study(to_physical_toml(s), "echo");
    EXPECT_EQ(first_difference(s, back, 1e-12), "");
    ASSERT_EQ(back.bearings.size(), 2u);
    EXPECT_NEAR(back.bearings[1], s.bearings[1], 1e-15);
  }
}

// The motor's inertia comes on top of what the tilt's inertias make.
TEST(TiltPhysical, AMotorAddsItsInertia) {
  const std::vector<std::string> motor{
      "speed={profile='torque', torque={constant='5 N m', slope='-0.05 N m s'}, motor_inertia='2e-4 kg m2', "
      "gear_ratio=10}"};
  const Study s = study(motor);
  const model::Tilt& t = s.parameters.tilt;
  EXPECT_NEAR(s.parameters.inertia * s.scales->inertia(), 1.5 + t.misalignment * t.misalignment * 0.9 + 0.02, 1e-13);
}

TEST(TiltPhysical, DrawsBearingsAndPlanes) {
  const Study s = study({"rotor.tilt.bearings.1.stiffness={uniform=['20 kN/m', '30 kN/m']}",
                         "rotor.tilt.unbalance.2.angle={uniform=['0 degree', '360 degree']}"});
  ASSERT_EQ(s.uncertain.values.size(), 2u);
  const Study one = drawn_study(s, std::vector<double>{24.0, 200.0});
  const Study same = study({"rotor.tilt.bearings.1.stiffness=24 kN/m", "rotor.tilt.unbalance.2.angle=200 degree"});
  EXPECT_EQ(first_difference(one, same, 1e-14), "");
}

struct Refusal {
  std::vector<std::string> overrides;
  std::string key, problem;
};

TEST(TiltPhysical, SaysWhatItNeeds) {
  const std::string good = "{at='0.2 m', stiffness='20 kN/m', damping='3 N s/m'}";
  for (const Refusal& r : std::vector<Refusal>{
           {{"rotor.tilt.bearings=[" + good + "]"}, "rotor.tilt.bearings", "stiffness greater than 0 at two places"},
           {{"rotor.tilt.bearings=[" + good + ", " + good + "]"}, "rotor.tilt.bearings", "at two places at least"},
           {{"rotor.tilt.bearings=[" + good + ", {at='0.1 m', stiffness=['2 kN/m', '0 N/m'], damping='0 N s/m'}]"},
            "rotor.tilt.bearings",
            "in x and in y"},
           {{"rotor.tilt.bearings=3"}, "rotor.tilt.bearings", "must be an array of tables, one per bearing"},
           {{"rotor.tilt.bearings.2.at=0.2"}, "rotor.tilt.bearings.2.at", "is a plain number"},
           {{"rotor.tilt.bearings.2.stiffness=-3 N/m"},
            "rotor.tilt.bearings.2.stiffness",
            "must be a stiffness of 0 or"},
           {{"rotor.tilt.bearings.2={at='0.2 m', stiffness='20 kN/m'}"}, "rotor.tilt.bearings.2.damping", "missing"},
           {{"rotor.tilt.bearings.2.place='0.1 m'"}, "rotor.tilt.bearings.2.place", "unknown key"},
           {{"rotor.stiffness=3 kN/m"}, "rotor.stiffness", "follows from rotor.tilt.bearings"},
           {{"rotor.damping_ratio=0.1"}, "rotor.damping_ratio", "follows from rotor.tilt.bearings"},
           {{"rotor.tilt.stiffness=['0 N', '3 N m']"}, "rotor.tilt.stiffness", "follows from rotor.tilt.bearings"},
           {{"rotor.tilt.unbalance=[{at='0.2 m', size='5 g', angle=0}]"}, "rotor.tilt.unbalance.1.size", "unbalance"},
           {{"rotor.tilt.unbalance.1.angle=5 mm"}, "rotor.tilt.unbalance.1.angle", "angle"},
           {{"rotor.tilt.polar_inertia=2.4 kg m2"}, "rotor.tilt.polar_inertia", "must differ more"},
           {{"rotor.tilt.polar_inertia=5 kg m2"}, "rotor.tilt.polar_inertia", "at most twice"},
           {{"rotor.tilt.transverse_inertia=2.4"}, "rotor.tilt.transverse_inertia", "is a plain number"},
           {{"limits={force='200 N'}", "standards={standing_mass='60 kg', friction=0.3}"},
            "limits.force",
            "state one of the two"},
           {{"balancer.plane=[0.2, -0.2, 0.2]"}, "balancer.plane", "entry 1 is a plain number"},
           {{"balancer.ball_diameter=30 mm"}, "balancer.rolls", "state balancer.rolls = false"},
           {{"balancer.ball_diameter=30 mm", "balancer.rolls=false"}, "balancer.contact", "balancer.contact = false"},
           {{"place=[{mass='2 g', radius='100 mm', angle=0}]"}, "place.1.at", "missing"}}) {
    const InputError e = refused([&] { study(r.overrides); });
    EXPECT_EQ(e.key(), r.key) << e.what();
    EXPECT_NE(e.problem().find(r.problem), std::string::npos) << e.what();
  }
  EXPECT_NO_THROW(study({"balancer.ball_diameter=30 mm", "balancer.rolls=false", "balancer.contact=false"}));
  const auto no_mass = refused([] { parse_study("[rotor]\n[rotor.tilt]\nbearings = []\n", "r", {}); });
  EXPECT_EQ(no_mass.key(), "rotor.mass") << no_mass.what();
  const auto flat = refused([] {
    parse_study(
        "[rotor]\nmass='1 kg'\nstiffness='1 N/m'\ndamping_ratio=0.1\n[[place]]\nmass='1 g'\nradius='1 mm'\nangle=0\n"
        "at='3 mm'\n[balancer]\nballs=1\nrace_radius='5 mm'\nmass='1 g'\ndrag='1 N m s'\n[speed]\nspeed='1 rpm'\n",
        "r", {});
  });
  EXPECT_EQ(flat.key(), "place.1.at") << flat.what();
}

// Supports as two numbers, where bearings are not known.
TEST(TiltPhysical, TakesSupportsAsTwoNumbers) {
  const std::string text = fmt::format(
      "[rotor]\nmass='40 kg'\nstiffness=['40 kN/m', '48 kN/m']\ndamping=['900 N s/m', '950 N s/m']\ngravity='9.81 "
      "m/s2'\n"
      "[rotor.tilt]\ntransverse_inertia='2.4 kg m2'\npolar_inertia='1.5 kg m2'\nbearings_at=['15 cm', '-20 cm']\n"
      "stiffness={{x=['-300 N', '1215 N m'], y=['900 N', '1395 N m']}}\n"
      "damping={{x=['-5 N s', '27.25 N m s'], y=['-15 N s', '29.25 N m s']}}\n{}",
      std::string(drum).substr(std::string(drum).find("unbalance = [")));
  EXPECT_EQ(first_difference(study(), parse_study(text, "two"), 1e-13), "");
  for (const auto& [change, problem] : {std::pair{"rotor.tilt.stiffness=['3 N m', '3 N m']", "entry 1"},
                                        {"rotor.tilt.damping=['3 N s']", "must be [\""},
                                        {"rotor.tilt.stiffness={x=['0 N', '5 N m']}", "missing"}}) {
    const InputError e = refused([&] { parse_study(text, "two", {change}); });
    EXPECT_NE(e.problem().find(problem), std::string::npos) << e.what();
  }
}

}  // namespace tilt_physical_test
}  // namespace equipoise
