// Interrupted searches for motions return nothing, rather than what they had reached.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../support/studies.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/report/shown/motion_path.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {
namespace stopped_following_test {

// On the paper's V1, where both balls lag behind together.
class StoppedFollowing : public testing::Test {
 protected:
  void SetUp() override {
    Eigen::VectorXd state = Eigen::VectorXd::Zero(8);
    state << 0.0, 0.0, 0.0, 0.0, 0.1, 0.2, -1.6, -1.6;
    motion_ = motion_from(system_, state);
    ASSERT_TRUE(motion_ && motion_->kind == MotionKind::periodic);
  }

  const Study study_ = parse_study(constant_speed, "stopped.toml");
  const model::System system_ = study_.system();
  std::optional<Motion> motion_;
  const StopFlag stop_{true};
};

TEST_F(StoppedFollowing, FindsNoOrbit) {
  const double period = motion_->orbit.period;
  EXPECT_TRUE(find_orbit(system_, motion_->state, period, 0.5).has_value());
  EXPECT_FALSE(find_orbit(system_, motion_->state, period, 0.5, &stop_).has_value());
  EXPECT_TRUE(follow_derivative(system_, motion_->state, period, 1e-9).has_value());
  EXPECT_FALSE(follow_derivative(system_, motion_->state, period, 1e-9, 0.0, &stop_).has_value());
}

TEST_F(StoppedFollowing, ComesToNoMotion) {
  EXPECT_FALSE(motion_from(system_, motion_->state, motion_patience, &stop_).has_value());
}

TEST_F(StoppedFollowing, DrawsNoWholePath) {
  EXPECT_EQ(motion_path(system_, *motion_, 100.0, 50).x.size(), 51u);
  RunOptions options;
  options.stop = &stop_;
  EXPECT_EQ(motion_path(system_, *motion_, 100.0, 50, options).x.size(), 1u);
}

// An interrupted search's motion must not be taken for the start's motion.
TEST_F(StoppedFollowing, ListsNoStart) {
  Study study = study_;
  study.numerics.horizon = 3000.0;
  StopFlag stop{false};
  const Session runner(study, {.stop = &stop});
  const std::vector<double> state(motion_->state.begin(), motion_->state.end());
  const auto followed = runner.follow(state);
  ASSERT_TRUE(followed.has_value());
  EXPECT_TRUE(followed->motion.has_value());
  stop = true;
  EXPECT_FALSE(runner.follow(state).has_value());
}

}  // namespace stopped_following_test
}  // namespace equipoise
