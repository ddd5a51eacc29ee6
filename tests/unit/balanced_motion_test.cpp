// Balance under gravity or on unequal supports: which motion replaces it, and what notes say where it is lost.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "equipoise/attractors/periodic_orbits/stroboscopic_section.hpp"
#include "equipoise/classification/balanced_regions/balanced_analysis.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {
namespace balanced_motion_test {

// 12 kg on springs of `stiffness` (N/m), 800 g mm, two balls of 11.2 g in a race of 70 mm, under its weight: on 50 N/m
// it hangs 34 radii of its race below where the springs are slack.
Study soft_rotor(double stiffness, double rpm) {
  const double critical = std::sqrt(stiffness / 12.0), radius = 0.07;
  Study study;
  study.name = "rotor";
  model::Parameters& p = study.parameters;
  p.eccentricity = 800e-6 / (12.0 * radius);
  p.damping = {0.14, 0.14};
  p.gravity = 9.81 / (radius * critical * critical);
  p.mass = {0.000934, 0.000934};
  p.drag.fill(1e-3 / (0.01121 * radius * radius * critical));
  study.speed.profile = Profile::constant;
  study.speed.speed = rpm * two_pi / 60.0 / critical;
  return study;
}

TEST(BalancedMotion, IsFoundWhereverTheRotorHangs) {
  for (const double stiffness : {0.5, 50.0, 5000.0}) {
    const Study study = soft_rotor(stiffness, 3000.0);
    const model::Parameters& p = study.parameters;
    const BalancedAnalysis found = analyse_balanced({p, study.speed.speed});
    EXPECT_TRUE(found.stable) << found.note;
    EXPECT_EQ(found.note, "");
    ASSERT_EQ(found.motions.size(), 1u) << found.note;
    // Far above resonance a rotor without balls vibrates by its eccentricity.
    EXPECT_LT(found.motions[0].r_max, 0.01 * p.eccentricity);
    // The way back: it recognises what starts settle on.
    EXPECT_TRUE(leads_to_balance({p, study.speed.speed}, found.motions[0].orbit)) << stiffness;
  }
}

TEST(BalancedMotion, OfASoftRotorIsWhatSimulateComesTo) {
  Study study = soft_rotor(50.0, 3000.0);
  study.initial.phi = {2.0, 4.0};
  study.initial.y = model::static_sag(study.parameters);
  study.initial.x_dot = study.speed.speed * study.initial.y;  // at rest in fixed axes
  study.numerics.tolerance = 1e-9;  // of x and y, which are 34: 3e-8 a step, far below the eccentricity
  // Six times the time in which the slowest deviation falls to 1/e.
  const Trajectory path = simulate(study, {0.0, 1.0, 85.0, 85.01, 85.02});
  EXPECT_GT(path.radial[1], 0.1 * study.parameters.eccentricity);
  for (std::size_t k = 2; k < path.radial.size(); ++k) EXPECT_LT(path.radial[k], 0.01 * study.parameters.eccentricity);
}

// The motion that a state near balance comes to while gravity fades.
TEST(BalancedMotion, RelaxesWhereverTheRotorHangs) {
  const Study study = soft_rotor(50.0, 3000.0);
  const model::System system(study.parameters, study.speed.speed);
  const BalancedAnalysis found = analyse_balanced(system);
  ASSERT_FALSE(found.motions.empty());
  EXPECT_TRUE(relaxes_to_balance(system, found.motions[0].state));
  // A ball half a turn off does not balance, and moves further than a quarter turn.
  Eigen::VectorXd elsewhere = found.motions[0].state;
  elsewhere[model::index::phi(0)] += pi;
  EXPECT_FALSE(relaxes_to_balance(system, elsewhere));
}

bool says(const std::string& note, const char* words) { return note.find(words) != std::string::npos; }

TEST(BalancedMotion, IsSaidToBeLostToWhatTheRotorHas) {
  // At 300 rpm the weight of a ball is a seventh of its centrifugal force.
  Study study = soft_rotor(5000.0, 300.0);
  const auto note_of = [&] { return analyse_balanced({study.parameters, study.speed.speed}).note; };
  const std::string gravity = note_of();
  EXPECT_TRUE(says(gravity, "as gravity is switched on can be followed to ")) << gravity;
  EXPECT_FALSE(says(gravity, "supports")) << gravity;
  // It is lost where the note says: slightly weaker gravity leaves a motion, slightly stronger gravity none.
  const double share = std::atof(gravity.substr(gravity.find("followed to ") + 12).c_str()) / 100.0;
  ASSERT_GT(share, 0.0);
  ASSERT_LT(share, 1.0);
  const double full = study.parameters.gravity;
  study.parameters.gravity = 0.95 * share * full;
  EXPECT_EQ(analyse_balanced({study.parameters, study.speed.speed}).motions.size(), 1u);
  study.parameters.gravity = 1.05 * share * full;
  EXPECT_TRUE(analyse_balanced({study.parameters, study.speed.speed}).motions.empty());

  study.parameters.gravity = full;
  study.parameters.stiffness = {1.0, 1.1};
  const std::string both = note_of();
  EXPECT_TRUE(says(both, "as gravity and the supports' difference are switched on")) << both;

  // Unequal supports do not change a centred rotor's balanced state.
  study.parameters.gravity = 0.0;
  const std::string neither = note_of();
  EXPECT_FALSE(says(neither, "switched on")) << neither;
  EXPECT_FALSE(says(neither, "gravity")) << neither;
}

}  // namespace balanced_motion_test
}  // namespace equipoise
