// Which balanced motions exist, by continuation under gravity, and their stability, by eigenvalues or multipliers.
#include "equipoise/classification/balanced_regions/balanced_analysis.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "equipoise/attractors/periodic_orbits/stroboscopic_section.hpp"
#include "equipoise/classification/balanced_regions/balanced_region.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/balance/room_in_race.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"

namespace equipoise {

namespace {

using Angles = std::array<double, model::max_balls>;

// Rounding moves an eigenvalue by about 1e-15; a rate this small would need a horizon of 1e9 to show.
constexpr double least_rate = 1e-9;

struct Balance {
  const model::System& system;
  double speed;  // psi' in balance
};

// `reached`: the share of gravity and anisotropy up to which the motion exists.
std::optional<Motion> balanced_motion(const Balance& at, const Angles& phi, const StopFlag* stop,
                                      double* reached = nullptr) {
  if (at.system.autonomous()) {
    const auto refined = refine_equilibrium(at.system, model::balanced_state(at.system, at.speed, phi.data()));
    return refined ? std::optional(describe_equilibrium(at.system, *refined)) : std::nullopt;
  }
  const auto orbit = balanced_orbit(at.system, phi.data(), reached, stop);
  if (!orbit) return std::nullopt;
  Motion motion = describe_orbit(at.system, *orbit);
  motion.balanced = true;  // it was continued from a balanced state
  return motion;
}

// Rate of the deviation that dies out slowest, or grows fastest.
double rate_of(const Balance& at, const Angles& phi, const Motion& motion) {
  if (!at.system.autonomous()) return motion.orbit.slowest_rate();
  return dense::largest_real_part(model::jacobian(at.system, model::balanced_state(at.system, at.speed, phi.data())));
}

void analyse_continuum(const Balance& at, const StopFlag* stop, BalancedAnalysis& result) {
  // Where nothing rests, or linear theory has nothing to say, starts have to find the balanced motions.
  const bool rests = model::balanced_freedom(at.system) > 0;
  result.stable = true;
  if (!ContinuumOfEquilibria::is_of(at.system)) return;
  result.continuum = std::make_shared<ContinuumOfEquilibria>(at.system);
  result.sample = result.continuum->sample(stop);
  const ContinuumSample& sample = result.sample;
  result.stable = sample.attracts() || !rests;
  result.growth_rate = sample.most_growth;
  if (!result.stable && sample.drawn > 0)
    result.note
        .add(fmt::format("the balanced states form a continuum, and all {} drawn evenly from it are unstable ",
                         sample.drawn))
        .add_speed(at.speed)
        .add(" ")
        .add_rates(sample.least_growth, sample.most_growth);
  if (!rests || sample.drawn == 0 || is_set(stop)) return;
  if (auto motion = balanced_motion(at, sample.typical, stop)) result.motions.push_back(*std::move(motion));
}

// What keeps the balanced state from resting, and how much of that the motion that it becomes survives.
std::string lost_motion(const model::Parameters& p, double reached) {
  const bool gravity = p.gravity != 0.0, unequal = !p.isotropic();
  return fmt::format(
      "no balanced motion was found: the motion that grows out of the balanced state as {} switched on can be followed "
      "to {:.2g} % of {}",
      gravity && unequal ? "gravity and the supports' difference are"
      : gravity          ? "gravity is"
                         : "the supports' difference is",
      100.0 * reached, gravity && unequal ? "both" : "it");
}

Note instability(const BalancedAnalysis& result, double speed) {
  Note note;
  note.add("the balanced state exists but is ");
  if (result.growth_rate > least_rate)
    return note.add("unstable ").add_speed(speed).add(" ").add_rates(result.growth_rate, result.growth_rate);
  return note.add("not linearly stable ").add_speed(speed).add(" (largest rate 0)");
}

void analyse_isolated(const Balance& at, const StopFlag* stop, const std::vector<ModeWeight>& known,
                      BalancedAnalysis& result) {
  const model::Parameters& p = at.system.parameters();
  std::vector<Angles> angles = result.states.angles;
  const std::size_t most_regions = p.tilts() ? most_balanced_of_tilt : most_balanced;
  const bool images = p.balls == 2 && p.equal_balls() && angles.size() == 2;
  if (images) angles.pop_back();  // the other one follows by exchange of the balls
  double slowest = -std::numeric_limits<double>::infinity(), farthest = 0.0;
  for (std::size_t number = 0; number < angles.size(); ++number) {
    const Angles& phi = angles[number];
    if (is_set(stop)) return;
    if (!model::has_room(p, phi.data())) continue;
    double reached = 0.0;
    auto motion = balanced_motion(at, phi, stop, &reached);
    farthest = std::max(farthest, reached);
    if (!motion) continue;
    const double rate = rate_of(at, phi, *motion);
    result.motions.push_back(*std::move(motion));
    if (!(rate < -least_rate)) {
      result.growth_rate = std::max(result.growth_rate, rate);
      continue;
    }
    slowest = std::max(slowest, rate);
    result.stable = true;
    if (!at.system.autonomous() || result.regions.size() == most_regions) continue;
    std::vector<ModeWeight> weights = known;
    result.regions.push_back(balanced_region(at.system, phi, weights));
    if (result.weights.empty()) result.weights = std::move(weights);
    BalancedRegion& region = result.regions.back();
    set_level(region, std::min(region.level, touching_level(at.system, region)));
    region.state = static_cast<int>(number);
    if (!images) continue;
    result.regions.push_back(exchanged(result.regions.back()));
    result.regions.back().state = 1;
  }
  std::stable_partition(result.motions.begin(), result.motions.end(), [](const Motion& m) { return m.stable; });
  if (result.stable)
    result.slowest_rate = slowest;
  else if (result.motions.empty())
    result.note = lost_motion(p, farthest);
  else
    result.note = instability(result, at.speed);
}

}  // namespace

BalancedAnalysis analyse_balanced(const model::System& system, const StopFlag* stop,
                                  const std::vector<ModeWeight>& weights) {
  using Kind = model::BalancedStates::Kind;
  constexpr double any_speed = 1.0;
  BalancedAnalysis result;
  result.states = model::balanced_states(system, any_speed);
  const Balance at{system, model::balanced_speed(system).value_or(0.0)};
  if (result.states.kind == Kind::none) {
    result.note = fmt::format("no balanced state exists: {}", result.states.reason);
  } else if (system.coasts()) {
    result.stable = true;  // or not, depending on the speed that is left
  } else if (system.events().stick) {
    result.stable = true;  // near one: where balls stick, no single state attracts
  } else if (result.states.kind == Kind::continuum) {
    analyse_continuum(at, stop, result);
  } else {
    analyse_isolated(at, stop, weights, result);
  }
  return result;
}

}  // namespace equipoise
