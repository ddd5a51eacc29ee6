// What counts as steady: made-up motions of which it is known how they go on.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "equipoise/base/angles.hpp"
#include "equipoise/motions/steady_watch.hpp"

namespace equipoise {
namespace {

constexpr double speed = 6.28, step = 0.25;

struct Motion {
  std::function<double(double)> r = [](double) { return 0.01; };
  std::array<std::function<double(double)>, 2> phi{[](double) { return 1.0; }, [](double) { return 4.0; }};
  std::function<double(double)> psi = [](double t) { return speed * t; };
};

model::Parameters two_balls() {
  model::Parameters p;
  p.balls = 2;
  p.mass = {0.05, 0.05};
  return p;
}

SteadyLook look_at(const Motion& motion, double until) {
  const model::Parameters p = two_balls();
  SteadyWatch watch(p);
  const auto angles = [&](double t) { return std::array<double, 2>{motion.phi[0](t), motion.phi[1](t)}; };
  watch.begin(0.0, motion.psi(0.0), angles(0.0).data());
  for (double t = step; t <= until; t += step) {
    std::array<SteadySample, 3> samples;
    for (int k = 0; k < 3; ++k) {
      const double at = t + step * (k - 2) / 3.0;
      samples[k].r2 = motion.r(at) * motion.r(at);
      std::copy_n(angles(at).begin(), 2, samples[k].phi.begin());
      for (int i = 0; i < 2; ++i) samples[k].rate[i] = (motion.phi[i](at + 1e-4) - motion.phi[i](at - 1e-4)) / 2e-4;
    }
    watch.step(t, motion.psi(t), samples);
  }
  return watch.look();
}

TEST(SteadyWatch, a_periodic_motion_repeats) {
  Motion m;
  m.r = [](double t) { return 0.05 + 0.01 * std::sin(1.3 * t); };
  m.phi[1] = [](double t) { return -0.7 * t + 0.3 * std::sin(0.7 * t); };
  // Parts and periods beat, which may look like a trend for a while, but not in looks of other lengths.
  int repeats = 0;
  for (const double until : {600.0, 800.0, 1000.0, 1200.0, 1500.0, 2000.0}) {
    const SteadyLook look = look_at(m, until);
    repeats += look.repeats;
    EXPECT_EQ(look.kind, 4);  // one captured
    EXPECT_NEAR(look.speed, speed, 1e-9);
  }
  EXPECT_GE(repeats, 3);
}

std::string name_of(const SteadyLook& look) {
  for (const SteadyKind& kind : steady_kinds(2))
    if (kind.id == look.kind) return kind.name;
  return "?";
}

// docs/motions.md: by whether balls drift at one rate, and then by how often they pass opposite places.
TEST(SteadyWatch, drifts_have_the_names_that_they_have_elsewhere) {
  Motion m;
  const auto drift = [](double t) { return -0.7 * t; };
  m.phi[0] = drift;
  m.phi[1] = [](double t) { return -0.4 * t; };
  EXPECT_EQ(name_of(look_at(m, 1000.0)), "drifting at different rates");
  m.phi[1] = drift;
  EXPECT_EQ(name_of(look_at(m, 1000.0)), "co-drifting");
  m.phi[1] = [&](double t) { return drift(t) + 2.0 + std::sin(0.7 * t); };  // never opposite
  EXPECT_EQ(name_of(look_at(m, 1000.0)), "co-drifting");
  m.phi[1] = [&](double t) { return drift(t) + pi + std::sin(0.35 * t); };  // opposite once a turn
  EXPECT_EQ(name_of(look_at(m, 1000.0)), "drifting apart");
  m.phi[1] = [&](double t) { return drift(t) + pi + std::sin(0.7 * t); };  // twice
  EXPECT_EQ(name_of(look_at(m, 1000.0)), "pair drift");
  // Now and then, in some parts of the time alone: which it is in the long run is not told yet.
  m.phi[1] = [&](double t) { return drift(t) + (t < 800.0 ? 2.0 : pi + 0.1 * std::sin(0.35 * t)); };
  EXPECT_EQ(look_at(m, 1000.0).kind, 0);
}

// A ball's last slow drift, 0.003 beside a rotor's 6.28, on its way to rest.
TEST(SteadyWatch, a_drift_that_dies_away_is_a_trend) {
  Motion m;
  m.phi[0] = [](double t) { return -0.003 * 2000.0 * std::expm1(-t / 2000.0); };
  EXPECT_TRUE(look_at(m, 1000.0).trending);
}

// Too slow to be told from none, too even to be none.
TEST(SteadyWatch, a_slow_even_drift_is_neither_captured_nor_drifting) {
  Motion m;
  m.phi[0] = [](double t) { return 0.003 * t; };
  EXPECT_EQ(look_at(m, 1000.0).kind, 0);
  EXPECT_EQ(look_at(m, 6000.0).kind, 4);  // once it has gone right round, it drifts
}

// Growing away from an unstable balance at 1.4e-4: by 7 % in the later half of what is seen.
TEST(SteadyWatch, a_slow_spiral_is_a_trend) {
  Motion m;
  for (const double rate : {1.4e-4, -1.4e-4}) {
    m.r = [rate](double t) { return 1e-5 * std::exp(rate * t); };
    EXPECT_TRUE(look_at(m, 1000.0).trending) << rate;
  }
}

TEST(SteadyWatch, a_rotor_that_speeds_up_or_slows_down_is_not_steady) {
  for (const double change : {1e-5, -1e-5}) {
    Motion m;
    m.psi = [change](double t) { return speed * t + 0.5 * change * t * t; };
    EXPECT_FALSE(look_at(m, 1000.0).speed_steady);
    EXPECT_EQ(look_at(m, 1000.0).slowing, change < 0.0);
  }
}

TEST(SteadyWatch, rocking_balls_rest_and_balls_that_swing_far_do_not) {
  Motion m;
  m.phi[0] = [](double t) { return 1.0 + 0.05 * std::sin(speed * t); };
  const SteadyLook rocking = look_at(m, 1000.0);
  EXPECT_TRUE(rocking.resting && rocking.repeats);
  m.phi[0] = [](double t) { return 1.0 + 0.5 * std::sin(speed * t); };
  const SteadyLook swinging = look_at(m, 1000.0);
  EXPECT_EQ(swinging.kind, 7);
  EXPECT_FALSE(swinging.resting);
}

// Windows are turns of the rotor as it turns, whatever it was meant to do.
TEST(SteadyWatch, parts_hold_turns_of_a_slow_rotor) {
  Motion m;
  m.psi = [](double t) { return 0.3 * t; };
  EXPECT_FALSE(look_at(m, 600.0).enough);  // two turns take 42: not yet sixteen of them
  EXPECT_TRUE(look_at(m, 700.0).enough);
  m.psi = [](double) { return 0.0; };  // a rotor that stands still
  EXPECT_TRUE(look_at(m, 1700.0).enough);
}

TEST(SteadyWatch, too_little_seen_is_nothing) { EXPECT_FALSE(look_at(Motion{}, 200.0).enough); }

}  // namespace
}  // namespace equipoise
