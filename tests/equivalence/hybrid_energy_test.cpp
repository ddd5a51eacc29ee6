// Energy with contact and dry friction: a motor's work is what dampers, drag, rolling resistance and impacts dissipate
// plus what is stored. Elastic balls keep energy; plastic ones stay together until they would have to pull.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "equipoise/simulation/integrate/event_trajectory-inl.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/machine/mechanics/energy.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/state_layout.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"

namespace hybrid_energy_test {

using namespace equipoise;
namespace kernels = HWY_NAMESPACE;
using Machine = kernels::EventTrajectory<model::any_count>;
using Flow = kernels::HybridFlow<double, model::any_count>;

// Power dissipated by a rotor, from forces written down in this file except for accelerations.
struct Powers {
  double motor = 0.0, taken = 0.0;
};

class Balance {
 public:
  explicit Balance(const Study& study) : p(study.parameters), n(p.balls), drive(study.drive()), modes(p) {}

  // Signs are those of the rates: between events no ball changes direction.
  Powers powers(double t, const double* z) {
    const model::StateLayout at = model::machine_layout(n);
    const double w = z[at.speed], c = std::cos(z[at.psi]), s = std::sin(z[at.psi]);
    const double X = z[2] * c - z[3] * s, Y = z[2] * s + z[3] * c;
    model::BallMode mode;
    for (int i = 0; i < n; ++i) {
      const double q = z[model::index::q(i, n)];
      mode.sense[i] = (q > 0.0) - (q < 0.0);
      mode.held[i] = q == 0.0;
    }
    modes.set(mode);
    const Flow flow(p, drive.pieces.back(), &modes);
    double dz[Flow::dimension];
    kernels::BallForces<double, model::any_count> forces;
    flow.evaluate(t, z, dz, forces);
    Powers sum{drive.pieces.back().motor.torque(t, w, 0.0) * w, p.damping[0] * X * X + p.damping[1] * Y * Y};
    for (int i = 0; i < n; ++i) {
      const double q = z[model::index::q(i, n)];
      sum.taken += p.mass[i] * (p.drag[i] * q * q + p.rolling[i] * std::fabs(forces.normal[i] * q));
    }
    return sum;
  }

  // At an impact of two balls: their relative rate before it and everything involved, in coordinates X, Y, psi, theta.
  double taken_by_impact(const double* z) const {
    const double psi = z[model::machine_layout(n).psi], lambda = p.eccentricity;
    Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(5, 5);
    mass(0, 0) = mass(1, 1) = 1.0 + p.total_mass();
    mass(2, 2) = p.inertia + lambda * lambda;
    mass(0, 2) = mass(2, 0) = -lambda * std::sin(psi);
    mass(1, 2) = mass(2, 1) = lambda * std::cos(psi);
    for (int i = 0; i < 2; ++i) {
      const double theta = psi + z[4 + i];
      mass(0, 3 + i) = mass(3 + i, 0) = -p.mass[i] * std::sin(theta);
      mass(1, 3 + i) = mass(3 + i, 1) = p.mass[i] * std::cos(theta);
      mass(3 + i, 3 + i) = p.mass[i];
    }
    Eigen::VectorXd apart = Eigen::VectorXd::Zero(5);
    apart[3] = -1.0;
    apart[4] = 1.0;
    const double rate = z[7] - z[6], e = p.restitution;
    return 0.5 * (1.0 - e * e) * rate * rate / apart.dot(mass.ldlt().solve(apart));
  }

