// Trajectories with their own rotors, side by side on lanes, against each rotor alone in doubles; their outcomes,
// against the same rotors known exactly.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/classification/balanced_regions/balanced_analysis.hpp"
#include "equipoise/classification/balanced_regions/balanced_region.hpp"
#include "equipoise/classification/balanced_regions/family_regions.hpp"
#include "equipoise/classification/rotor_family/drawn_source.hpp"
#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/spin_up/spin_up.hpp"

#include "lane_studies.hpp"
#include "../support/sizes.hpp"

namespace own_rotors_test {

using namespace lanes;

constexpr double until = 45.0;

struct Case {
  std::string name, toml;
  double accuracy = 1e-6;  // of deviations that a step's 1e-10 grows to over a hundred e-foldings of nothing
};

std::vector<Case> cases() {
  const std::string torque = "[speed]\nprofile = \"torque\"\ntorque = { stall = 0.5, no_load_speed = 2.5 }\n";
  const std::string touching = "contact_angle = 0.2\nrestitution = 0.6\n";
  const std::string constant = "[speed]\nprofile = \"constant\"\nspeed = 2.4\n";
  return {
      {"plain", rotor("") + balls(2) + constant},
      {"plain_of_three_held_on_a_ramp", rotor("") + balls(3) + ramp + at_time},
      {"under_gravity_held_to_the_end_of_a_ramp", rotor(upright) + balls(2) + ramp},
      {"motor", rotor("") + balls(2) + torque},
      {"motor_by_its_curve_with_a_fan",
       rotor("") + balls(2) +
           "[speed]\nprofile = \"torque\"\ntorque = { speeds = [0.0, 1.2, 2.0, 2.5], values = [0.3, 0.5, 0.4, 0.0] }\n"
           "load = { quadratic = 0.1, at = 2.0 }\n",
       1e-5},
      {"motor_under_gravity_releasing_at_a_speed", rotor(upright) + balls(4) + torque + at_speed, 1e-5},
      {"off_centre_with_gravity", rotor(upright) + balls(3, off_centre) + ramp + at_time},
      {"touching", rotor("") + balls(3, touching) + constant, 1e-5}};
}

// Each start with different values of everything that a rotor may have for itself.
std::vector<OwnRotorStart> own_rotor_starts(const std::string& toml) {
  std::vector<OwnRotorStart> result;
  for (std::size_t i = 0; i < starts; ++i) {
    const double share = static_cast<double>(i) / starts;
    Study study = parse_study(
        toml, "study",
        {"rotor.eccentricity=" + std::to_string(0.015 + 0.01 * share),
         "rotor.damping=" + std::to_string(0.5 - 0.2 * share), "balancer.mass=" + std::to_string(0.03 + 0.01 * share),
         "balancer.drag=" + std::to_string(0.3 - 0.1 * share)});
    const InitialState start = start_of(study, study.sampling.seed, i);
    result.push_back({std::move(study), start});
  }
  return result;
}

// States at `until` of `some` starts.
std::vector<double> states_of(std::span<const OwnRotorStart> some, SpunUp& spun) {
  EXPECT_TRUE(spin_up_own_rotors(some, nullptr, spun));
  const model::System first = some.front().study.system();
  BatchTask task = batch_task(first);
  std::vector<const OwnRotor*> own;
  for (OwnRotor& rotor : spun.rotors) {
    rotor.end = until;
    own.push_back(&rotor);
  }
  task.segment = spun.rotors.front().segment;
  task.end = until;
  task.tolerance = *some.front().study.numerics.tolerance;
  task.count = some.size();
  task.states = spun.states.data();
  task.begins = spun.begins.data();
  task.own = own.data();
  std::vector<Outcome> outcomes(some.size());
  EXPECT_TRUE(advance_batch(task, outcomes));
  return spun.states;
}

class OwnRotors : public testing::TestWithParam<Case> {};

TEST_P(OwnRotors, AreFollowedAsEachByItselfInDoubles) {
  const std::vector<OwnRotorStart> own = own_rotor_starts(GetParam().toml);
  SpunUp spun;
  const std::vector<double> states = states_of(own, spun);
  for (std::size_t i = 0; i < starts; ++i) {
    const model::System system = own[i].study.system();
    const auto size = static_cast<std::size_t>(system.dimension());
    const Eigen::VectorXd scale = system.scale();
    const Reference reference = one_by_one(own[i].study, i, until);
    for (std::size_t k = 0; k < size; ++k)
      EXPECT_NEAR(states[i * size + k], reference.state[k], GetParam().accuracy * scale[k]) << i << " " << k;
    if (spun.released.empty()) continue;
    EXPECT_NEAR(spun.released[i], reference.released, 1e-6) << i;
  }
}

TEST_P(OwnRotors, GiveTheSameBitsAlone) {
  const std::vector<OwnRotorStart> own = own_rotor_starts(GetParam().toml);
  SpunUp spun;
  const std::vector<double> together = states_of(own, spun);
  const std::size_t size = together.size() / starts;
  // With a neighbour, so that rotors are still separate.
  for (const std::size_t i : {0u, 7u, 17u}) {
    const std::vector<double> two = states_of({&own[i], 2}, spun);
    for (std::size_t k = 0; k < size; ++k) EXPECT_EQ(two[k], together[i * size + k]) << i << " " << k;
  }
}
INSTANTIATE_TEST_SUITE_P(AllSystems, OwnRotors, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });

