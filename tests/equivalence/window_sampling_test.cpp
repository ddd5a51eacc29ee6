// How densely windows are sampled, against the periods of all motions.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/analyses/one_study/attractors.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/simulation/batch/batch_block-inl.hpp"
#include "equipoise/machine/model/flow-inl.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {
namespace window_sampling_test {

namespace kernels = HWY_NAMESPACE;

// Remembers the longest accepted step after a time.
struct StepWatch : kernels::NoObserver {
  double after = 0.0, longest = 0.0;

  unsigned step(int, unsigned, kernels::Mask accepted, kernels::Pack t, kernels::Pack h, const kernels::Pack*) {
    const double time = reinterpret_cast<const double*>(&t)[0];
    if ((kernels::lane_bits(accepted) & 1u) && time > after)
      longest = std::max(longest, reinterpret_cast<const double*>(&h)[0]);
    return 0;
  }
};

double longest_step(const model::Parameters& p, double speed, const Eigen::VectorXd& begin) {
  std::vector<double> state(begin.data(), begin.data() + begin.size());
  BatchTask task;
  task.parameters = &p;
  task.segment = {0.0, 1e300, 0.0, speed, 0.0, false};
  task.end = 400.0;
  task.tolerance = default_basin_tolerance;
  task.count = 1;
  task.states = state.data();
  StepWatch watch;
  watch.after = 100.0;
  using Flow = kernels::FreeFlow<kernels::Pack, 2, kernels::paper_terms(false)>;
  const Flow flow(p, task.segment);
  kernels::BatchBlock<Flow, StepWatch, 1> block(task, flow, watch);
  EXPECT_TRUE(block.run());
  return watch.longest;
}

// For every attractor at both ends of the drags and speeds studied: its period, or a turn of the fastest ball if it has
// none.
TEST(Windows, AreSampledEightTimesAPeriodOfEveryMotion) {
  for (const auto& [drag, speed] : {std::pair{0.01, 6.0}, {0.05, 2.2}, {0.05, 6.0}}) {
    Study study;
    study.parameters.mass = {0.05, 0.05};
    study.parameters.drag = {drag, drag};
    study.speed.speed = speed;
    AttractorsOptions options;
    options.starts = 1;
    const std::vector<Attractor> known = attractors(study, options).attractors;
    EXPECT_GE(known.size(), 2u);
    for (const Attractor& a : known) {
      const Motion& m = a.motion;
      if (m.kind == MotionKind::equilibrium) continue;
      const double fastest = std::max({-m.rate_min[0], -m.rate_min[1], m.rate_max[0], m.rate_max[1]});
      const double period = m.kind == MotionKind::periodic ? std::min(m.period, two_pi / fastest) : two_pi / fastest;
      // Samples lie at 1/3, 0.6 and 1 of every step: the widest gap is 0.4 of it.
      EXPECT_GE(period / (0.4 * longest_step(study.parameters, speed, m.state)), 8.0)
          << a.name << ", drag " << drag << ", speed " << speed;
    }
  }
}

}  // namespace window_sampling_test
}  // namespace equipoise
