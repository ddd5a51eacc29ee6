// A motion followed once round, and what the watch of transients makes of it.
#include "equipoise/motions/motion_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "equipoise/base/angles.hpp"
#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/integrate/adaptive-inl.hpp"
#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/flow-inl.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/transients/transient_watch.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;

constexpr double tolerance = 1e-9;      // figures are stored in single precision, 6e-8
constexpr double least_stretch = 2000;  // of a torus or of chaos
constexpr double slowest = 1e-9;        // exponents nearer to 0 are those of shifts

MotionFigures figures_of(const TransientSums& sums) {
  const TransientWindow& w = sums.window;
  return {std::sqrt(sums.free_peak), std::sqrt(sums.force_peak), std::sqrt(w.force / w.length),
          std::sqrt(w.velocity / w.length), w.unbalance / w.length};
}

// The rotor's angle is 0 where the motion's state holds.
MotionFigures followed(const model::Parameters& p, const Motion& motion, double duration) {
  using Flow = kernels::FreeFlow<double, model::any_count, kernels::Terms{}>;
  const model::Segment segment{0.0, std::numeric_limits<double>::infinity(), 0.0, motion.speed, 0.0, false};
  TransientSettings settings;
  settings.window = std::numeric_limits<double>::infinity();
  TransientWatch watch(settings);
  std::array<double, Flow::dimension> z;
  std::copy_n(motion.state.data(), motion.state.size(), z.begin());
  watch.begin(transient_sample(p, 0.0, 0.0, z.data()));
  if (duration > 0.0) {
    const Flow flow(p, segment);
    kernels::ErrorScale<Flow::dimension> scale;
    scale.tolerance = tolerance;
    kernels::set_state_scale(p, 1, scale);
    kernels::AdaptiveIntegrator<Flow, Flow::dimension> integrator(flow, scale, flow.size());
    integrator.advance(0.0, duration, z.data(), [&](double, double to, auto&& state_at) {
      watch.step_to(to, [&](double t) {
        std::array<double, Flow::dimension> at;
        state_at(t, at.data());
        return transient_sample(p, segment.psi_at(t), t, at.data());
      });
    });
  }
  return figures_of(watch.sums());
}

double stretch(const model::Parameters& p, const Motion& motion) {
  switch (motion.kind) {
    case MotionKind::equilibrium:
      return model::is_strobed(p) ? two_pi / std::fabs(motion.speed) : 0.0;
    case MotionKind::periodic:
      return motion.period;
    default:
      return std::max(least_stretch, motion.duration);
  }
}

bool balanced_exactly(const model::Parameters& p, const Motion& motion) {
  if (motion.kind != MotionKind::equilibrium || p.gravity != 0.0) return false;
  constexpr double rounding = 1e-10;  // refined equilibria are good to less
  return motion.state.head(4).cwiseAbs().maxCoeff() < rounding;
}
}  // namespace

MotionFigures motion_figures(const model::Parameters& p, const Motion& motion) {
  if (balanced_exactly(p, motion)) return {};
  MotionFigures figures = followed(p, motion, stretch(p, motion));
  figures.radial = std::max(figures.radial, motion.r_max);
  return figures;
}

KnownEnd known_end(const model::Parameters& p, const Attractor& attractor) {
  const Motion& motion = attractor.motion;
  if (motion.kind == MotionKind::measured || motion.state.size() == 0) return {};
  if (attractor.id == balanced_id && p.gravity == 0.0) return {MotionFigures{}, 0.0};
  const bool unique = attractor.id != balanced_id || p.balls == 1 || (p.balls == 2 && p.equal_balls());
  if (unique) return {motion_figures(p, motion), 0.0};
  constexpr double time_constants = 5.0;  // what is left is below 1 %
  double rate = 0.0;
  for (const double exponent : motion.exponents)
    if (exponent < -slowest && (rate == 0.0 || exponent > -rate)) rate = -exponent;
  return {std::nullopt, rate > 0.0 ? time_constants / rate : 0.0};
}

}  // namespace equipoise
