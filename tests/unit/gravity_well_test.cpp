// The well of a stalled rotor: its bottom is at rest, nothing climbs out of it, what it holds stays and what has more
// energy leaves.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/mechanics/gravity_well.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/machine/model/held_state.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {
namespace gravity_well_test {

using Eigen::VectorXd;
using model::GravityWell;
using model::System;

// A rotor that gravity turns back with at most 0.02.
model::System rotor(const std::string& torque, const std::vector<std::string>& changes = {}) {
  const std::string toml =
      "[rotor]\neccentricity = 0.1\ndamping = 0.5\ninertia = 0.5\ngravity = 0.2\n"
      "[balancer]\nballs = 2\nmass = 0.05\ndrag = 0.05\n"
      "[speed]\nprofile = \"torque\"\ntorque = " +
      torque + "\n";
  return parse_study(toml, "rotor", changes).system();
}

const std::string weak = "{ stall = 0.01, no_load_speed = 2.4 }";

std::vector<System> rotors() {
  return {rotor(weak),
          rotor("{ constant = -0.01, slope = -0.004 }"),
          rotor("{ constant = 0.019 }"),
          rotor("{ gain = 1.0, limit = 0.015, target = { profile = \"constant\", speed = 2.0 } }"),
          rotor(weak, {"balancer.race_offset=[0.05,-0.1]", "rotor.stiffness=[1,1.3]"}),
          rotor(weak, {"balancer.mass=[0.05,0.02]", "balancer.rolls=true", "balancer.ball_radius=0.1"})};
}

TEST(GravityWell, RestsAtItsBottom) {
  for (const System& system : rotors()) {
    const auto well = GravityWell::of(system);
    ASSERT_TRUE(well);
    const VectorXd bottom = well->bottom();
    EXPECT_LT(model::rate(system, bottom).lpNorm<Eigen::Infinity>(), 1e-14);  // roundings of terms below 1
    EXPECT_TRUE(well->holds(bottom.data()));
    EXPECT_TRUE(well->holds_balls(bottom.data()));
  }
}

// The rotor turned by hand towards both maxima next to the well and released at rest, everything else at the bottom.
// The lower maximum is known in closed form. Beyond it lies another well: the same one, a turn further.
TEST(GravityWell, EndsAtTheLowerTop) {
  for (const System& system : rotors()) {
    const model::Parameters& p = system.parameters();
    const auto well = GravityWell::of(system);
    const double torque = system.torque(well->bottom());
    const std::complex<double> moment =
        p.gravity * (p.eccentricity + p.total_mass() * std::complex<double>(p.race_offset[0], p.race_offset[1]));
    const double to_top = 2.0 * std::acos(std::fabs(torque) / std::abs(moment)) * (torque < 0.0 ? -1.0 : 1.0);
    const auto turned = [&](double by, double speed) {
      VectorXd state = well->bottom();
      const std::complex<double> rest = std::polar(1.0, -by) * std::complex<double>(state[0], state[1]);
      state[0] = rest.real();
      state[1] = rest.imag();
      state[system.layout().psi] += by;
      for (int i = 0; i < p.balls; ++i) {
        state[model::index::phi(i)] -= by;
        state[model::index::q(i, p.balls)] = -speed;
      }
      state[system.layout().speed] = speed;
      return state;
    };
    EXPECT_TRUE(well->holds(turned(0.999 * to_top, 0.0).data()));
    EXPECT_TRUE(well->holds(turned(0.999 * to_top + two_pi, 0.0).data()));
    // As near to the higher maximum it would fall over the lower one.
    const double other_way = to_top - std::copysign(two_pi, to_top);
    EXPECT_FALSE(well->holds(turned(0.999 * other_way, 0.0).data()));
    EXPECT_FALSE(well->holds(turned(0.999 * to_top, 0.2).data()));
  }
}

// States all around the bottom, some far: those that are held never move a turn away, and come to rest.
TEST(GravityWell, HoldsForGood) {
  for (const System& system : rotors()) {
    const auto well = GravityWell::of(system);
    const VectorXd bottom = well->bottom();
    int held = 0;
    for (int k = 0; k < 1000 && held < 8; ++k) {
      const double size = std::ldexp(0.8, -(k % 4));  // wells are shallow if the motor nearly suffices
      VectorXd state = bottom;
      for (int i = 0; i < system.dimension(); ++i)
        state[i] += size * std::sin(1.0 + 2.3 * k + 1.7 * i * (k + 1)) * (i < 4 ? 0.1 : i < 6 ? 4.0 : 0.5);
      if (!well->holds(state.data())) continue;
      ++held;
      const auto end = follow_derivative(system, state, 2000.0, 1e-9);
      ASSERT_TRUE(end);
      EXPECT_LT(std::fabs(end->end[system.layout().psi] - state[system.layout().psi]), two_pi);
      EXPECT_LT(std::fabs(end->end[system.layout().speed]), 1e-4);  // the slowest rate is 0.005
      EXPECT_TRUE(well->holds(end->end.data()));
    }
    EXPECT_EQ(held, 8);
  }
}

TEST(GravityWell, IsThereOnlyWhereGravityHolds) {
  EXPECT_FALSE(GravityWell::of(rotor("{ stall = 0.0201, no_load_speed = 2.4 }")));
  EXPECT_TRUE(GravityWell::of(rotor("{ stall = 0.0199, no_load_speed = 2.4 }")));
  EXPECT_FALSE(GravityWell::of(rotor(weak, {"rotor.gravity=0", "rotor.stiffness=[1,1.3]"})));
  EXPECT_FALSE(GravityWell::of(rotor(weak, {"rotor.gravity=0"})));
  EXPECT_FALSE(GravityWell::of(rotor("{ constant = 0.01, slope = 0.01 }")));  // helps more the faster it turns
  EXPECT_FALSE(GravityWell::of(
      rotor("{ gain = 1.0, integral = 0.1, limit = 0.015, target = { profile = \"constant\", speed = 2.0 } }")));
}

// Balls at opposite places cancel, leaving the rotor alone; balls next to its heavy side make it harder to lift.
TEST(GravityWell, OfHeldBallsDependsOnWhereTheyAre) {
  const auto held_at = [](const System& system, double first, double second, double speed, double asked) {
    VectorXd state = GravityWell::of(system)->bottom();
    state[model::index::phi(0)] = first;
    state[model::index::phi(1)] = second;
    state[system.layout().speed] = speed;
    std::array<double, model::machine_layout(1).size> held{};
    model::hold_balls(system, state.data(), held.data());
    return model::trapped_in_well(system, held.data(), asked);
  };
  const System system = rotor(weak);
  EXPECT_TRUE(held_at(system, 1.0, 1.0 + pi, 0.0, 1.0));
  // Balls opposite outweigh the heavy side: at most 0.2 (0.1 - 0.1) of its weight is left.
  EXPECT_FALSE(held_at(system, pi, pi, 0.0, 1.0));
  EXPECT_TRUE(held_at(system, 0.0, 0.0, 0.0, 1.0));
  // Its remaining energy may bring it to a low speed.
  EXPECT_FALSE(held_at(system, 0.0, 0.0, 0.1, 0.05));
  EXPECT_TRUE(held_at(system, 0.0, 0.0, 0.1, 1.0));
  EXPECT_FALSE(held_at(system, 0.0, 0.0, 1.0, 2.0));
}

}  // namespace gravity_well_test
}  // namespace equipoise
