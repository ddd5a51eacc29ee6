// Randomly drawn rows of touching balls at rest. A row stays exactly if pushes between neighbours exist with which
// friction holds every ball, and balls that start to move leave the others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "equipoise/simulation/integrate/ball_rest-inl.hpp"

namespace ball_rest_test {

using Row = equipoise::HWY_NAMESPACE::RestingRow<8>;

struct Ball {
  double force, hold, mass;
};

std::vector<Ball> drawn(std::mt19937_64& random) {
  std::uniform_real_distribution<double> even(0.0, 1.0);
  std::vector<Ball> balls(1 + random() % 8);
  for (Ball& ball : balls) ball = {2.0 * even(random) - 1.0, 1.5 * even(random), 0.1 + even(random)};
  return balls;
}

// The pushes that a ball may pass on, given those that reach it: an interval, ball by ball.
bool pushes_exist(const std::vector<Ball>& balls) {
  double low = 0.0, high = 0.0;
  for (const Ball& ball : balls) {
    low = std::max(low + ball.force - ball.hold, 0.0);
    high += ball.force + ball.hold;
    if (high < 0.0) return false;
  }
  return low <= 0.0;  // the last ball passes none on
}

TEST(RestingRow, StaysIfPushesCanBeFoundThatLetFrictionHold) {
  std::mt19937_64 random(7);
  int stayed = 0, of_several = 0;
  for (int draw = 0; draw < 20000; ++draw) {
    const std::vector<Ball> balls = drawn(random);
    Row row;
    for (const Ball& ball : balls) row.add(ball.force, ball.hold, ball.mass);
    bool stays = true, alone = true;
    for (int g = 0; g < row.groups(); ++g) stays = stays && row.group(g).goes() == 0.0;
    for (const Ball& ball : balls) alone = alone && std::fabs(ball.force) <= ball.hold;
    ASSERT_EQ(stays, pushes_exist(balls)) << draw;
    stayed += stays;
    of_several += stays && !alone;
  }
  EXPECT_GT(stayed, 1000);
  EXPECT_GT(of_several, 1000);  // where a ball alone could not have held
}

// No accelerations without collisions come nearer to what the forces require.
TEST(RestingRow, GoesAsLeastResistanceHasIt) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  for (int draw = 0; draw < 2000; ++draw) {
    const std::vector<Ball> balls = drawn(random);
    Row row;
    for (const Ball& ball : balls) row.add(ball.force, ball.hold, ball.mass);
    std::vector<double> found;
    for (int g = 0; g < row.groups(); ++g)
      for (int i = row.group(g).first; i <= row.group(g).last; ++i) found.push_back(row.group(g).goes());
    ASSERT_EQ(found.size(), balls.size());
    ASSERT_TRUE(std::is_sorted(found.begin(), found.end()));
    const auto cost = [&](const std::vector<double>& a) {
      double sum = 0.0;
      for (std::size_t i = 0; i < a.size(); ++i)
        sum += 0.5 * balls[i].mass * a[i] * a[i] - balls[i].force * a[i] + balls[i].hold * std::fabs(a[i]);
      return sum;
    };
    const double least = cost(found);
    for (int other = 0; other < 50; ++other) {
      std::vector<double> a = found;
      for (double& value : a) value += (other % 2 ? 1.0 : 0.01) * even(random);
      std::sort(a.begin(), a.end());
      ASSERT_GE(cost(a), least - 1e-12);  // sums of eight numbers of the order of 1
    }
  }
}

}  // namespace ball_rest_test
