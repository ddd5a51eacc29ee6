// A study's equations for other integrators: Boost.Odeint over all their pieces agrees with simulate(), their Jacobian
// is their slope, and energy changes by their powers.
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <boost/numeric/odeint.hpp>
#include <gtest/gtest.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "equipoise/simulation/trajectory/study_equations.hpp"
#include "../support/refusals.hpp"
#include "../support/studies.hpp"

namespace equipoise {
namespace study_equations_test {

namespace odeint = boost::numeric::odeint;
using State = std::vector<double>;

const std::string machine = R"([rotor]
eccentricity = 0.02
damping = [0.4, 0.5]
stiffness = [1.0, 1.3]
inertia = 0.4
gravity = 0.02
[balancer]
race_offset = [0.03, -0.02]
balls = 3
mass = [0.03, 0.02, 0.04]
drag = 0.2
rolls = true
ball_radius = [0.1, 0.08, 0.12]
[initial]
psi = 0.3
x = 0.05
y_dot = -0.04
phi = [1.0, 4.0, 5.5]
)";
const std::string plain = rotor_and_balancer + "[initial]\npsi = 0.3\nx = 0.05\ny_dot = -0.04\nphi = [1.0, 4.0]\n";
const std::string ramp = "[speed]\nprofile = \"ramp\"\ninitial = 0.2\nfinal = 2.4\nduration = 20.0\n";
const std::string control = R"([speed]
profile = "torque"
initial = 0.3
torque = { gain = 1.5, integral = 0.2, target = { profile = "ramp", final = 2.4, duration = 12.0 } }
)";

const std::vector<std::pair<std::string, std::string>>& studies() {
  static const std::vector<std::pair<std::string, std::string>> all{
      {"constant", plain + "phi_dot = [0.3, -0.2]\n[speed]\nprofile = \"constant\"\nspeed = 2.4\n"},
      {"held", plain + ramp},
      {"held_published", plain + ramp + "law = \"published\"\n[release]\ntime = 30.0\n"},
      {"free_over_a_jump", plain + ramp + "law = \"published\"\n[release]\ntime = 7.0\n"},
      {"points", plain +
                     "[speed]\nprofile = \"points\"\ntimes = [0, 5, 9, 15]\nspeeds = [0, 2, 1.5, 2.2]\n[release]\ntime "
                     "= 11.0\n"},
      {"machine", machine + ramp + "[release]\nspeed = 1.3\n"},
      {"motor", machine + control},
      {"motor_held", machine + control + "[release]\ntime = 5.5\n"},
      {"motor_of_a_table",
       plain + "[speed]\nprofile = \"torque\"\ntorque = { times = [0, 4, 9], values = [0.3, 0.5, 0.0] }\n"}};
  return all;
}

Study study_of(const std::string& name) {
  for (const auto& [known, text] : studies())
    if (known == name)
      return parse_study(
          text, name,
          known == "motor_of_a_table" ? std::vector<std::string>{"rotor.inertia=2.0"} : std::vector<std::string>{});
  throw InputError("study", "", name, "must be one of those above");
}

// Over one piece, to `end`.
void follow(const StudyEquations& equations, std::size_t piece, double begin, double end, State& y) {
  if (!(begin < end)) return;
  const auto rate = [&](const State& at, State& out, double t) { equations.rhs(piece, t, at.data(), out.data()); };
  odeint::integrate_adaptive(odeint::make_controlled<odeint::runge_kutta_fehlberg78<State>>(1e-12, 1e-12), rate, y,
                             begin, end, 1e-3);
}

// The states at `times`, by Odeint.
Trajectory followed(const StudyEquations& equations, const std::vector<double>& times) {
  Trajectory result;
  State y = equations.initial_state();
  std::size_t piece = 0;
  double t = 0.0;
  for (const double time : times) {
    while (equations.pieces()[piece].end <= time) {
      const double end = equations.pieces()[piece].end;
      follow(equations, piece, t, end, y);
      equations.cross(piece++, y.data());
      t = end;
    }
    follow(equations, piece, t, time, y);
    t = time;
    equations.append(t, y.data(), result);
  }
  return result;
}

