// Symmetries and identities of the equations on random rotors, starts and speeds (RapidCheck).
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <utility>
#include <vector>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/simulation/integrate/adaptive-inl.hpp"
#include "equipoise/simulation/integrate/clamped.hpp"
#include "equipoise/machine/mechanics/energy.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/flow-inl.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"

namespace symmetry_test {

namespace kernels = equipoise::HWY_NAMESPACE;
namespace model = equipoise::model;
using equipoise::Profile;
using equipoise::Study;
using equipoise::Trajectory;
using model::SpeedLaw;

// The same cases on every run and machine (RapidCheck would seed itself from the clock); read before the first check.
// RC_PARAMS in the environment overrides it.
[[maybe_unused]] const int fixed_seed = setenv("RC_PARAMS", "seed=20190417 max_success=100", 0);

double between(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1'000'001) / 1e6; }
bool coin() { return *rc::gen::arbitrary<bool>(); }

model::Parameters random_rotor(bool isotropic_without_gravity) {
  model::Parameters p;
  p.balls = *rc::gen::inRange(1, 9);
  p.eccentricity = between(0.0, 0.05);
  p.damping[0] = between(0.2, 0.8);
  p.stiffness[0] = between(0.7, 1.5);
  p.damping[1] = isotropic_without_gravity ? p.damping[0] : between(0.2, 0.8);
  p.stiffness[1] = isotropic_without_gravity ? p.stiffness[0] : between(0.7, 1.5);
  p.gravity = isotropic_without_gravity ? 0.0 : between(0.0, 0.05);
  for (int i = 0; i < p.balls; ++i) {
    p.mass[i] = between(0.01, 0.06);
    p.drag[i] = between(0.1, 0.4);
  }
  p.rolls = coin();
  for (int i = 0; i < p.balls && p.rolls; ++i) p.ball_radius[i] = between(0.0, 0.5);
  return p;
}

// A constant speed or a ramp under either law; balls free at once, or released on or after the ramp.
Study random_study(bool isotropic_without_gravity = false) {
  Study s;
  s.parameters = random_rotor(isotropic_without_gravity);
  s.speed.speed = between(-3.0, 3.0);
  if (coin()) {
    s.speed.profile = Profile::ramp;
    s.speed.initial = between(-1.0, 1.0);
    s.speed.final = between(1.5, 3.0);
    s.speed.duration = between(1.0, 10.0);
    s.speed.law = coin() ? SpeedLaw::kinematic : SpeedLaw::published;
  }
  s.release.time = coin() ? 0.0 : between(0.1, 12.0);
  s.initial.psi = between(-3.0, 3.0);
  s.initial.x = between(-0.1, 0.1);
  s.initial.y = between(-0.1, 0.1);
  s.initial.x_dot = between(-0.1, 0.1);
  s.initial.y_dot = between(-0.1, 0.1);
  for (int i = 0; i < s.parameters.balls; ++i) {
    s.initial.phi[i] = between(-4.0, 4.0);
    if (*s.release.time == 0.0) s.initial.phi_dot[i] = between(-1.0, 1.0);
  }
  return s;
}

const std::vector<double> times{0.0, 1.0, 2.5, 5.0, 9.9, 14.0, 18.0};

// Two runs of the same motion differ by rounding and by where their steps end: 1e-12 per step. Neighbouring
// trajectories separate by less than a factor of 100 in 18 time units.
constexpr double same = 1e-10;

double difference(const std::vector<double>& a, const std::vector<double>& b, double shift = 0.0, double sign = 1.0) {
  RC_ASSERT(a.size() == times.size());
  RC_ASSERT(b.size() == times.size());
  double result = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) result = std::max(result, std::fabs(sign * b[k] - a[k] - shift));
  return result;
}

