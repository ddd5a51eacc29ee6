// The energy balance dE/dt = torque psi' - dissipation along trajectories, for every case of cases.hpp, and energy,
// torque and dissipation against the fixed-axes formulas of lagrangian.hpp.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "cases.hpp"
#include "equipoise/simulation/integrate/adaptive-inl.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/mechanics/energy.hpp"
#include "equipoise/machine/model/flow-inl.hpp"
#include "equipoise/machine/mechanics/frames.hpp"
#include "equipoise/machine/model/smooth_flow-inl.hpp"
#include "equipoise/machine/model/state_layout.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "lagrangian.hpp"

namespace energy_balance_test {

namespace kernels = equipoise::HWY_NAMESPACE;
namespace model = equipoise::model;
using cases::Case;
using lagrangian::FixedState;

// iota: a rotor whose own spin energy is of the order of the balls'.
constexpr double inertia = 0.3;

// The library's state followed by the works of the drive, the supports' dampers and the ball drag.
class StateAndWork {
 public:
  static constexpr int dimension = model::dimension(model::max_balls) + 3;  // the largest size

  StateAndWork(const model::Parameters& p, const model::Segment& s)
      : p_(p), s_(s), motion_(s), clamped_(p, p.gravity), free_(p, s), n(p.balls), state(model::dimension(n)) {}

  int size() const { return state + 3; }

  void operator()(double t, const double* z, double* dz) const {
    if (s_.clamped) {
      double ux = p_.eccentricity, uy = 0.0;
      for (int i = 0; i < n; ++i) {
        ux += p_.mass[i] * std::cos(z[4 + i]);
        uy += p_.mass[i] * std::sin(z[4 + i]);
      }
      clamped_.derivative(motion_.at(t), {ux, uy}, z, dz);
      std::fill(dz + 4, dz + state, 0.0);
    } else {
      free_(t, z, dz);
    }
    const model::Powers powers = model::powers(p_, inertia, s_, t, z);
    dz[state] = powers.drive;
    dz[state + 1] = powers.supports;
    dz[state + 2] = powers.balls;
  }

 private:
  const model::Parameters& p_;
  const model::Segment& s_;
  kernels::SegmentMotion<double, kernels::Terms{}> motion_;
  kernels::ClampedBody clamped_;
  kernels::FreeFlow<double, model::any_count, kernels::Terms{}> free_;
  const int n, state;
};

FixedState fixed(const model::Parameters& p, const model::Segment& segment, double t, const double* z) {
  FixedState s = lagrangian::in_fixed_axes(p.balls, {segment.psi_at(t), segment.speed_at(t), segment.acceleration_at(t)}, z);
  s.t = t;
  return s;
}

std::vector<double> initial_state(const Case& c, double w, int extra) {
  const int n = c.study.parameters.balls;
  const auto& start = c.study.initial;
  std::vector<double> z(model::dimension(n) + extra, 0.0);
  z[0] = start.x;
  z[1] = start.y;
  z[2] = start.x_dot - w * start.y;
  z[3] = start.y_dot + w * start.x;
  for (int i = 0; i < n; ++i) {
    z[4 + i] = start.phi[i];
    z[4 + n + i] = start.phi_dot[i];
  }
  return z;
}

using At = std::function<void(const model::Segment& segment, double t, const double* z)>;
using Jump = std::function<void(const model::Segment& before, const model::Segment& after, const double* z)>;

// Walks the case's segments to t = 100 with the works: `at` after every accepted step, `jump` between segments with the
// state just before.
void walk(const Case& c, const At& at, const Jump& jump) {
  using System = StateAndWork;
  const model::Parameters& p = c.study.parameters;
  const auto segments = model::segments(c.study.speed_profile(), c.release);
  kernels::ErrorScale<System::dimension> scale;
  scale.tolerance = 1e-13;
  scale.floor.fill(0.01);
  std::vector<double> z = initial_state(c, segments.front().speed, 3);
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const model::Segment& segment = segments[k];
    const double end = std::min(segment.end, 100.0);
    const System system(p, segment);
    kernels::AdaptiveIntegrator<System, System::dimension> integrator(system, scale, system.size());
    at(segment, segment.begin, z.data());
    const auto status = integrator.advance(segment.begin, end, z.data(), [&](double, double t_new, auto&& state_at) {
      double there[System::dimension];
      state_at(t_new, there);
      at(segment, t_new, there);
    });
    ASSERT_EQ(status, equipoise::IntegrationStatus::done);
    if (k + 1 == segments.size()) break;
    jump(segment, segments[k + 1], z.data());
    model::apply_speed_jump(segments[k + 1].speed - segment.speed_at(segment.end), z.data());
  }
}

class EnergyBalance : public testing::TestWithParam<Case> {};