// Both integrate to 1e-12 per step; over some tens of units of time the motion magnifies an error by at most a
// thousand.
constexpr double same = 1e-9;

void expect_near(const std::vector<double>& a, const std::vector<double>& b, const char* what) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], same) << what << " of row " << k;
}

void expect_near(const Trajectory& a, const Trajectory& b) {
  for (const auto& [what, values] : {std::pair{"psi", &Trajectory::psi},
                                     {"psi_dot", &Trajectory::psi_dot},
                                     {"x", &Trajectory::x},
                                     {"y", &Trajectory::y},
                                     {"x_dot", &Trajectory::x_dot},
                                     {"y_dot", &Trajectory::y_dot},
                                     {"radial", &Trajectory::radial},
                                     {"bearing_x", &Trajectory::bearing_x},
                                     {"bearing_y", &Trajectory::bearing_y}})
    expect_near(a.*values, b.*values, what);
  ASSERT_EQ(a.phi.size(), b.phi.size());
  for (std::size_t i = 0; i < a.phi.size(); ++i) {
    expect_near(a.phi[i], b.phi[i], "phi");
    expect_near(a.phi_dot[i], b.phi_dot[i], "phi_dot");
  }
}

class Equations : public testing::TestWithParam<std::string> {
 protected:
  Study study = study_of(GetParam());
  StudyEquations equations{study};

  // A state in the middle of each piece, with every component nonzero.
  template <class Look>
  void in_every_piece(const Look& look) const {
    for (std::size_t piece = 0; piece < equations.pieces().size(); ++piece) {
      const StudyEquations::Piece& p = equations.pieces()[piece];
      const double t = std::isfinite(p.end) ? 0.6 * p.begin + 0.4 * p.end : p.begin + 3.0;
      MotionState m;
      m.x = 0.02, m.y = -0.03, m.x_dot = 0.05, m.y_dot = 0.04;
      m.phi = {0.4, 2.0}, m.phi_dot = {0.3, -0.2};
      if (study.parameters.balls == 3) m.phi[2] = 5.0, m.phi_dot[2] = 0.1;
      m.psi = 0.9, m.psi_dot = 1.7, m.speed_error_integral = 0.3;
      SCOPED_TRACE(testing::Message() << "piece " << piece);
      look(piece, t, equations.state(piece, t, m));
    }
  }
};

TEST_P(Equations, FollowedFromElsewhereComeToTheSame) {
  std::vector<double> times;
  for (int k = 0; k <= 12; ++k) times.push_back(2.5 * k);
  expect_near(followed(equations, times), simulate(study, times));
}

// Central differences err by h^2 times third derivatives, some tens here, and by rounding over h: 1e-16 / 1e-5.
TEST_P(Equations, HaveTheirOwnSlopesForAJacobian) {
  const std::size_t size = static_cast<std::size_t>(equations.dimension());
  in_every_piece([&](std::size_t piece, double t, const State& y) {
    State matrix(size * size), above(size), below(size);
    equations.jacobian(piece, t, y.data(), matrix.data());
    for (std::size_t k = 0; k < size; ++k) {
      // Held balls have no rate that could vary.
      if (equations.pieces()[piece].held && equations.variables()[k].name.starts_with("phi_dot")) continue;
      constexpr double h = 1e-5;
      State moved = y;
      moved[k] = y[k] + h;
      equations.rhs(piece, t, moved.data(), above.data());
      moved[k] = y[k] - h;
      equations.rhs(piece, t, moved.data(), below.data());
      for (std::size_t i = 0; i < size; ++i)
        EXPECT_NEAR(matrix[i * size + k], (above[i] - below[i]) / (2.0 * h), 1e-8)
            << equations.variables()[i].name << " by " << equations.variables()[k].name;
    }
  });
}

// dE/dt along the flow, by a central difference along its tangent; errors as above.
TEST_P(Equations, ChangeTheEnergyByTheirPowers) {
  const std::size_t size = static_cast<std::size_t>(equations.dimension());
  in_every_piece([&](std::size_t piece, double t, const State& y) {
    State rate(size), ahead(y), behind(y);
    equations.rhs(piece, t, y.data(), rate.data());
    constexpr double h = 1e-5;
    for (std::size_t i = 0; i < size; ++i) ahead[i] += h * rate[i], behind[i] -= h * rate[i];
    const double change =
        (equations.energy(piece, t + h, ahead.data()) - equations.energy(piece, t - h, behind.data())) / (2.0 * h);
    const model::Powers powers = equations.powers(piece, t, y.data());
    EXPECT_NEAR(change, powers.drive - powers.supports - powers.balls, 1e-8);
    EXPECT_GT(powers.supports, 0.0);
  });
}