RC_GTEST_PROP(Trajectories, AreExchangedWhenEqualBallsAre, ()) {
  Study s = random_study();
  auto& p = s.parameters;
  p.balls = std::max(p.balls, 2);
  const int i = *rc::gen::inRange(0, p.balls), j = (i + *rc::gen::inRange(1, p.balls)) % p.balls;
  for (int k = 0; k < p.balls; ++k)
    if (p.mass[k] == 0.0) p.mass[k] = 0.03;
  p.mass[j] = p.mass[i];
  p.drag[j] = p.drag[i];
  p.ball_radius[j] = p.ball_radius[i];
  const Trajectory a = equipoise::simulate(s, times);
  std::swap(s.initial.phi[i], s.initial.phi[j]);
  std::swap(s.initial.phi_dot[i], s.initial.phi_dot[j]);
  Trajectory b = equipoise::simulate(s, times);
  std::swap(b.phi[i], b.phi[j]);
  std::swap(b.phi_dot[i], b.phi_dot[j]);
  RC_ASSERT(difference(a.x, b.x) < same);
  RC_ASSERT(difference(a.y, b.y) < same);
  for (int k = 0; k < p.balls; ++k) {
    RC_ASSERT(difference(a.phi[k], b.phi[k]) < same);
    RC_ASSERT(difference(a.phi_dot[k], b.phi_dot[k]) < same);
  }
}

RC_GTEST_PROP(Trajectories, ShiftOneAngleOnlyWhenABallStartsATurnFurther, ()) {
  Study s = random_study();
  const int shifted = *rc::gen::inRange(0, s.parameters.balls);
  const Trajectory a = equipoise::simulate(s, times);
  s.initial.phi[shifted] += equipoise::two_pi;
  const Trajectory b = equipoise::simulate(s, times);
  RC_ASSERT(difference(a.x, b.x) < same);
  RC_ASSERT(difference(a.y_dot, b.y_dot) < same);
  for (int k = 0; k < s.parameters.balls; ++k) {
    RC_ASSERT(difference(a.phi[k], b.phi[k], k == shifted ? equipoise::two_pi : 0.0) < same);
    RC_ASSERT(difference(a.phi_dot[k], b.phi_dot[k]) < same);
  }
}

RC_GTEST_PROP(Trajectories, DoNotDependOnWhereTheRotorStartsOnIsotropicSupportsWithoutGravity, ()) {
  Study s = random_study(true);
  const Trajectory a = equipoise::simulate(s, times);
  const double turn = between(-3.0, 3.0);
  s.initial.psi += turn;
  const Trajectory b = equipoise::simulate(s, times);
  RC_ASSERT(difference(a.psi, b.psi, turn) < same);
  RC_ASSERT(difference(a.x, b.x) < same);
  RC_ASSERT(difference(a.y, b.y) < same);
  for (int k = 0; k < s.parameters.balls; ++k) RC_ASSERT(difference(a.phi[k], b.phi[k]) < same);
}

RC_GTEST_PROP(Trajectories, AreMirroredWhenEverythingTurnsTheOtherWay, ()) {
  Study s = random_study(true);
  const Trajectory a = equipoise::simulate(s, times);
  for (double* value :
       {&s.speed.speed, &s.speed.initial, &s.speed.final, &s.initial.psi, &s.initial.y, &s.initial.y_dot})
    *value = -*value;
  for (double& angle : s.initial.phi) angle = -angle;
  for (double& rate : s.initial.phi_dot) rate = -rate;
  const Trajectory b = equipoise::simulate(s, times);
  RC_ASSERT(difference(a.x, b.x) < same);
  RC_ASSERT(difference(a.y, b.y, 0.0, -1.0) < same);
  RC_ASSERT(difference(a.bearing_y, b.bearing_y, 0.0, -1.0) < same);
  for (int k = 0; k < s.parameters.balls; ++k) RC_ASSERT(difference(a.phi[k], b.phi[k], 0.0, -1.0) < same);
}

