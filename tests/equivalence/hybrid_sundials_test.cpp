// Lanes with contact and with stiction against Lagrange's equations in fixed axes, integrated by SUNDIALS with its own
// root-finding: two balls that collide, and one that sticks until gravity shakes it loose.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <arkode/arkode_erkstep.h>
#include <cmath>
#include <functional>
#include <nvector/nvector_serial.h>
#include <stdexcept>
#include <vector>

#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "lagrangian.hpp"

namespace hybrid_sundials_test {

using namespace equipoise;

// A system whose right-hand side changes at a root.
struct Problem {
  std::function<void(double, const double*, double*)> rates;
  std::function<double(double, const double*)> root;
};

int rates_of(double t, N_Vector y, N_Vector dy, void* data) {
  static_cast<Problem*>(data)->rates(t, N_VGetArrayPointer(y), N_VGetArrayPointer(dy));
  return 0;
}
int root_of(double t, N_Vector y, double* g, void* data) {
  *g = static_cast<Problem*>(data)->root(t, N_VGetArrayPointer(y));
  return 0;
}
void check(int flag) {
  if (flag < 0) throw std::runtime_error("SUNDIALS returned " + std::to_string(flag));
}

// Follows to `end`; at_root(t, y) changes the state or the problem where its root function passes 0.
void follow(Problem& problem, std::vector<double>& y, double end, const std::function<void(double, double*)>& at_root) {
  SUNContext context = nullptr;
  check(SUNContext_Create(nullptr, &context));
  N_Vector v = N_VNew_Serial(static_cast<sunindextype>(y.size()), context);
  std::copy(y.begin(), y.end(), N_VGetArrayPointer(v));
  void* memory = ERKStepCreate(rates_of, 0.0, v, context);
  check(ERKStepSetTableNum(memory, ARKODE_FEHLBERG_13_7_8));
  check(ERKStepSStolerances(memory, 0.0, 1e-13));
  check(ERKStepSetUserData(memory, &problem));
  check(ERKStepSetMaxNumSteps(memory, 10'000'000));
  check(ERKStepSetMaxStep(memory, 0.01));  // its interpolation, which locates roots, is of low order
  check(ERKStepRootInit(memory, 1, root_of));
  double t = 0.0;
  for (;;) {
    const int flag = ERKStepEvolve(memory, end, v, &t, ARK_NORMAL);
    check(flag);
    if (flag != ARK_ROOT_RETURN) break;
    at_root(t, N_VGetArrayPointer(v));
    check(ERKStepReInit(memory, rates_of, t, v));
  }
  std::copy_n(N_VGetArrayPointer(v), y.size(), y.begin());
  ERKStepFree(&memory);
  N_VDestroy(v);
  SUNContext_Free(&context);
}

// One start, at constant speed from [initial], on lanes.
std::vector<double> on_lanes(const Study& study, double end, std::uint64_t& events) {
  const model::System system = study.system();
  std::vector<double> z(system.dimension());
  initial_state(study.initial, system.balls(), system.speed(), z.data());
  BatchTask task = batch_task(system);
  BatchWork work;
  task.end = end;
  task.tolerance = 1e-11;
  task.count = 1;
  task.states = z.data();
  task.work = &work;
  std::vector<Outcome> outcomes(1);
  EXPECT_EQ(task.kind(), BatchKind::hybrid);
  EXPECT_TRUE(advance_batch(task, outcomes));
  events = work.events;
  return z;
}

// Vector: X, Y, theta_i, then their rates.
class FixedAxes {
 public:
  explicit FixedAxes(const Study& study) : p(study.parameters), speed(study.speed.speed), n(p.balls) {}

  lagrangian::FixedState state(double t, const double* y) const {
    lagrangian::FixedState s;
    s.rotor = {speed * t, speed, 0.0};
    lagrangian::unpack(y, n, s);
    return s;
  }
  void rates(double t, const double* y, double* dy, bool held) const { lagrangian::rates(p, state(t, y), held, y, dy); }
  std::vector<double> start(const Study& study) const {
    const auto& at = study.initial;
    std::vector<double> y{at.x, at.y};
    for (int i = 0; i < n; ++i) y.push_back(at.phi[i]);
    y.push_back(at.x_dot - speed * at.y);
    y.push_back(at.y_dot + speed * at.x);
    for (int i = 0; i < n; ++i) y.push_back(speed + at.phi_dot[i]);
    return y;
  }
  void expect_same(const std::vector<double>& z, double t, const std::vector<double>& y, double accuracy) const {
    const auto fixed = lagrangian::in_fixed_axes(n, {speed * t, speed, 0.0}, z.data());
    EXPECT_NEAR(fixed.X, y[0], accuracy * p.all_unbalances());
    EXPECT_NEAR(fixed.Y, y[1], accuracy * p.all_unbalances());
    for (int i = 0; i < n; ++i) {
      EXPECT_NEAR(fixed.theta[i], y[2 + i], accuracy) << i;
      EXPECT_NEAR(fixed.theta_dot[i], y[4 + n + i], accuracy) << i;
    }
  }

