// [sampling.box]: reading, echo, errors, and draws.
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "equipoise/simulation/spin_up/start_source.hpp"
#include "equipoise/study/contents/study.hpp"
#include "../support/study_difference.hpp"
#include "../support/studies.hpp"

namespace equipoise {
namespace sampling_box_test {

const std::string free_balls = constant_speed + R"([initial]
x = 0.01
y = -0.02
phi_dot = 0.125
)";
const std::string box = R"([sampling.box]
x = [-0.2, 0.2]
y_dot = [0, 0.5]
phi_dot = [-2.4, 2.4]
)";

Study parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_study(text, "box.toml", overrides);
}

TEST(SamplingBox, IsReadAndEchoed) {
  const Study study = parse(free_balls + box);
  ASSERT_TRUE(study.sampling.box.x && study.sampling.box.y_dot && study.sampling.box.phi_dot);
  EXPECT_FALSE(study.sampling.box.y || study.sampling.box.x_dot);
  EXPECT_EQ(study.sampling.box.x->low, -0.2);
  EXPECT_EQ(study.sampling.box.y_dot->high, 0.5);
  const Study back = parse(to_toml(study));
  EXPECT_EQ(first_difference(study, back), "");
  EXPECT_EQ(to_toml(back), to_toml(study));
  EXPECT_NO_THROW(check(study));
}

TEST(SamplingBox, LeavesTheEchoOfOtherStudiesAlone) {
  EXPECT_EQ(to_toml(parse(free_balls)).find("box"), std::string::npos);
  EXPECT_EQ(to_toml(parse(free_balls + "[sampling.box]\n")), to_toml(parse(free_balls)));
}

TEST(SamplingBox, CanBeOverridden) {
  const Study study = parse(free_balls + box, {"sampling.box.x=[0.1, 0.3]", "sampling.seed=3"});
  EXPECT_EQ(study.sampling.box.x->low, 0.1);
  EXPECT_EQ(study.sampling.seed, 3u);
}

TEST(SamplingBox, NeedsFreeBalls) {
  const std::vector<std::string> clamped{"release.time=5.0", "initial.phi_dot=0.0"};
  EXPECT_NO_THROW(parse(free_balls, clamped));
  EXPECT_THROW(parse(free_balls + box, clamped), InputError);
  EXPECT_NO_THROW(parse(free_balls + box, {"release.time=0.0"}));
}

TEST(SamplingBox, DrawsWhatItNamesAndKeepsAnglesAndTheRest) {
  const Study with = parse(free_balls + box), without = parse(free_balls);
  double x_sum = 0.0, rate_product = 0.0;
  constexpr int count = 4000;
  std::set<double> values;
  for (int i = 0; i < count; ++i) {
    const InitialState s = start_of(with, 1, i), plain = start_of(without, 1, i);
    EXPECT_EQ(s.phi, plain.phi);
    EXPECT_EQ(plain.x, 0.01);
    EXPECT_EQ(s.y, -0.02);
    EXPECT_EQ(s.x_dot, 0.0);
    EXPECT_TRUE(s.x >= -0.2 && s.x <= 0.2 && s.y_dot >= 0.0 && s.y_dot <= 0.5);
    for (int k = 0; k < 2; ++k) EXPECT_TRUE(std::abs(s.phi_dot[k]) <= 2.4);
    x_sum += s.x / 0.2;
    rate_product += s.phi_dot[0] * s.phi_dot[1] / (2.4 * 2.4);
    for (const double v : {s.x / 0.2, s.y_dot / 0.5, s.phi_dot[0] / 2.4, s.phi_dot[1] / 2.4, s.phi[0] / two_pi})
      values.insert(v);
  }
  // Means of 4000 numbers of standard deviation 1/sqrt(3) and 1/3: five standard errors.
  EXPECT_NEAR(x_sum / count, 0.0, 5.0 / std::sqrt(3.0 * count));
  EXPECT_NEAR(rate_product / count, 0.0, 5.0 / (3.0 * std::sqrt(count)));
  EXPECT_EQ(values.size(), 5u * count);  // no number is used twice
}

TEST(SamplingBox, TakesFurtherCoordinatesOfTheSameSobolPoint) {
  const Study with = parse(free_balls + box, {"sampling.method=sobol"});
  const Study without = parse(free_balls, {"sampling.method=sobol"});
  // Balls' angles, x, y_dot, balls' rates: in each coordinate, each of a replicate's 2^6 points lies in its own cell.
  std::array<std::set<int>, 6> cells;
  for (std::uint64_t i = 3; i < 16 * 64; i += 16) {
    const InitialState s = start_of(with, 1, i);
    EXPECT_EQ(s.phi, start_of(without, 1, i).phi);
    EXPECT_EQ(s.y, -0.02);
    const double turns[] = {s.phi[0] / two_pi, s.phi[1] / two_pi,          (s.x + 0.2) / 0.4,
                            s.y_dot / 0.5,     (s.phi_dot[0] + 2.4) / 4.8, (s.phi_dot[1] + 2.4) / 4.8};
    for (std::size_t d = 0; d < cells.size(); ++d) cells[d].insert(static_cast<int>(64 * turns[d]));
  }
  for (const auto& one : cells) EXPECT_EQ(one.size(), 64u);
}

TEST(SamplingBox, SourcePlacesTheDrawnState) {
  const Study study = parse(free_balls + box);
  const StartSource source(study, nullptr);
  SpunUp starts;
  ASSERT_TRUE(source.make(1, 7, 2, starts));
  for (int i = 0; i < 2; ++i) {
    const InitialState s = start_of(study, 1, 7 + i);
    const double* z = &starts.states[8 * i];
    EXPECT_EQ(z[0], s.x);
    EXPECT_EQ(z[1], s.y);
    // Inertial velocity from the rotating frame's derivatives: one product and one sum, a rounding each.
    EXPECT_DOUBLE_EQ(z[2], s.x_dot - 2.4 * s.y);
    EXPECT_DOUBLE_EQ(z[3], s.y_dot + 2.4 * s.x);
    for (int k = 0; k < 2; ++k) {
      EXPECT_EQ(starts.phi[2 * i + k], s.phi[k]);
      EXPECT_EQ(z[4 + k], s.phi[k]);
      EXPECT_EQ(z[6 + k], s.phi_dot[k]);
    }
  }
}

}  // namespace sampling_box_test
}  // namespace equipoise
