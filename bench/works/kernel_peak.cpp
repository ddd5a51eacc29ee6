// The most floating-point operations a second that the instruction set in use allows. Compiled once per instruction
// set.
#include "kernel_peak.hpp"

#include "../timing.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "works/kernel_peak.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace equipoise::bench {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Ten sums side by side: enough for two multiply-adds a cycle of up to five cycles each, and few enough for the sixteen
// registers of AVX2. Returns what the sums came to, so that they are not left out. Every sum tends to 2.
double multiply_adds(long rounds) {
  const HWY_CAPPED(double, 8) d;
  const auto half = hn::Set(d, 0.5), one = hn::Set(d, 1.0);
  auto a = hn::Set(d, 0.1), b = hn::Set(d, 0.2), c = hn::Set(d, 0.3), e = hn::Set(d, 0.4), f = hn::Set(d, 0.5);
  auto g = hn::Set(d, 0.6), h = hn::Set(d, 0.7), i = hn::Set(d, 0.8), j = hn::Set(d, 0.9), k = hn::Set(d, 1.1);
  for (long r = 0; r < rounds; ++r) {
    a = hn::MulAdd(a, half, one);
    b = hn::MulAdd(b, half, one);
    c = hn::MulAdd(c, half, one);
    e = hn::MulAdd(e, half, one);
    f = hn::MulAdd(f, half, one);
    g = hn::MulAdd(g, half, one);
    h = hn::MulAdd(h, half, one);
    i = hn::MulAdd(i, half, one);
    j = hn::MulAdd(j, half, one);
    k = hn::MulAdd(k, half, one);
  }
  const auto sum =
      hn::Add(hn::Add(hn::Add(hn::Add(a, b), hn::Add(c, e)), hn::Add(hn::Add(f, g), hn::Add(h, i))), hn::Add(j, k));
  return hn::GetLane(sum);
}

long flops_a_round() { return 2 * 10 * static_cast<long>(hn::Lanes(HWY_CAPPED(double, 8)())); }

}  // namespace HWY_NAMESPACE
}  // namespace equipoise::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace equipoise::bench {

HWY_EXPORT(multiply_adds);
HWY_EXPORT(flops_a_round);

double multiply_add_peak(double seconds) {
  volatile double sink = HWY_DYNAMIC_DISPATCH(multiply_adds)(100'000);
  double done = 0.0;
  const double begin = thread_seconds();
  double taken = 0.0;
  for (; taken < seconds; taken = thread_seconds() - begin) {
    sink = HWY_DYNAMIC_DISPATCH(multiply_adds)(100'000);
    done += 1e5 * static_cast<double>(HWY_DYNAMIC_DISPATCH(flops_a_round)());
  }
  (void)sink;
  return done / taken;
}

}  // namespace equipoise::bench
#endif
