// One level serves balanced states that are images of each other.
#include "equipoise/classification/attractor_search/search.hpp"

#include <algorithm>
#include <utility>

#include "equipoise/classification/balanced_regions/balanced_region.hpp"
#include "equipoise/classification/proved_regions/certificate.hpp"
#include "equipoise/classification/trapping_regions/trials.hpp"

namespace equipoise {

namespace {

// Calls level(region) for each trapping region, or only for the first if an exchange of the balls maps it to the other.
template <class Level>
void level_each(std::vector<BalancedRegion>& regions, const model::Parameters& p, Level&& level) {
  const bool images = p.balls == 2 && p.equal_balls();
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (!images || i == 0) {
      level(regions[i]);
      continue;
    }
    set_level(regions[i], regions[0].level);
    regions[i].by = regions[0].by;
  }
}

// The smallest V on pilot trajectories that ended elsewhere. Undecided ones may be on a slow way to balance. They are
// followed on, nearest first, until no other can be nearer than one that ended elsewhere.
double nearest_elsewhere(const Search& s) {
  const PilotRun& pilot = s.pilot;
  constexpr std::size_t together = 32;  // they fill the lanes
  const auto least = [&](std::size_t i) { return pilot.records()[i].least_value; };
  double nearest = 1e300;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < pilot.followed(); ++i) {
    const Outcome& outcome = pilot.outcomes()[i];
    if (outcome.attractor == balanced_id) continue;
    if (outcome.kind == OutcomeKind::undecided)
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
    TrialSettings own = s.trials;
    own.rotors = rotors;
    const std::vector<char> came =
        come_to_balance(std::move(states), s.result.rule, own, s.result.balanced.slowest_rate);
    for (std::size_t k = 0; k < count; ++k)
      if (!came[k]) nearest = std::min(nearest, least(open[first + k]));
  }
  return nearest;
}

}  // namespace

void prove_levels(Search& s) {
  level_each(s.result.rule.balanced, s.system.parameters(), [&](BalancedRegion& region) {
    const Certificate certificate = largest_certificate(s.system, region.angles(), form_of(region),
                                                        region.level / level_margin, nullptr, s.settings.stop);
    // The kernels' V is off by rounding, a part in 10^13.
    set_level(region, certificate.level * (1.0 - 1e-9));
    region.by = DecidedBy::proof;
  });
}

double widen_levels(Search& s) {
  std::vector<BalancedRegion>& regions = s.result.rule.balanced;
  if (regions.empty()) return 0.0;
  const std::vector<BalancedRegion> narrow = regions;
  double nearest_foreign = nearest_elsewhere(s);
  // Twice the level is tried, and no balls may overlap there.
  for (const BalancedRegion& region : narrow)
    nearest_foreign = std::min(nearest_foreign, touching_level(s.system, region));
  const double near = s.settings.warm_start_levels.level(balanced_id);
  level_each(regions, s.system.parameters(), [&](BalancedRegion& region) {
    widen(region, narrow, s.trials, s.result.balanced.slowest_rate, nearest_foreign, near);
  });
  return regions.front().level / narrow.front().level;
}

}  // namespace equipoise
