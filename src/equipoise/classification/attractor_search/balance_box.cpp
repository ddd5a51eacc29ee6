// The box of balance, for a continuum of balanced states of which nothing is at rest. Bounds follow from the rotor
// alone, the time from how fast deviations grow.
#include "equipoise/classification/attractor_search/search.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/attractors/equilibria/stuck.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"

namespace equipoise {

namespace {

// How long balance must last: e^10 of the fastest growth anywhere on the continuum; or, if all of it attracts, e^5 of
// the slowest decay. At most a quarter of the horizon.
double lasting(const ContinuumSample& sample, double horizon) {
  constexpr double growing = 10.0, dying = 5.0, least = 200.0, long_enough = 1000.0;
  double asked = long_enough;
  if (sample.most_growth > 0.0)
    asked = std::max(growing / sample.most_growth, long_enough);
  else if (sample.drawn > 0 && sample.stable == sample.drawn)
    asked = std::clamp(-dying / sample.slowest_rate, least, long_enough);
  return std::min(asked, 0.25 * horizon);
}

}  // namespace

std::optional<FeatureBox> balance_box(const model::System& system, const BalancedAnalysis& balanced, double window,
                                      double horizon) {
  const auto speed = model::balanced_speed(system);
  if (system.autonomous() || system.events().stick || !speed || *speed == 0.0) return std::nullopt;
  if (balanced.states.kind != model::BalancedStates::Kind::continuum) return std::nullopt;
  constexpr double of_speed = 0.05;  // share by which the speed may waver; balls may swing as fast, beyond what their
                                     // weight does
  const model::Parameters& p = system.parameters();
  const double time = lasting(balanced.sample, horizon), turning = std::fabs(*speed);
  const double shaking = 0.5 * bare_response(p, *speed), swing = of_speed * turning + 2.0 * p.gravity / turning;
  const double drift = pi / time;  // half a turn in that time
  FeatureBox box;
  for (int k = 0; k < 3; ++k) box.high[k] = shaking;
  for (int i = 0; i < p.balls; ++i)
    for (int k = 0; k < 3; ++k) {
      box.high[3 + 3 * i + k] = k == 0 ? drift : swing;
      box.low[3 + 3 * i + k] = -box.high[3 + 3 * i + k];
    }
  for (int k = speed_feature(p.balls); k < feature_count(p.balls); ++k) {
    box.low[k] = system.prescribed() ? 0.0 : *speed - of_speed * turning;
    box.high[k] = system.prescribed() ? 0.0 : *speed + of_speed * turning;
  }
  box.attractor = balanced_id;
  box.hits_needed = static_cast<int>(std::ceil(2.0 * time / window));
  return box;
}

}  // namespace equipoise