  const model::Parameters& p;
  const int n;
  const model::Drive drive;
  kernels::ModeTable<double, model::any_count> modes;
};

Machine::Scale tight(const model::Parameters& p, double tolerance) {
  Machine::Scale scale;
  scale.tolerance = tolerance;
  scale.floor.fill(1.0);
  for (int i = 0; i < 4; ++i) scale.floor[i] = p.all_unbalances();
  scale.absolute.fill(true);
  scale.angle.fill(true);
  return scale;
}

// Nodes and weights of Gauss and Legendre's rule of order 10 on [0, 1].
constexpr double nodes[] = {0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842, 0.953089922969332};
constexpr double weights[] = {0.118463442528095, 0.239314335249683, 0.284444444444444, 0.239314335249683,
                              0.118463442528095};

void balances(const std::string& more, double drag) {
  const Study study = parse_study(
      "[rotor]\neccentricity = 0.02\ninertia = 4.0\ngravity = 0.05\nstiffness = [1.0, 1.3]\ndamping = "
      "0.1\n[balancer]\nballs = 2\nmass = [0.05, 0.03]\ndrag = " +
          std::to_string(drag) + "\n" + more +
          "[speed]\nprofile = \"torque\"\ninitial = 1.5\ntorque = { constant = 0.2, slope = -0.1 }\n" +
          "[initial]\nphi = [1.0, 4.0]\nphi_dot = [1.0, -1.0]\n",
      "balance");
  const model::Parameters& p = study.parameters;
  Balance balance(study);
  double z[Machine::dimension];
  initial_state(study.initial, p.balls, balance.drive.speed, z);
  Machine machine(p, balance.drive, tight(p, 1e-12), z);
  double work = 0.0, taken = 0.0, impacts = 0.0;
  double last[Machine::dimension];
  std::copy(machine.state(), machine.state() + Machine::dimension, last);
  const double before = model::full_energy(p, last);
  const auto watch = [&](double from, double to, auto&& state_at) {
    double at[Machine::dimension];
    state_at(from, at);
    // A jump of both rates is an impact; where a ball stops its rate jumps only by rounding.
    if (std::fabs((at[7] - at[6]) - (last[7] - last[6])) > 1e-7) impacts += balance.taken_by_impact(last);
    for (int k = 0; k < 5; ++k) {
      state_at(from + nodes[k] * (to - from), at);
      const Powers now = balance.powers(from + nodes[k] * (to - from), at);
      work += weights[k] * (to - from) * now.motor;
      taken += weights[k] * (to - from) * now.taken;
    }
    state_at(to, last);
    return false;
  };
  ASSERT_EQ(machine.advance(1e4, watch), IntegrationStatus::done);
  const double stored = model::full_energy(p, machine.state()) - before;
  // Rounding, and errors of 1e-12 in each of about 1e5 steps, of both signs.
  EXPECT_NEAR(work, taken + impacts + stored, 1e-9 * work);
  EXPECT_GT(machine.events(), 100);
  if (p.balls_collide() && p.restitution < 1.0) {
    EXPECT_GT(impacts, 1e-6 * work) << "or the balance does not feel them";
  }
}

TEST(HybridEnergy, OfContactUnderAMotorBalances) { balances("contact_angle = 0.7\nrestitution = 0.8\n", 0.02); }
TEST(HybridEnergy, OfFrictionUnderAMotorBalances) { balances("rolling = 0.003\nstiction = 0.005\n", 0.3); }
TEST(HybridEnergy, OfContactAndFrictionUnderAMotorBalances) {
  balances("contact_angle = 0.7\nrestitution = 0.8\nrolling = 0.003\nstiction = 0.005\n", 0.02);
}

// On lanes, with nothing that dissipates energy.
TEST(HybridEnergy, OfElasticBallsIsKeptOnLanes) {
  for (const int balls : {2, 4}) {
    const Study study = parse_study(
        "[rotor]\neccentricity = 0.02\ninertia = 4.0\ndamping = 0.0\ngravity = 0.01\n[balancer]\nballs = " +
            std::to_string(balls) +
            "\nmass = 0.05\ndrag = 0.0\ncontact_angle = 0.5\nrestitution = 1.0\n[speed]\nprofile = \"torque\"\ninitial "
            "= 2.0\ntorque = { constant = 0.0 }\n[sampling]\nstarts = 8\n[sampling.box]\nphi_dot = [-1.5, 1.5]\n",
        "elastic");
    const model::System system = study.system();
    constexpr std::size_t count = 8;
    const auto size = static_cast<std::size_t>(system.dimension());
    std::vector<double> states(count * size);
    const auto energy = [&](const double* y) {
      std::vector<double> z(y, y + model::dimension(balls));
      z.push_back(y[system.layout().psi]);
      z.push_back(y[system.layout().speed]);
      z.push_back(0.0);
      return model::full_energy(study.parameters, z.data());
    };
    std::vector<double> before;
    for (std::size_t i = 0; i < count; ++i) {
      double* state = &states[i * size];
      initial_state(start_of(study, 1, i), balls, 2.0, state);
      state[system.layout().psi] = 0.0;
      state[system.layout().speed] = 2.0;
      before.push_back(energy(state));
    }
    BatchTask task = batch_task(system);
    BatchWork work;
    task.end = 300.0;
    task.tolerance = 1e-12;
    task.count = count;
    task.states = states.data();
    task.work = &work;
    std::vector<Outcome> outcomes(count);
    ASSERT_TRUE(advance_batch(task, outcomes));
    EXPECT_GT(work.events, 50 * count);
    // Some thousand steps of 1e-12 each, for energies of about 8.
    for (std::size_t i = 0; i < count; ++i) EXPECT_NEAR(energy(&states[i * size]), before[i], 1e-9 * before[i]) << i;
  }
}

}  // namespace hybrid_energy_test
