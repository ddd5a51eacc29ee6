// Floating-point operations of the kernels. This file is compiled with bench/counting before Highway's own headers.
#include "kernel_count.hpp"

#include <memory>

#include "equipoise/simulation/batch/batch_block-inl.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/flow-inl.hpp"

namespace equipoise::bench {

namespace {

namespace counting = equipoise::N_COUNTING;
using counting::Pack;
constexpr counting::Terms terms = counting::paper_terms(false);

hwy::N_COUNTING::Operations& operations() { return hwy::N_COUNTING::operations; }

}  // namespace

FlopCount count_right_hand_side(const model::Parameters& p) {
  return model::with_ball_count(p.balls, [&](auto room) {
    using Flow = counting::FreeFlow<Pack, room, terms>;
    const Flow flow(p, model::Segment{0.0, 0.0, 0.0, 2.4, 0.0, false});
    Pack z[Flow::dimension], rate[Flow::dimension];
    for (int i = 0; i < flow.size(); ++i) z[i] = Pack(0.01 * i);
    operations() = {};
    flow(Pack(0.0), z, rate);
    return FlopCount{operations().flops(), 2 * operations().fused, operations().divide + operations().root};
  });
}

double count_step(const model::Parameters& p, double speed, double* state, double end) {
  using Flow = counting::FreeFlow<Pack, 2, terms>;
  BatchWork work;
  BatchTask task;
  task.parameters = &p;
  task.segment = {0.0, end, 0.0, speed, 0.0, false};
  task.end = end;
  task.count = 1;
  task.states = state;
  task.work = &work;
  counting::NoObserver observer;
  const auto block =
      std::make_unique<counting::BatchBlock<Flow, counting::NoObserver, 1>>(task, Flow(p, task.segment), observer);
  operations() = {};
  block->run();
  return static_cast<double>(operations().flops()) / static_cast<double>(work.steps);
}

}  // namespace equipoise::bench