TEST_P(Equations, TellStatesAsTrajectoriesDoAndTakeThemBack) {
  EXPECT_EQ(equations.variables().size(), static_cast<std::size_t>(equations.dimension()));
  in_every_piece([&](std::size_t piece, double t, const State& y) {
    const MotionState m = equations.motion(piece, t, y.data());
    const State again = equations.state(piece, t, m);
    for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(again[i], y[i], 1e-15) << equations.variables()[i].name;
    EXPECT_EQ(equations.piece_at(t), piece);
    Trajectory row;
    equations.append(t, y.data(), row);
    EXPECT_EQ(row.x_dot.front(), m.x_dot);
    EXPECT_EQ(row.psi.front(), m.psi);
  });
  const State begin = equations.initial_state();
  const Trajectory first = simulate(study, {0.0});
  EXPECT_EQ(equations.motion(0.0, begin.data()).y_dot, first.y_dot.front());
  EXPECT_EQ(equations.motion(0.0, begin.data()).psi, first.psi.front());
  const std::vector<double> breaks = equations.breakpoints();
  for (std::size_t i = 0; i < breaks.size(); ++i) EXPECT_EQ(equations.piece_at(breaks[i]), i + 1);
}

INSTANTIATE_TEST_SUITE_P(Studies, Equations,
                         testing::Values("constant", "held", "held_published", "free_over_a_jump", "points", "machine",
                                         "motor", "motor_held", "motor_of_a_table"),
                         [](const auto& study) { return study.param; });

// Balls let go at a rotor speed: the time is found by bisection, the rest is a plain study.
TEST(EquationsOfARelease, AtASpeedGoOnFromWhereItIsReached) {
  const Study study = parse_study(machine + control + "[release]\nspeed = 1.3\n", "release");
  const StudyEquations equations(study);
  ASSERT_TRUE(std::isinf(equations.release_time()));
  EXPECT_EQ(equations.release_speed(), 1.3);
  EXPECT_TRUE(equations.pieces().back().held);
  State y = equations.initial_state();
  double low = 0.0, high = 12.0;
  EXPECT_LT(equations.release_distance(y.data()), 0.0);
  while (high - low > 1e-13 * high) {
    const double middle = 0.5 * (low + high);
    State at = y;
    follow(equations, 0, low, middle, at);
    const bool before = equations.release_distance(at.data()) < 0.0;
    if (before) y = at;
    (before ? low : high) = middle;
    if (middle == low && middle == high) break;
  }
  const StudyEquations from_then = equations.released_at(high);
  EXPECT_EQ(from_then.release_time(), high);
  EXPECT_FALSE(from_then.release_speed());
  const std::vector<double> times{1.0, high + 1.0, 20.0};
  expect_near(followed(from_then, times), simulate(study, times));
  EXPECT_THROW(from_then.released_at(2.0), InputError);
  EXPECT_THROW(from_then.release_distance(y.data()), InputError);
  EXPECT_THROW(equations.released_at(-1.0), InputError);
}

TEST(EquationsOfAStudy, SayWhatTheyDoNotHave) {
  const auto key_of = [](const std::vector<std::string>& overrides) {
    return refused_key([&] { StudyEquations{parse_study(constant_speed, "study", overrides)}; });
  };
  EXPECT_EQ(key_of({"balancer.contact_angle=0.2"}), "balancer.contact_angle");
  EXPECT_EQ(key_of({"balancer.rolling=0.01"}), "balancer.rolling");
  EXPECT_EQ(key_of({"balancer.stiction=0.01"}), "balancer.stiction");
  EXPECT_EQ(key_of({"rotor.eccentricity={values=[0.01]}"}), "rotor.eccentricity");
}

}  // namespace study_equations_test
}  // namespace equipoise