TEST_P(EnergyBalance, ClosesAlongTheTrajectory) {
  const Case& c = GetParam();
  const model::Parameters& p = c.study.parameters;
  const int state = model::dimension(p.balls);
  bool begun = false;
  double start = 0.0, jumps = 0.0, residual = 0.0, size = 0.0;
  walk(
      c,
      [&](const model::Segment& segment, double t, const double* z) {
        const double e = model::energy(p, inertia, segment, t, z);
        if (!begun) start = e;
        begun = true;
        const double work = z[state] - z[state + 1] - z[state + 2];
        residual = std::max(residual, std::fabs(e - start - jumps - work));
        size = std::max({size, std::fabs(e - start), std::fabs(z[state]), z[state + 1] + z[state + 2]});
      },
      [&](const model::Segment& before, const model::Segment& after, const double* z) {
        // Energy of the imposed jump, from the fixed-axes formula on both sides.
        FixedState s = fixed(p, before, before.end, z);
        const double energy_before = lagrangian::energy(p, inertia, s);
        const double jump = after.speed - before.speed_at(before.end);
        lagrangian::apply_speed_jump(jump, s);
        s.rotor.rate += jump;
        jumps += lagrangian::energy(p, inertia, s) - energy_before;
      });
  ASSERT_TRUE(begun);
  RecordProperty("residual", fmt::format("{:.2g}", residual / size));
  // Steps are good to 1e-13 each, and there are up to a thousand of them.
  EXPECT_LT(residual, 1e-10 * size);
}

TEST_P(EnergyBalance, AgreesWithEnergyAndPowersInFixedAxes) {
  const Case& c = GetParam();
  const model::Parameters& p = c.study.parameters;
  double difference = 0.0, size = 0.0;
  const auto compare = [&](double value, double reference) {
    difference = std::max(difference, std::fabs(value - reference));
    size = std::max(size, std::fabs(reference));
  };
  walk(
      c,
      [&](const model::Segment& segment, double t, const double* z) {
        const FixedState s = fixed(p, segment, t, z);
        compare(model::energy(p, inertia, segment, t, z), lagrangian::energy(p, inertia, s));
        const model::Powers powers = model::powers(p, inertia, segment, t, z);
        compare(powers.drive, s.rotor.rate * lagrangian::accelerations(p, inertia, s, segment.clamped).torque);
        compare(powers.supports, p.damping[0] * s.X_dot * s.X_dot + p.damping[1] * s.Y_dot * s.Y_dot);
        double drag = 0.0;
        for (int i = 0; i < p.balls; ++i) drag += p.mass[i] * p.drag[i] * std::pow(s.theta_dot[i] - s.rotor.rate, 2);
        compare(powers.balls, drag);
        const auto force = model::bearing_force(p, segment.psi_at(t), z);
        compare(force[0], p.damping[0] * s.X_dot + p.stiffness[0] * s.X);
        compare(force[1], p.damping[1] * s.Y_dot + p.stiffness[1] * s.Y);
      },
      [](auto&&...) {});
  RecordProperty("largest_difference", fmt::format("{:.2g}", difference / size));
  // Rounding: angles of 250 rad are accurate to 3e-14, and tens of terms are summed.
  EXPECT_LT(difference, 1e-12 * size);
}

INSTANTIATE_TEST_SUITE_P(Case, EnergyBalance, testing::ValuesIn(cases::all()),
                         [](const auto& info) { return info.param.name; });

// A motor, gravity, an off-centre race; its state, psi and psi', and the works of motor, supports and ball drag.
class DrivenAndWork {
 public:
  static constexpr int dimension = model::largest_state + 2;  // the largest size

  explicit DrivenAndWork(const model::System& s) : system_(s), flow_(s, 0.0), state(s.dimension()) {}

  int size() const { return state + 3; }

  void operator()(double t, const double* z, double* dz) const {
    flow_(t, z, dz);
    const model::Parameters& p = system_.parameters();
    const double psi = z[system_.layout().psi], w = z[system_.layout().speed];
    dz[state] = system_.drive().motor.torque(0.0, w, 0.0) * w;
    const auto [Xd, Yd] = model::in_fixed_axes(std::cos(psi), std::sin(psi), z[2], z[3]);
    dz[state + 1] = p.damping[0] * Xd * Xd + p.damping[1] * Yd * Yd;
    dz[state + 2] = 0.0;
    for (int i = 0; i < p.balls; ++i) {
      const double q = z[model::index::q(i, p.balls)];
      dz[state + 2] += p.mass[i] * p.drag[i] * q * q;
    }
  }

 private:
  const model::System& system_;
  kernels::SmoothFlow<double, model::any_count> flow_;
  const int state;
};

