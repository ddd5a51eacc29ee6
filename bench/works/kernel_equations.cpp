// The equations alone, in as many groups of lanes as an ensemble. Compiled once per instruction set, as kernels are.
#include "kernel_equations.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "works/kernel_equations.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "equipoise/simulation/kernels/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise::bench {
namespace HWY_NAMESPACE {

using namespace ::equipoise::HWY_NAMESPACE;

template <int room>
int evaluate_balls(const model::Parameters& p, double speed, long count, double* checksum) {
  using Flow = FreeFlow<Pack, room, paper_terms(false)>;
  const Flow flow(p, model::Segment{0.0, 0.0, 0.0, speed, 0.0, false});
  constexpr int groups = batch_groups<room>;
  Pack z[groups][Flow::dimension];
  for (int g = 0; g < groups; ++g)
    for (int i = 0; i < flow.size(); ++i) z[g][i] = Pack(0.01 * (i + g));
  for (long k = 0; k < count; ++k)
#pragma GCC unroll 1
    for (int g = 0; g < groups; ++g) {
      Pack rate[Flow::dimension];
      flow(Pack(0.0), z[g], rate);
      for (int i = 0; i < flow.size(); ++i) z[g][i] = multiply_add(Pack(1e-3), rate[i], z[g][i]);
    }
  Pack sum(0.0);
  for (int g = 0; g < groups; ++g)
    for (int i = 0; i < flow.size(); ++i) sum = sum + z[g][i];
  alignas(64) double lanes[8];
  sum.store(lanes);
  *checksum = lanes[0];
  return groups * static_cast<int>(pack_lanes);
}

int evaluate_target(const model::Parameters& p, double speed, long count, double* checksum) {
  return model::with_ball_count(p.balls, [&](auto room) { return evaluate_balls<room>(p, speed, count, checksum); });
}

}  // namespace HWY_NAMESPACE
}  // namespace equipoise::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace equipoise::bench {

HWY_EXPORT(evaluate_target);

int evaluate_derivatives(const model::Parameters& p, double speed, long count, double* checksum) {
  return HWY_DYNAMIC_DISPATCH(evaluate_target)(p, speed, count, checksum);
}

}  // namespace equipoise::bench
#endif
