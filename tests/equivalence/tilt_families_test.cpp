// Tilting rotors, each with values of its own: every start comes to what its rotor, known exactly, comes to.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "equipoise/analyses/basin_slices/basin_slice.hpp"
#include "equipoise/analyses/basin_slices/start_pixels.hpp"
#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/simulation/spin_up/spin_up.hpp"
#include "tilt_fixed_flow.hpp"

namespace equipoise {
namespace tilt_families_test {

using namespace tilting;

// What the start of a study's own initial values comes to.
std::optional<Motion> motion_of(const Study& known) {
  SpunUp begun;
  EXPECT_TRUE(make_spin_up(known, nullptr)->follow(std::vector{known.initial}, begun));
  const model::System system = known.system();
  const Eigen::Map<const Eigen::VectorXd> state(begun.states.data(), system.dimension());
  return motion_from(system, state, motion_patience);
}

// Starts of an uncertain study, each followed by itself on the rotor that it drew.
void expect_outcomes_of_known_rotors(const std::vector<std::string>& keys, const std::vector<std::string>& outcomes) {
  constexpr std::size_t starts = 24;
  const Study study = with_horizon(long_rotor_with(keys));
  Session runner(study, {});
  Decided decided;
  ASSERT_TRUE(runner.decide(0, starts, decided));
  RunCatalogue catalogue(runner);
  catalogue.settle(decided);
  std::vector<int> met(outcomes.size());
  for (std::size_t k = 0; k < starts; ++k) {
    const Attractor* a = catalogue.find(decided.outcomes[k].attractor);
    ASSERT_TRUE(a) << k;
    Study known = runner.family()->at(runner.family()->values_at(runner.fractions_of(k)));
    std::copy_n(&decided.phi[4 * k], 4, known.initial.phi.begin());
    const auto motion = motion_of(known);
    ASSERT_TRUE(motion) << k;
    EXPECT_EQ(without_number(a->name), motion_name(known.parameters, *motion).name) << k;
    for (std::size_t i = 0; i < outcomes.size(); ++i) met[i] += without_number(a->name) == outcomes[i];
  }
  for (std::size_t i = 0; i < outcomes.size(); ++i) EXPECT_GT(met[i], 1) << outcomes[i];
}

std::vector<std::string> drawing(const std::string& mass, std::vector<std::string> more) {
  std::vector<std::string> keys = damped(std::move(more));
  keys.push_back("balancer.drag={ uniform = [0.25, 0.35] }");
  keys.push_back("balancer.mass={ uniform = " + mass + " }");
  return keys;
}

// Balls lighter than 0.002615 cannot balance: (22) of Rodrigues and others (2008).
TEST(TiltFamilies, StartsComeToWhatTheirRotorsComeTo) {
  expect_outcomes_of_known_rotors(drawing("[0.002, 0.003]", {}), {"balanced", "locked (2 together)"});
}

TEST(TiltFamilies, SoDoStartsUnderGravity) {
  expect_outcomes_of_known_rotors(drawing("[0.0045, 0.0055]", {"rotor.gravity=0.01"}), {"balanced"});
}

// Held through a ramp, each on its rotor.
TEST(TiltFamilies, SoDoStartsWhoseBallsAreHeld) {
  expect_outcomes_of_known_rotors(
      drawing("[0.002, 0.003]", {"speed={ profile = \"ramp\", initial = 0.0, final = 3.5, duration = 20 }"}),
      {"balanced"});
}

// So few pixels are followed one by one.
TEST(TiltFamilies, PixelsOfASmallMapComeToWhatTheirRotorsComeTo) {
  BasinSliceSettings settings;
  settings.x = {"balancer.mass", 0.002, 0.0035, 3};
  settings.y = {"initial.phi_1", 0.0, 3.0, 3};
  const BasinSlice map = basin_slice(long_rotor_with(damped({})), settings);
  std::set<std::string> names;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      const short code = map.code[static_cast<std::size_t>(3 * row + column)];
      const auto at =
          std::find_if(map.codes.begin(), map.codes.end(), [&](const OutcomeShare& c) { return c.id == code; });
      ASSERT_NE(at, map.codes.end());
      const Study own = study_at(map, column, row);
      const auto motion = motion_of(own);
      ASSERT_TRUE(motion);
      EXPECT_EQ(without_number(at->name), motion_name(own.parameters, *motion).name) << column << ", " << row;
      names.insert(at->name);
    }
  EXPECT_GE(names.size(), 2u);
}

}  // namespace tilt_families_test
}  // namespace equipoise