// Gravity holds each rotor below the speed that releases its balls. What a start comes to must not depend on which
// starts happen to be followed with it.
TEST(OwnRotorsThatHang, ComeToTheSameAlone) {
  std::vector<OwnRotorStart> own;
  for (std::uint64_t i = 0; i < 6; ++i) {
    Study study = parse_study(
        "[rotor]\ndamping = 0.4\ninertia = 4.0\ngravity = 0.2\n"
        "[balancer]\nballs = 2\nmass = 0.01\ndrag = 0.2\n"
        "[speed]\nprofile = \"torque\"\ntorque = { stall = 0.012, no_load_speed = 2.4 }\n"
        "[release]\nspeed = 1.0\n[numerics]\nhorizon = 2000\n",
        "study", {"rotor.eccentricity=" + std::to_string(0.1 + 0.002 * static_cast<double>(i))});
    InitialState start = start_of(study, study.sampling.seed, i);
    start.y = -0.2;  // sagged
    own.push_back({std::move(study), start});
  }
  SpunUp together, alone;
  ASSERT_TRUE(spin_up_own_rotors(own, nullptr, together));
  for (std::size_t i = 0; i < own.size(); ++i) {
    ASSERT_TRUE(spin_up_own_rotors({&own[i], 1}, nullptr, alone));
    EXPECT_TRUE(together.is_over(i)) << i;
    EXPECT_TRUE(alone.is_over(0)) << i;
    const Outcome &one = alone.outcomes[0], &of_many = together.outcomes[i];
    EXPECT_EQ(one.kind, of_many.kind) << i;
    EXPECT_EQ(one.by, of_many.by) << i;
    EXPECT_EQ(one.time, of_many.time) << i;
    EXPECT_EQ(one.mean_speed, of_many.mean_speed) << i;
    const std::size_t size = alone.states.size();
    for (std::size_t k = 0; k < size; ++k) EXPECT_EQ(alone.states[k], together.states[i * size + k]) << i << " " << k;
  }
}

const std::string drawing =
    "[rotor]\neccentricity = { uniform = [0.006, 0.014] }\ndamping = { uniform = [0.4, 0.6] }\n"
    "[balancer]\nballs = 2\nmass = 0.05\ndrag = 0.05\n"
    "[speed]\nprofile = \"constant\"\nspeed = 2.4\n";

// V falls at every state within the level, for rotors that its fit has not seen.
TEST(FamilyRegions, FallsForEveryRotorOfThePart) {
  const StudyFamily family(with_horizon(parse_study(drawing, "study")));
  const FamilyBox box = family.parts().front();
  const DrawnSource source(family, box, nullptr);
  BalancedAnalysis balanced = analyse_balanced(source.middle().system());
  ASSERT_EQ(balanced.regions.size(), 2u);
  std::vector<OwnRotor> rotors = source.ends();
  for (std::uint64_t k = 0; k < 256; ++k) rotors.push_back(source.rotor(k));
  const FamilyRegions regions(balanced.regions, rotors, std::span(rotors).first(64), balanced.weights);
  ASSERT_EQ(balanced.regions.size(), 2u);
  const double level = balanced.regions.front().level;
  std::srand(7);
  for (std::uint64_t k = 1000; k < 1100; ++k) {
    OwnRotor rotor = source.rotor(k);
    regions.place(balanced.regions, rotor);
    const Eigen::VectorXd direction = Eigen::VectorXd::Random(8).normalized();
    for (const std::size_t number : {0u, 1u}) {
      const Eigen::VectorXd z = state_on_level(rotor, number, level, direction);
      const Eigen::Map<const Eigen::Matrix<double, 8, 8, Eigen::RowMajor>> f(&rotor.factors[number * 64]);
      const Eigen::VectorXd d = z - Eigen::Map<const Eigen::VectorXd>(&rotor.places[number * 8], 8);
      EXPECT_NEAR((f * d).squaredNorm(), level, 1e-12 * level);  // roundings of 8 x 8 sums
      EXPECT_LT((f * d).dot(f * model::rate(rotor.system, z)), 0.0) << k;
    }
  }
}

// The share over a box is the mean share of rotors at evenly spread values in it.
TEST(OwnRotorShares, AreTheMeanOfKnownRotors) {
  constexpr int rotors = 16;
  const std::uint64_t each = sized(1000, 250);
  double mean = 0.0, variance = 0.0;
  for (int k = 0; k < rotors; ++k) {
    const double eccentricity = 0.006 + 0.008 * (k + 0.5) / rotors;
    Study known =
        parse_study(drawing, "study", {"rotor.eccentricity=" + std::to_string(eccentricity), "rotor.damping=0.5"});
    known.sampling.starts = each;
    known.sampling.seed = 100 + static_cast<std::uint64_t>(k);
    const double share = basin(known).attractors.front().share.share;
    mean += share / rotors;
    variance += share * (1.0 - share) / each / rotors / rotors;
  }
  Study box = parse_study(drawing, "study", {"rotor.damping=0.5"});
  box.sampling.starts = rotors * each;
  const BasinResult result = basin(box);
  const double share = result.attractors.front().share.share;
  variance += share * (1.0 - share) / (rotors * each);
  EXPECT_LE(result.undecided.share, 0.002);
  // Four standard errors of both; the midpoint rule over 16 values errs by less than a tenth of one.
  EXPECT_NEAR(share, mean, 4.0 * std::sqrt(variance));
}

}  // namespace own_rotors_test