RC_GTEST_PROP(Trajectories, TurnWithTheirStartIfTheRotorHasNoUnbalance, ()) {
  Study s = random_study(true);
  s.parameters.eccentricity = 0.0;
  const Trajectory a = equipoise::simulate(s, times);
  const double angle = between(-3.0, 3.0);
  const std::complex<double> turn = std::polar(1.0, angle);
  const auto rotate = [&](double& x, double& y) {
    const auto z = turn * std::complex<double>(x, y);
    x = z.real();
    y = z.imag();
  };
  rotate(s.initial.x, s.initial.y);
  rotate(s.initial.x_dot, s.initial.y_dot);
  for (double& phi : s.initial.phi) phi += angle;
  const Trajectory b = equipoise::simulate(s, times);
  RC_ASSERT(difference(a.radial, b.radial) < same);
  for (std::size_t k = 0; k < times.size(); ++k) {
    double x = a.x[k], y = a.y[k];
    rotate(x, y);
    RC_ASSERT(std::hypot(x - b.x[k], y - b.y[k]) < same);
  }
  for (int k = 0; k < s.parameters.balls; ++k) RC_ASSERT(difference(a.phi[k], b.phi[k], angle) < same);
}

RC_GTEST_PROP(Trajectories, AreTheSameFromARampAndFromPointsWithItsCorners, ()) {
  Study s = random_study();
  if (coin()) {
    s.speed.profile = Profile::ramp;
    s.speed.duration = between(1.0, 10.0);
    s.speed.times = {0.0, s.speed.duration};
    s.speed.speeds = {s.speed.initial, s.speed.final};
  } else {
    s.speed.profile = Profile::trapezoid;
    s.speed.peak = between(2.0, 3.0);
    s.speed.rise_until = between(1.0, 5.0);
    s.speed.hold_until = s.speed.rise_until + between(1.0, 5.0);
    s.speed.fall_until = s.speed.hold_until + between(1.0, 5.0);
    s.speed.times = {0.0, s.speed.rise_until, s.speed.hold_until, s.speed.fall_until};
    s.speed.speeds = {s.speed.initial, s.speed.peak, s.speed.peak, s.speed.final};
  }
  const Trajectory a = equipoise::simulate(s, times);
  s.speed.profile = Profile::points;
  const Trajectory b = equipoise::simulate(s, times);
  // The same numbers run through the same code: not even rounding differs.
  RC_ASSERT(a.psi == b.psi);
  RC_ASSERT(a.x == b.x);
  RC_ASSERT(a.y_dot == b.y_dot);
  RC_ASSERT(a.phi == b.phi);
}

RC_GTEST_PROP(Energy, ChangesAtTheRateItsPowersSayInAnyState, ()) {
  const model::Parameters p = random_rotor(false);
  const double inertia = between(0.0, 1.0), t = between(0.0, 5.0);
  const model::Segment segment{0.0, 10.0, between(-3.0, 3.0), between(-4.0, 4.0), between(-0.5, 0.5), coin()};
  const int n = p.balls, size = model::dimension(n);
  constexpr int most = model::dimension(model::max_balls);
  double z[most], rate[most] = {};
  for (int i = 0; i < size; ++i) z[i] = between(-1.0, 1.0);
  if (segment.clamped) {
    std::fill(z + 4 + n, z + size, 0.0);
    double ux = p.eccentricity, uy = 0.0;
    for (int i = 0; i < n; ++i) {
      ux += p.mass[i] * std::cos(z[4 + i]);
      uy += p.mass[i] * std::sin(z[4 + i]);
    }
    const kernels::SegmentMotion<double, kernels::Terms{}> motion(segment);
    kernels::ClampedBody(p, p.gravity).derivative(motion.at(t), {ux, uy}, z, rate);
  } else {
    kernels::FreeFlow<double, model::any_count, kernels::Terms{}>(p, segment)(t, z, rate);
  }
  // dE/dt along (z + s dz/dt, t + s) by central differences of sixth order; truncation and rounding below 1e-12.
  const double step = 2e-3, weights[] = {45.0 / 60.0, -9.0 / 60.0, 1.0 / 60.0};
  const auto energy_at = [&](double s) {
    double moved[most];
    for (int i = 0; i < size; ++i) moved[i] = z[i] + s * rate[i];
    return model::energy(p, inertia, segment, t + s, moved);
  };
  double change = 0.0, size_of_terms = 1.0;
  for (int k = 1; k <= 3; ++k) change += weights[k - 1] / step * (energy_at(k * step) - energy_at(-k * step));
  const model::Powers powers = model::powers(p, inertia, segment, t, z);
  size_of_terms += std::fabs(powers.drive) + powers.supports + powers.balls;
  RC_ASSERT(std::fabs(change - (powers.drive - powers.supports - powers.balls)) < 1e-11 * size_of_terms);
  if (segment.clamped) RC_ASSERT(powers.balls == 0.0);
}

