// Lane arithmetic on every instruction set of this machine: sine and cosine against the C library, step factors.
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "unit/pack_test.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "equipoise/core/base/pack-inl.hpp"
#include "equipoise/simulation/batch/batch_block-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

void sin_cos_array(const double* angle, double* sine, double* cosine, std::size_t count) {
  alignas(64) double a[8], s[8], c[8];
  for (std::size_t i = 0; i < count; i += pack_lanes) {
    for (std::size_t j = 0; j < pack_lanes; ++j) a[j] = angle[i + j];
    Pack sine_pack, cosine_pack;
    sin_cos(Pack::load(a), sine_pack, cosine_pack);
    sine_pack.store(s);
    cosine_pack.store(c);
    for (std::size_t j = 0; j < pack_lanes; ++j) {
      sine[i + j] = s[j];
      cosine[i + j] = c[j];
    }
  }
}

double step_factor(double error2, double log_error) {
  alignas(64) double out[8];
  step_change(Pack(error2), Pack(log_error)).factor.store(out);
  return out[0];
}

double coarse_round_trip(double a) {
  alignas(64) double out[8];
  coarse_exp2(coarse_log2(Pack(a))).store(out);
  return out[0];
}

struct Registers {
  Pack number[3];
  Mask mask[3];
};

// Of what was not set after it was made. Compilers may take what they know to be unset for anything.
unsigned not_zero_after_braces(bool set, const double* from) {
  Registers made{};
  if (set) {
    made.number[0] = made.number[2] = Pack::load(from);
    made.mask[0] = made.number[1] < made.number[0];
  }
  alignas(64) double out[8];
  unsigned result = 0;
  for (const Pack& number : made.number) {
    (number * Pack::load(from)).store(out);
    result += pack_lanes - static_cast<unsigned>(std::count(out, out + pack_lanes, 0.0));
  }
  for (const Mask& mask : made.mask) result += lane_bits(mask);
  return result;
}

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace equipoise {
HWY_EXPORT(sin_cos_array);
HWY_EXPORT(step_factor);
HWY_EXPORT(coarse_round_trip);
HWY_EXPORT(not_zero_after_braces);
namespace pack_test {

template <class Check>
void on_every_target(Check check) {
  for (auto target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().DeInit();
    SCOPED_TRACE(hwy::TargetName(target));
    check();
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

TEST(Pack, EmptyBracesMakeZeros) {
  on_every_target([] {
    alignas(64) const double from[8] = {1, 1, 1, 1, 1, 1, 1, 1};
    EXPECT_GT(HWY_DYNAMIC_DISPATCH(not_zero_after_braces)(true, from), 0u);
    EXPECT_EQ(HWY_DYNAMIC_DISPATCH(not_zero_after_braces)(false, from), 0u);
  });
}

TEST(Pack, SineAndCosineKeepTheirStatedErrors) {
  std::mt19937_64 random(1);
  std::vector<double> angle;
  for (double range : {1.0, 10.0, 1e3, 1e6, 1e8}) {  // up to the stated range, |a| <= 2^26 pi/2
    std::uniform_real_distribution<double> uniform(-range, range);
    for (int i = 0; i < 20000; ++i) angle.push_back(uniform(random));
  }
  for (int k = -4000; k < 4000; ++k) angle.push_back(k * 0.78539816339744830962);  // octants: where quadrants change
  std::vector<double> sine(angle.size()), cosine(angle.size());
  on_every_target([&] {
    HWY_DYNAMIC_DISPATCH(sin_cos_array)(angle.data(), sine.data(), cosine.data(), angle.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < angle.size(); ++i) {
      worst = std::max(worst, std::fabs(sine[i] - std::sin(angle[i])));
      worst = std::max(worst, std::fabs(cosine[i] - std::cos(angle[i])));
    }
    EXPECT_LT(worst, 6e-14);  // the stated bound: polynomial error 5.0e-14 and rounding
  });
}

TEST(Pack, StepFactorsFollowTheErrorWithinTheCoarseLogarithm) {
  on_every_target([] {
    // A tenth of the coarse logarithm's error of 0.086 and the coarse exponential's 6.2 %: within 8 % of the exact law.
    for (double error : {1e-5, 1e-3, 0.1, 0.9}) {
      const double exact = 0.9 * std::pow(error, -0.1) * std::pow(0.5, 0.05);
      EXPECT_NEAR(HWY_DYNAMIC_DISPATCH(step_factor)(error * error, -1.0), std::min(exact, 6.0), 0.08 * exact);
    }
    for (double error : {1.5, 10.0, 1e4})
      EXPECT_NEAR(HWY_DYNAMIC_DISPATCH(step_factor)(error * error, 0.0), std::max(0.2, 0.9 * std::pow(error, -0.125)),
                  0.08);
    EXPECT_NEAR(HWY_DYNAMIC_DISPATCH(step_factor)(std::nan(""), 0.0), 0.2, 0.02);
    EXPECT_NEAR(HWY_DYNAMIC_DISPATCH(step_factor)(HUGE_VAL, 0.0), 0.2, 0.02);
    const double floor = 0.9 * std::pow(1e-6, -0.1);  // errors count as at least 1e-6
    EXPECT_NEAR(HWY_DYNAMIC_DISPATCH(step_factor)(0.0, 0.0), floor, 0.08 * floor);
    for (double a : {1e-9, 0.3, 1.0, 7.0, 1e9}) EXPECT_NEAR(HWY_DYNAMIC_DISPATCH(coarse_round_trip)(a), a, 1e-6 * a);
  });
}

}  // namespace pack_test
}  // namespace equipoise
#endif