// Over ten thousand units, through resonance and beyond.
TEST(EnergyBalanceOfMotors, ClosesOverALongTime) {
  for (const bool rolls : {false, true}) {
    model::Parameters p;
    p.balls = 3;
    p.eccentricity = 0.02;
    p.damping = {0.4, 0.3};
    p.stiffness = {1.0, 1.2};
    p.gravity = 0.02;
    p.inertia = 0.4;
    p.race_offset = {0.01, -0.02};
    p.mass = {0.03, 0.05, 0.02};
    p.drag = {0.2, 0.3, 0.25};
    p.rolls = rolls;
    if (rolls) p.ball_radius = {0.1, 0.3, 0.2};
    model::DrivePiece piece{.prescribed = false};
    piece.motor.constant = 0.3;
    piece.motor.slope = -0.1;
    const model::System system(p, piece);
    const DrivenAndWork flow(system);
    kernels::ErrorScale<DrivenAndWork::dimension> scale;
    scale.tolerance = 1e-13;
    scale.floor.fill(0.01);
    std::vector<double> z(DrivenAndWork::dimension, 0.0);
    for (int i = 0; i < p.balls; ++i) z[model::index::phi(i)] = 1.0 + 2.0 * i;
    const double before = model::full_energy(p, z.data());
    kernels::AdaptiveIntegrator<DrivenAndWork, DrivenAndWork::dimension> integrator(flow, scale, flow.size());
    ASSERT_EQ(integrator.advance(0.0, 1e4, z.data(), [](auto&&...) {}), equipoise::IntegrationStatus::done);
    EXPECT_GT(z[system.layout().speed], 2.0);
    const int state = system.dimension();
    const double change = model::full_energy(p, z.data()) - before;
    RecordProperty(rolls ? "rolls" : "slides",
                   fmt::format("{:.2g}", std::fabs(change - (z[state] - z[state + 1] - z[state + 2])) / z[state]));
    // Relative to the work done, as promised for machines; steps are accurate to 1e-13 each, with errors of both signs.
    EXPECT_NEAR(change, z[state] - z[state + 1] - z[state + 2], 1e-9 * z[state]);
  }
}

// Nodes and weights of Gauss and Legendre on [0, 1], five points.
constexpr double gauss_nodes[] = {0.046910077030668, 0.2307653449471585, 0.5, 0.7692346550528415, 0.953089922969332};
constexpr double gauss_weights[] = {0.118463442528095, 0.2393143352496832, 0.2844444444444444, 0.2393143352496832,
                                    0.118463442528095};

TEST(EnergyBalanceOfSimulate, ClosesOverItsSamples) {
  for (const Case& c : cases::all()) {
    if (c.name.find("everything_3") == std::string::npos) continue;
    const model::Parameters& p = c.study.parameters;
    const auto segments = model::segments(c.study.speed_profile(), c.release);
    // One segment: psi' does not jump and the rule meets no corner.
    const model::Segment& segment = segments.back();
    constexpr int panels = 400;
    constexpr double width = 0.1;  // the rule's relative error, 4e-13 (frequency width)^10, is below rounding
    std::vector<double> times;
    for (int panel = 0; panel < panels; ++panel)
      for (double node : gauss_nodes) times.push_back(segment.begin + (panel + node) * width);
    times.push_back(segment.begin + panels * width);
    times.insert(times.begin(), segment.begin);
    const equipoise::Trajectory run = equipoise::simulate(c.study, times);
    ASSERT_EQ(run.t, times);

    const int n = p.balls;
    const auto state = [&](std::size_t k) {
      std::vector<double> z{run.x[k], run.y[k], run.x_dot[k] - run.psi_dot[k] * run.y[k],
                            run.y_dot[k] + run.psi_dot[k] * run.x[k]};
      for (int i = 0; i < n; ++i) z.push_back(run.phi[i][k]);
      for (int i = 0; i < n; ++i) z.push_back(run.phi_dot[i][k]);
      return z;
    };
    double work = 0.0, throughput = 0.0;
    for (std::size_t k = 1; k + 1 < times.size(); ++k) {
      const model::Powers powers = model::powers(p, inertia, segment, times[k], state(k).data());
      const double weight = gauss_weights[(k - 1) % 5] * width;
      work += weight * (powers.drive - powers.supports - powers.balls);
      throughput += weight * (powers.supports + powers.balls);
    }
    const double change = model::energy(p, inertia, segment, times.back(), state(times.size() - 1).data()) -
                          model::energy(p, inertia, segment, times.front(), state(0).data());
    RecordProperty(c.name, fmt::format("{:.2g}", std::fabs(change - work) / throughput));
    // simulate() promises 1e-9 for each variable over 100 time units; energies inherit it.
    EXPECT_NEAR(change, work, 1e-9 * throughput) << c.name;
  }
}

}  // namespace energy_balance_test
