// One motion followed along a parameter: its points are motions of their rotors, its events are where searches at many
// values bracket them (docs/evidence/bifurcations.csv) and where eigenvalues cross.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/analyses/continuation/parameter_line.hpp"
#include "equipoise/analyses/one_study/attractors.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/extras/cycles/motion_branch.hpp"

namespace equipoise {
namespace motion_branch_test {

Study paper_rotor(double speed) {
  return read_study(std::string(EQUIPOISE_SOURCE_DIR) + "/studies/paper/table-2-omega-2.4.toml",
                    {"speed.speed=" + std::to_string(speed)});
}

// At rest in the room, balls at these angles and rates.
Eigen::VectorXd state(double phi_1, double phi_2, double q_1, double q_2) {
  Eigen::VectorXd z = Eigen::VectorXd::Zero(8);
  z << 0.0, 0.0, 0.0, 0.0, phi_1, phi_2, q_1, q_2;
  return z;
}

// On the motion that a search finds under this name.
Eigen::VectorXd on_motion(const Study& study, const std::string& alias) {
  for (const Attractor& a : attractors(study, {}).attractors)
    if (a.alias == alias) return a.motion.state;
  ADD_FAILURE() << "no start leads to " << alias;
  return state(0.0, 0.0, 0.0, 0.0);
}

const BranchEvent* event_of(const MotionBranch& found, BranchCause cause, double low, double high) {
  for (const BranchEvent& e : found.branch.events)
    if (e.cause == cause && e.low > low && e.high < high) return &e;
  return nullptr;
}

void expect_motions_of_their_rotors(const Study& study, const std::string& key, const MotionBranch& found) {
  for (std::size_t k = 0; k < found.branch.points.size(); k += 9) {
    const BranchPoint& point = found.branch.points[k];
    const auto alone = refined_motion(study_with(study, key, point.value).system(), point.motion);
    ASSERT_TRUE(alone) << point.value;
    EXPECT_EQ(alone->kind, point.motion.kind);
    EXPECT_EQ(alone->stable, point.motion.stable) << point.value;
    // The branch's integrations are to 1e-10 a step, refined motions to 1e-12.
    EXPECT_NEAR(alone->period, point.motion.period, 1e-7 * alone->period);
    EXPECT_NEAR(alone->r_max, point.motion.r_max, 1e-6);
  }
}

TEST(MotionBranches, PassTheFoldOfV1) {
  const Study study = paper_rotor(2.4);
  const MotionBranch found = follow_motion(study, "speed.final", 2.4, 5.5, on_motion(study, "V1"));
  EXPECT_EQ(found.end, BranchEnd::range);
  EXPECT_EQ(found.branch.alias, "V1");
  const BranchEvent* fold = event_of(found, BranchCause::fold, 5.0, 5.1);
  ASSERT_TRUE(fold);
  EXPECT_GT(fold->low, 5.036238 - 1e-6);
  EXPECT_LT(fold->high, 5.036240 + 1e-6);
  EXPECT_TRUE(event_of(found, BranchCause::pitchfork, 4.4, 4.43));  // there V1 ceases to attract
  EXPECT_TRUE(event_of(found, BranchCause::fold, 4.2, 4.3));        // and back: three motions between the folds
  EXPECT_DOUBLE_EQ(found.branch.points.back().value, 5.5);
  expect_motions_of_their_rotors(study, "speed.final", found);
}

TEST(MotionBranches, PassTheFoldAtWhichV3IsBornAndTheFlipOfV4) {
  const Study at_v3 = paper_rotor(4.0);
  const MotionBranch v3 = follow_motion(at_v3, "speed.final", 4.0, 2.5, on_motion(at_v3, "V3"));
  const BranchEvent* birth = event_of(v3, BranchCause::fold, 2.8, 3.0);
  ASSERT_TRUE(birth);
  EXPECT_GT(birth->low, 2.9043366 - 1e-6);
  EXPECT_LT(birth->high, 2.9043373 + 1e-6);
  const Study at_v4 = paper_rotor(4.35);
  const MotionBranch v4 = follow_motion(at_v4, "speed.final", 4.35, 4.6, on_motion(at_v4, "V4"));
  const BranchEvent* flip = event_of(v4, BranchCause::period_doubling, 4.4, 4.42);
  ASSERT_TRUE(flip);
  EXPECT_GT(flip->low, 4.40801 - 1e-5);
  EXPECT_LT(flip->high, 4.40820 + 1e-5);
  EXPECT_EQ(flip->change, BranchChange::stability_lost);
}

TEST(MotionBranches, OfBalanceHaveItsHopfPoints) {
  const Study study = paper_rotor(2.4);
  const auto balanced = motion_from(study.system(), state(1.9, -1.7, 0.0, 0.0));
  ASSERT_TRUE(balanced && balanced->kind == MotionKind::equilibrium);
  const MotionBranch found = follow_motion(study, "speed.final", 2.4, 1.0, balanced->state);
  EXPECT_EQ(found.branch.points.front().motion.kind, MotionKind::equilibrium);
  ASSERT_EQ(found.branch.events.size(), 3u);
  for (const BranchEvent& e : found.branch.events) {
    EXPECT_EQ(e.cause, BranchCause::hopf);
    // A pair of eigenvalues is on the imaginary axis there.
    const auto there = refined_motion(study_with(study, "speed.final", e.low).system(), found.branch.points[30].motion);
    ASSERT_TRUE(there);
    EXPECT_LT(there->spectrum.array().real().abs().minCoeff(), 1e-6);
  }
  expect_motions_of_their_rotors(study, "speed.final", found);
  // Where eccentricity grows, the two balls come together until they just reach (lambda = 2 mu); there the branch
  // turns.
  const MotionBranch reach = follow_motion(study, "rotor.eccentricity", 0.01, 0.2, balanced->state);
  double most = 0.0;
  for (const BranchPoint& p : reach.branch.points) most = std::max(most, p.value);
  EXPECT_NEAR(most, 0.1, 1e-4);
}

TEST(MotionBranches, RefuseWhatCannotBeFollowed) {
  const Study study = paper_rotor(2.4);
  const Eigen::VectorXd balanced = state(1.7, -1.7, 0.0, 0.0);
  EXPECT_THROW(follow_motion(study, "speed.final", 2.4, 2.4, balanced), InputError);
  EXPECT_THROW(follow_motion(study, "no.key", 2.4, 3.0, balanced), InputError);
  EXPECT_THROW(follow_motion(study, "speed.final", 2.4, 3.0, balanced.head(6)), InputError);
  Study heavy = study;
  heavy.parameters.gravity = 0.01;
  EXPECT_THROW(follow_motion(heavy, "speed.final", 2.4, 3.0, balanced), InputError);
  StopFlag stop{true};
  RunOptions options;
  options.stop = &stop;
  EXPECT_TRUE(follow_motion(study, "speed.final", 2.4, 3.0, balanced, options).partial());
}

}  // namespace motion_branch_test
}  // namespace equipoise
