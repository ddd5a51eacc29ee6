// Follows a motion once round and applies the watch of transients to it.
#include "equipoise/attractors/motions/motion_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/attractors/periodic_orbits/event_run-inl.hpp"
#include "equipoise/attractors/periodic_orbits/tangent_flow-inl.hpp"
#include "equipoise/simulation/transients/transient_watch.hpp"
#include "equipoise/results/types/outcome.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;

using State = std::array<double, kernels::TiltSource::dimension>;  // with room for the largest

constexpr double figure_tolerance = 1e-9;  // figures are stored in single precision, 6e-8
constexpr double least_stretch = 2000;     // for a torus or chaos
constexpr double neutral_rate = 1e-9;      // exponents closer to 0 belong to shifts

MotionFigures figures_of(const TransientSums& sums) {
  const TransientWindow& w = sums.window;
  return {std::sqrt(sums.free_peak.square), std::sqrt(sums.force_peak),
          std::sqrt(w.force / w.length),    std::sqrt(w.velocity / w.length),
          size_of(w.unbalance) / w.length,  std::sqrt(sums.dynamic_peak),
          std::sqrt(w.dynamic / w.length),  std::sqrt(std::max(w.directions[0], w.directions[1]) / w.length)};
}

TransientSettings one_window() {
  TransientSettings settings;
  settings.window = std::numeric_limits<double>::infinity();
  return settings;
}

MotionFigures followed(const model::System& system, const WatchedShaft& shaft, const Motion& motion, double duration) {
  // The rotor's angle is 0 at the motion's state, unless the state contains it.
  const auto sample = [&](double t, const double* z) {
    const model::StateLayout& at = system.layout();
    const double psi = at.psi < 0 ? system.speed() * t : z[at.psi];
    return transient_sample(system.parameters(), shaft, psi, t, z, at.tilt < 0 ? nullptr : z + at.tilt);
  };
  TransientWatch watch(one_window());
  State z{};
  std::copy_n(motion.state.data(), motion.state.size(), z.begin());
  const auto step = [&](double to, auto& state_at) {
    watch.step_to(to, [&](double t) {
      State at;
      state_at(t, at.data());
      return sample(t, at.data());
    });
  };
  if (motion.eventful && duration > 0.0) {  // rates may jump at events
    kernels::EventRun run(system, z.data(), 0.0, kernels::event_scale(system, figure_tolerance));
    long events = -1;
    run.advance(duration, [&](double from, double to, auto& state_at) {
      state_at(from, z.data());
      if (events != run.events()) watch.begin(sample(from, z.data()));
      events = run.events();
      step(to, state_at);
      return false;
    });
    return figures_of(watch.sums());
  }
  watch.begin(sample(0.0, z.data()));
  if (!(duration > 0.0)) return figures_of(watch.sums());
  const auto follow = [&]<class Source>(Source) {
    kernels::SmoothRun<Source>(system, 0.0, figure_tolerance)
        .advance(duration, z.data(), [&](double, double to, auto&& state_at) { step(to, state_at); });
  };
  if (system.tilts())
    follow(kernels::TiltSource{});
  else if (!system.plain())
    follow(kernels::GeneralSource{});
  else
    follow(kernels::PlainSource<model::any_count, kernels::Terms{}>{});
  return figures_of(watch.sums());
}

double stretch(const model::Parameters& p, const Motion& motion) {
  switch (motion.kind) {
    case MotionKind::equilibrium:
      return model::depends_on_rotor_angle(p) ? two_pi / std::fabs(motion.speed) : 0.0;
    case MotionKind::periodic:
      return motion.period;
    default:
      return std::max(least_stretch, motion.duration);
  }
}

// Nothing moves in fixed axes.
bool balanced_exactly(const model::Parameters& p, const Motion& motion) {
  if (motion.kind != MotionKind::equilibrium || p.gravity != 0.0) return false;
  constexpr double rounding = 1e-10;  // refined equilibria are better than this
  if (p.tilts() && motion.state.tail(4).cwiseAbs().maxCoeff() >= rounding) return false;
  return motion.state.head(4).cwiseAbs().maxCoeff() < rounding;
}
}  // namespace

MotionFigures motion_figures(const model::Parameters& p, const Motion& motion, const WatchedShaft& shaft) {
  if (balanced_exactly(p, motion)) return {};
  const model::System system = system_of(p, motion);
  MotionFigures figures = followed(system, shaft, motion, stretch(p, motion));
  const bool at_centre = shaft.places == std::array<double, 2>{};  // where the motion has r_max
  if (at_centre || !p.tilts()) figures.radial = std::max(figures.radial, motion.r_max);
  return figures;
}

KnownEnd known_end(const model::Parameters& p, const Attractor& attractor, const WatchedShaft& shaft) {
  const Motion& motion = attractor.motion;
  if (motion.set_valued) {  // each start comes to its own
    constexpr double time_constants = 5.0;
    const double rate = motion.exponents.empty() ? 0.0 : -motion.exponents.back();
    return {std::nullopt, rate > neutral_rate ? time_constants / rate : 0.0};
  }
  if (attractor.id == balanced_id && p.gravity == 0.0 && p.race_is_centred()) return {MotionFigures{}, 0.0};
  if (motion.kind == MotionKind::measured || motion.state.size() == 0) return {};
  // Members of a continuum around an off-centre race whirl alike. Where a rotor tilts, balls that balance in one plane
  // may be part of a continuum while others do not.
  const bool unique = (attractor.id != balanced_id && !p.tilts()) || p.balls == 1 ||
                      (p.balls == 2 && p.equal_balls()) || (p.gravity == 0.0 && p.isotropic());
  if (unique) return {motion_figures(p, motion, shaft), 0.0};
  constexpr double time_constants = 5.0;  // less than 1 % is left
  double rate = 0.0;
  for (const double exponent : motion.exponents)
    if (exponent < -neutral_rate && (rate == 0.0 || exponent > -rate)) rate = -exponent;
  return {std::nullopt, rate > 0.0 ? time_constants / rate : 0.0};
}

}  // namespace equipoise
