// One level for states that are images of each other.
#include "equipoise/discovery/balanced_levels.hpp"

#include <algorithm>
#include <utility>

#include "equipoise/proof/certificate.hpp"
#include "equipoise/traps/balanced_trap.hpp"
#include "equipoise/traps/touching.hpp"
#include "equipoise/traps/validated_level.hpp"

namespace equipoise {

namespace {

// Calls level(trap) for each trap, or for the first if exchange of the balls makes the other one from it.
template <class Level>
void level_each(std::vector<BalancedTrap>& traps, const model::Parameters& p, Level&& level) {
  const bool images = p.balls == 2 && p.equal_balls();
  for (std::size_t i = 0; i < traps.size(); ++i) {
    if (!images || i == 0) {
      level(traps[i]);
      continue;
    }
    set_level(traps[i], traps[0].level);
    traps[i].by = traps[0].by;
  }
}

// The smallest V on any of the pilot's trajectories that ended elsewhere. What is undecided is followed on: it may be
// on its slow way to balance. Of these the ones that came nearest to balance are the first, and no more than tell.
double nearest_elsewhere(const DecisionRule& rule, const TrialSettings& settings, double slowest_rate,
                         const PilotRun& pilot) {
  constexpr std::size_t together = 32;  // fill the lanes
  const auto least = [&](std::size_t i) { return pilot.records()[i].least_value; };
  double nearest = 1e300;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < pilot.followed(); ++i) {
    const Fate& fate = pilot.fates()[i];
    if (fate.attractor == balanced_id) continue;
    if (fate.outcome == Outcome::undecided)
      open.push_back(i);
    else
      nearest = std::min(nearest, least(i));
  }
  std::stable_sort(open.begin(), open.end(), [&](std::size_t a, std::size_t b) { return least(a) < least(b); });
  for (std::size_t first = 0; first < open.size() && least(open[first]) < nearest; first += together) {
    const std::size_t count = std::min(together, open.size() - first);
    std::vector<double> states;
    std::vector<OwnRotor> rotors;
    for (std::size_t k = 0; k < count; ++k) {
      const auto state = pilot.state(open[first + k]);
      states.insert(states.end(), state.begin(), state.end());
      if (const OwnRotor* own = pilot.rotor(open[first + k])) rotors.push_back(*own);
    }
    TrialSettings own = settings;
    own.rotors = rotors;
    const std::vector<char> came = come_to_balance(std::move(states), rule, own, slowest_rate);
    for (std::size_t k = 0; k < count; ++k)
      if (!came[k]) nearest = std::min(nearest, least(open[first + k]));
  }
  return nearest;
}

}  // namespace

void prove_levels(std::vector<BalancedTrap>& traps, const TrialSettings& settings) {
  const model::System& system = *settings.system;
  level_each(traps, system.parameters(), [&](BalancedTrap& trap) {
    const Certificate certificate =
        largest_certificate(system, trap.phi.data(), form_of(trap), trap.level / level_margin, nullptr, settings.stop);
    // What the kernels compute in place of V is off by rounding: a part in 10^13.
    set_level(trap, certificate.level * (1.0 - 1e-9));
    trap.by = DecidedBy::proof;
  });
}

double widen_levels(DecisionRule& rule, const TrialSettings& settings, double slowest_rate, const PilotRun& pilot,
                    double near) {
  std::vector<BalancedTrap>& traps = rule.balanced;
  if (traps.empty()) return 0.0;
  const std::vector<BalancedTrap> narrow = traps;
  double nearest_foreign = nearest_elsewhere(rule, settings, slowest_rate, pilot);
  // Twice the level is tried, where no balls may overlap.
  for (const BalancedTrap& trap : narrow)
    nearest_foreign = std::min(nearest_foreign, touching_level(*settings.system, trap));
  level_each(traps, settings.system->parameters(),
             [&](BalancedTrap& trap) { widen(trap, narrow, settings, slowest_rate, nearest_foreign, near); });
  return traps.front().level / narrow.front().level;
}

}  // namespace equipoise