  const model::Parameters& p;
  const double speed;
  const int n;
};

const std::string rotor =
    "[rotor]\neccentricity = 0.02\ndamping = [0.4, 0.3]\nstiffness = [1.0, 1.3]\ngravity = 0.02\n[speed]\nprofile = "
    "\"constant\"\nspeed = 2.0\n";

// Lanes err by 1e-11 in each of a few hundred steps; SUNDIALS errs by its roots, found to 1e-13 by interpolation
// between steps of 0.01. Impacts multiply both by about ten each.
constexpr double accuracy = 1e-6;

TEST(HybridSundials, TwoBallsCollide) {
  const Study study = parse_study(rotor +
                                      "[balancer]\nballs = 2\nmass = [0.05, 0.03]\ndrag = 0.1\ncontact_angle = "
                                      "0.8\nrestitution = 0.7\n[initial]\nphi = [1.0, 2.2]\nphi_dot = [0.6, -0.5]\n",
                                  "contact");
  const FixedAxes axes(study);
  const model::Parameters& p = axes.p;
  constexpr double end = 12.0;
  std::vector<double> y = axes.start(study);
  Problem problem;
  problem.rates = [&](double t, const double* at, double* dy) { axes.rates(t, at, dy, false); };
  problem.root = [&](double, const double* at) { return std::cos(at[3] - at[2]) - std::cos(p.contact_angle); };
  int impacts = 0;
  follow(problem, y, end, [&](double, double* at) {
    // Momentum of X, Y and both balls, in their own mass matrix; +1 for the leading ball.
    Eigen::Matrix4d mass = Eigen::Matrix4d::Zero();
    mass(0, 0) = mass(1, 1) = 1.0 + p.total_mass();
    for (int i = 0; i < 2; ++i) {
      mass(0, 2 + i) = mass(2 + i, 0) = -p.mass[i] * std::sin(at[2 + i]);
      mass(1, 2 + i) = mass(2 + i, 1) = p.mass[i] * std::cos(at[2 + i]);
      mass(2 + i, 2 + i) = p.mass[i];
    }
    const double ahead = std::sin(at[3] - at[2]) > 0.0 ? 1.0 : -1.0;
    const Eigen::Vector4d apart(0.0, 0.0, -ahead, ahead), response = mass.ldlt().solve(apart);
    Eigen::Map<Eigen::Vector4d> rates(at + 4);
    if (apart.dot(rates) > 0.0) return;  // parting already
    ++impacts;
    rates -= (1.0 + p.restitution) * apart.dot(rates) / apart.dot(response) * response;
  });
  EXPECT_GE(impacts, 2);
  std::uint64_t events = 0;
  const std::vector<double> z = on_lanes(study, end, events);
  EXPECT_EQ(events, static_cast<std::uint64_t>(impacts));
  axes.expect_same(z, end, y, accuracy);
}

TEST(HybridSundials, OneBallSticks) {
  const Study study = parse_study(rotor +
                                      "[balancer]\nballs = 1\nmass = 0.05\ndrag = 3.0\nrolling = 0.0\nstiction = "
                                      "0.01\n[initial]\nphi = [1.0]\n",
                                  "stiction", {"rotor.gravity=0.06"});
  const FixedAxes axes(study);
  const model::Parameters& p = axes.p;
  constexpr double end = 25.0;
  std::vector<double> y = axes.start(study);
  const auto hold = [&](double t, const double* at) {  // what friction could still hold, for a ball at rest
    const auto a = lagrangian::accelerations(p, 0.0, axes.state(t, at), true);
    const double s = std::sin(at[2]), c = std::cos(at[2]), w = axes.speed;
    const double x = a.X - w * w * c, y2 = a.Y - w * w * s + p.gravity;  // without its weight
    return p.stiction[0] * std::fabs(x * c + y2 * s) - std::fabs(y2 * c - x * s);
  };
  bool held = hold(0.0, y.data()) > 0.0;
  Problem problem;
  problem.rates = [&](double t, const double* at, double* dy) { axes.rates(t, at, dy, held); };
  problem.root = [&](double t, const double* at) { return held ? hold(t, at) : at[5] - axes.speed; };
  int starts = 0;
  follow(problem, y, end, [&](double t, double* at) {
    if (held) {
      held = false;
      ++starts;
    } else {
      at[5] = axes.speed;
      held = hold(t, at) > 0.0;
    }
  });
  EXPECT_GE(starts, 3);
  std::uint64_t events = 0;
  const std::vector<double> z = on_lanes(study, end, events);
  EXPECT_GT(events, static_cast<std::uint64_t>(starts));
  axes.expect_same(z, end, y, accuracy);
}

}  // namespace hybrid_sundials_test