template <int n>
void expect_the_same_with_room_for_any(const model::Segment& segment, double t) {
  model::Parameters p = random_rotor(false);
  p.balls = n;
  for (int i = 0; i < n; ++i) {
    p.mass[i] = between(0.01, 0.2);
    p.drag[i] = between(0.0, 0.5);
    p.ball_radius[i] = between(0.0, 0.5);
  }
  double z[model::dimension(n)], exact[model::dimension(n)], any[model::dimension(model::max_balls)];
  for (double& v : z) v = between(-1.0, 1.0);
  kernels::FreeFlow<double, n, kernels::Terms{}>(p, segment)(t, z, exact);
  kernels::FreeFlow<double, model::any_count, kernels::Terms{}>(p, segment)(t, z, any);
  for (int i = 0; i < model::dimension(n); ++i) RC_ASSERT(exact[i] == any[i]);
}

RC_GTEST_PROP(Equations, HaveTheSameBitsCompiledForACountAndForAny, ()) {
  const double t = between(0.0, 5.0);
  const model::Segment segment{0.0, 10.0, between(-3.0, 3.0), between(-4.0, 4.0), between(-0.5, 0.5), false};
  expect_the_same_with_room_for_any<1>(segment, t);
  expect_the_same_with_room_for_any<2>(segment, t);
  expect_the_same_with_room_for_any<4>(segment, t);
  expect_the_same_with_room_for_any<7>(segment, t);
}

// Balls held at fixed angles, integrated without superposition.
struct ClampedFlow {
  kernels::ClampedBody body;
  kernels::SegmentMotion<double, kernels::Terms{}> motion;
  kernels::Vector2<double> unbalance;
  void operator()(double t, const double* z, double* dz) const { body.derivative(motion.at(t), unbalance, z, dz); }
};

RC_GTEST_PROP(ClampedSuperposition, EqualsDirectIntegration, ()) {
  Study s = random_study();
  const model::Parameters& p = s.parameters;
  const double release = between(1.0, 15.0);
  const auto all = model::segments(s.speed_profile(), release);
  std::array<double, 4> z{between(-0.1, 0.1), between(-0.1, 0.1), between(-0.1, 0.1), between(-0.1, 0.1)};
  equipoise::ClampedBasis basis;
  RC_ASSERT(equipoise::integrate_clamped(p, all, z, 1e-12, basis) == equipoise::IntegrationStatus::done);
  double superposed[4];
  basis.centre(p, s.initial.phi.data(), superposed);

  double ux = p.eccentricity, uy = 0.0;
  for (int i = 0; i < p.balls; ++i) {
    ux += p.mass[i] * std::cos(s.initial.phi[i]);
    uy += p.mass[i] * std::sin(s.initial.phi[i]);
  }
  kernels::ErrorScale<4> scale;
  scale.tolerance = 1e-12;
  scale.floor.fill(1e-3);
  for (std::size_t k = 0; all[k].clamped; ++k) {
    const ClampedFlow flow{
        kernels::ClampedBody(p, p.gravity), kernels::SegmentMotion<double, kernels::Terms{}>(all[k]), {ux, uy}};
    kernels::AdaptiveIntegrator<ClampedFlow, 4> integrator(flow, scale);
    RC_ASSERT(integrator.advance(all[k].begin, all[k].end, z.data(), [](auto&&...) {}) ==
              equipoise::IntegrationStatus::done);
    // The rotating-frame velocity x' = u + w y, y' = v - w x is kept where psi' jumps.
    const double jump = all[k + 1].speed - all[k].speed_at(all[k].end);
    z[2] -= jump * z[1];
    z[3] += jump * z[0];
  }
  // Each is accurate to 1e-12 per step, and a stable linear system does not amplify it.
  for (int i = 0; i < 4; ++i) RC_ASSERT(std::fabs(superposed[i] - z[i]) < 1e-11);
}

}  // namespace symmetry_test
