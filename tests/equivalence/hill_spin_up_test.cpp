// A run-up by a Hill function in lanes, against one trajectory in doubles whose psi'' comes from the same function.
#include <gtest/gtest.h>

#include <span>
#include <string>
#include <vector>

#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/simulation/spin_up/spin_up.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "equipoise/study/contents/study.hpp"

namespace hill_spin_up_test {

using namespace equipoise;

Study hill(const std::vector<std::string>& overrides) {
  const std::string text =
      "[rotor]\neccentricity = 0.01\ndamping = 0.1\n[balancer]\nballs = 2\nmass = 0.02\ndrag = 0.2\n[speed]\nprofile = "
      "\"hill\"\nfinal = 2.4\nhalf_time = 9.0\nexponent = 2.5\nuntil = 30.0\n[initial]\nphi = [0.4, 2.0]\n[numerics]\n"
      "tolerance = 1e-11\n";
  return parse_study(text, "hill", overrides);
}

// Plain lanes; lanes with the rotor's angle; lanes with events; balls held on part of the way.
TEST(HillSpinUp, IsInLanesWhatItIsInDoubles) {
  const std::vector<std::vector<std::string>> kinds{
      {"release.time=0"},
      {"release.time=0", "rotor.gravity=0.02", "rotor.stiffness=[1.0, 1.3]"},
      {"release.time=0", "balancer.contact_angle=0.1", "balancer.restitution=0.5"},
      {"release.time=0", "balancer.rolls=true", "balancer.ball_radius=0.1"},
      {"release.speed=1.1"},
      {"release.speed=1.1", "rotor.gravity=0.02"}};
  for (const auto& overrides : kinds) {
    const Study study = hill(overrides);
    const auto source = make_spin_up(study, nullptr);
    SpunUp spun;
    const std::vector<InitialState> starts(3, study.initial);
    ASSERT_TRUE(source->follow(starts, spun));
    const double settled = study.speed_profile().settled_time();
    ASSERT_EQ(source->settled(), settled);
    const Trajectory one = simulate(study, {settled});
    const std::size_t size = spun.states.size() / starts.size();
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const double* z = &spun.states[i * size];
      // Both at 1e-11 a step, over a few dozen steps of a motion that forgets.
      EXPECT_NEAR(z[0], one.x.back(), 1e-8) << overrides.back();
      EXPECT_NEAR(z[1], one.y.back(), 1e-8) << overrides.back();
      for (int b = 0; b < 2; ++b)
        EXPECT_NEAR(z[model::index::phi(b)], one.phi[static_cast<std::size_t>(b)].back(), 1e-7) << overrides.back();
    }
  }
}

}  // namespace hill_spin_up_test
