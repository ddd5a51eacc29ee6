// Rules of thumb over drawn rotors, against the linearised equations.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/report/explain/explain.hpp"
#include "equipoise/report/explain/parts.hpp"
#include "equipoise/report/explain/rules_of_thumb.hpp"

namespace equipoise {
namespace drawn_rules_test {

// Uniform numbers that are the same with every standard library.
class Draw {
 public:
  double uniform(double low, double high) { return low + (high - low) * (static_cast<double>(engine_()) / 0x1p64); }
  double logarithmic(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  int whole(int low, int high) { return std::min(high, static_cast<int>(uniform(low, high + 1))); }

 private:
  std::mt19937_64 engine_{1};
};

// The ranges of docs/explanation/rules-of-thumb.md.
model::Parameters drawn_rotor(Draw& draw) {
  model::Parameters p;
  p.balls = draw.whole(2, 5);
  p.eccentricity = draw.logarithmic(1e-3, 0.1);
  p.damping.fill(draw.logarithmic(0.02, 2.0));
  const double mass = p.eccentricity / draw.uniform(0.15, 0.95) / p.balls, drag = draw.logarithmic(0.003, 3.0);
  std::fill_n(p.mass.begin(), p.balls, mass);
  std::fill_n(p.drag.begin(), p.balls, drag);
  p.rolls = draw.whole(0, 1) == 1;
  return p;
}

TEST(CriticalSpeedRule, HeldBallsShakeMostWhereItSays) {
  Draw draw;
  for (int k = 0; k < 50; ++k) {
    model::Parameters p = drawn_rotor(draw);
    const auto peak = rules::speed_of_largest_vibration(p, 0);
    const double mass = 1.0 + p.total_mass();
    const auto radius = [&](double w) { return w * w / std::hypot(1.0 - mass * w * w, p.damping[0] * w); };
    if (!peak) {
      EXPECT_GE(p.damping[0] * p.damping[0], 2.0 * mass);
      continue;
    }
    EXPECT_GT(radius(*peak), radius(*peak * 1.001));
    EXPECT_GT(radius(*peak), radius(*peak * 0.999));
  }
}

// Statements in docs/explanation/rules-of-thumb.md about 3000 rotors hold for these 600 within three standard errors of
// both.
TEST(RulesOfThumb, AreRightAsOftenAsTheirPageSays) {
  Draw draw;
  int stable = 0, within_two = 0, drags = 0, best_inside = 0, from_inside = 0, to_inside = 0;
  constexpr int rotors = 600;
  for (int k = 0; k < rotors; ++k) {
    const model::Parameters p = drawn_rotor(draw);
    const double speed = draw.uniform(1.2, 6.0);
    const model::BalancedStates states = model::balanced_states(p);
    const auto angles = balanced_angles(states, p);
    ASSERT_TRUE(angles.has_value());
    const DragScan scan(p, speed, *angles, states.kind == model::BalancedStates::Kind::continuum);
    const double stiffness = rules::ball_stiffness(p, speed, angles->data()), rate = scan.slowest(1.0);
    if (rate < -least_rate) {
      ++stable;
      const double ratio = -rate * rules::settling_time(p, stiffness);
      within_two += ratio > 0.5 && ratio < 2.0;
    }
    const double best = rules::settling_drag(p, stiffness), own = rules::mean_drag(p);
    const auto range =
        scan.range(rules::settling_share, std::min(best, own) / (1e3 * own), std::max(best, own) * 1e3 / own);
    if (!range) continue;
    ++drags;
    const auto inside = [&](double drag) { return drag >= range->low * own && drag <= range->high * own; };
    best_inside += inside(best);
    from_inside += inside(rules::least_of_settling_drag * best);
    to_inside += inside(rules::most_of_settling_drag * best);
  }
  const auto expect = [](const char* what, int count, int of, double stated) {
    const double error = std::sqrt(stated * (1.0 - stated) * (1.0 / of + 1.0 / 3000.0));
    EXPECT_NEAR(static_cast<double>(count) / of, stated, 3.0 * error) << what;
  };
  expect("stable", stable, rotors, 0.750);
  expect("settling time within a factor of 2", within_two, stable, 0.869);
  expect("best drag", best_inside, drags, 0.961);
  expect("least drag", from_inside, drags, 0.914);
  expect("most drag", to_inside, drags, 0.978);
}

}  // namespace drawn_rules_test
}  // namespace equipoise
