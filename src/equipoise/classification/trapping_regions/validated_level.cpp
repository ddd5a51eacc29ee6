// States on a level set, and whether all of them come to the motion inside.
#include "equipoise/classification/trapping_regions/validated_level.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include <Eigen/Core>

#include "equipoise/classification/balanced_regions/balanced_region.hpp"
#include "equipoise/classification/balanced_regions/family_regions.hpp"
#include "equipoise/classification/trapping_regions/region_rule.hpp"
#include "equipoise/core/base/angles.hpp"

namespace equipoise {

namespace {

constexpr double widest_factor = 64.0;
// A trajectory whose V falls to this share has come to the motion; the first part of all trials is followed that far.
// The others stop at come_inside: from there the first ones came to the motion.
constexpr double come_close = 1e-3;
// If other rotors' motions lie farther off, V says too little about states near them: other motions come as close.
constexpr double largest_floor = 0.01;
constexpr TrialCounts orbit_tries{.first_goes_far = true};
// Levels where the search begins. In Floquet coordinates, which have no common size: above any that was found good.
// With the rotor's angle as phase V is |d|^2 or more in natural sizes.
constexpr double highest_by_ball = 16.0, highest_by_rotor = 4.0;
// Motions slower than slowest_worth_it are decided by windows. Balance is not, and deserves more patience.
constexpr double slowest_balance = 2e-4;

// Ten times what the linear flow takes from a level `factor` times the region's own, plus time to come close.
double patience(double factor, double slowest_rate) { return 10.0 * std::log(factor) / -slowest_rate + 500.0; }

// Whether all states tried on the level enter one of the `balanced` regions.
bool all_balance(const BalancedRegion& region, const std::vector<BalancedRegion>& balanced, Directions& directions,
                 const TrialSettings& settings, double slowest_rate, double level, const TryRange& tries) {
  const auto self = static_cast<std::size_t>(
      std::find_if(balanced.begin(), balanced.end(), [&](const BalancedRegion& b) { return b.state == region.state; }) -
      balanced.begin());
  Trials trials =
      trials_from(tries, directions, settings, [&](std::size_t, const Eigen::VectorXd& direction, const OwnRotor* own) {
        return own ? state_on_level(*own, self, level, direction)
                   : state_on_level(*settings.system, region, level, direction);
      });
  trials.rule.balanced = balanced;
  trials.all_fly_for(patience(level / region.level, slowest_rate));
  return all_attracted(std::move(trials), settings);
}

// The row in which trial `i` begins. With the rotor's angle as phase a chunk shares the row, as it shares that angle.
int row_of(const OrbitRegion& region, std::size_t i) {
  if (region.clock == OrbitRegion::rotor) return static_cast<int>(i / trial_chunk) * 7 % region.rows();
  // In an order that spreads any first few trials over the whole orbit (golden section).
  const double share = 0.6180339887498949 * static_cast<double>(i);
  return static_cast<int>(region.rows() * (share - std::floor(share)));
}

// Whether all states tried on the level come to the motion.
bool all_approach(const OrbitRegion& region, Directions& random, const TrialSettings& settings, double slowest_rate,
                  double floor, double level, const TryRange& tries) {
  if (floor > std::min(come_inside * level, largest_floor)) return false;
  const model::System& system = *settings.system;
  Trials trials =
      trials_from(tries, random, settings, [&](std::size_t i, const Eigen::VectorXd& direction, const OwnRotor* own) {
        Eigen::VectorXd z = state_on_level(region, row_of(region, i), level, direction);
        if (own && region.attractor == balanced_id && !system.autonomous())
          z += balanced_shift(own->system, system, region.nodes.front().state);
        return z;
      });
  auto close = std::make_shared<OrbitRegion>(region);
  const bool far = tries.first == 0 && tries.of == orbit_tries.all;
  // A rotor of its own has its motion beside this one, where V does not fall to zero.
  const double share = far ? std::max(come_close, floor / level) : come_inside;
  close->level = share * level;
  set_regions(trials.rule, system, {close}, {});
  const double end = 2.0 * std::log(1.0 / share) / (2.0 * -slowest_rate) + 200.0;
  double cell_angle = 0.0;  // unless it is the phase, the rotor's angle does not matter
  if (region.clock == OrbitRegion::rotor)
    cell_angle = system.section_angle() / region.cells * (system.speed() < 0.0 ? -1.0 : 1.0);
  trials.alike = region.clock != OrbitRegion::rotor;
  trials.flight = [&region, &tries, end, cell_angle](std::size_t first) {
    return Trials::Flight{end, cell_angle * (row_of(region, tries.first + first) % region.cells)};
  };
  return all_attracted(std::move(trials), settings);
}

}  // namespace

double own_floor(const OrbitRegion& region, const TrialSettings& settings, const Motion& motion,
                 const std::function<bool(const model::Parameters&, const Motion&)>& is_it) {
  constexpr std::size_t few = 12;
  constexpr double margin = 4.0, none = std::numeric_limits<double>::infinity();
  const model::System& system = *settings.system;
  double largest = 0.0;
  for (std::size_t k = 0; k < std::min(few, settings.rotors.size()); ++k) {
    const model::System& own = settings.rotors[k].system;
    const auto is_same = [&](const std::optional<Motion>& m) {
      return m && m->stable && m->kind == motion.kind && is_it(own.parameters(), *m);
    };
    auto there = refined_motion(own, motion, settings.stop);
    if (!is_same(there)) there = motion_from(own, motion.state, motion_patience, settings.stop);
    if (!is_same(there)) return none;
    Eigen::VectorXd state = there->state;
    if (region.attractor == balanced_id && !system.autonomous())
      state -= balanced_shift(own, system, region.nodes.front().state);
    OrbitRegion wide = region;  // its V is finite everywhere
    wide.level = none;
    largest = std::max(largest, value(system, wide, state.data(), 0.0));
  }
  return margin * largest;
}

bool validate(std::vector<OrbitRegion>& regions, const TrialSettings& settings, double slowest_rate, double near,
              double floor) {
  const OrbitRegion& one = regions.front();
  if (!(slowest_rate < -(one.attractor == balanced_id ? slowest_balance : slowest_worth_it))) return false;
  const double highest = one.clock == OrbitRegion::rotor ? highest_by_rotor : highest_by_ball;
  Directions random(directions(one));
  const auto good = [&](double tried, const TryRange& tries) {
    return all_approach(one, random, settings, slowest_rate, floor, tried, tries);
  };
  const double level = highest_good_level({highest}, orbit_tries, good, near);
  for (OrbitRegion& region : regions) region.level = level;
  return level > 0.0;
}

void widen(BalancedRegion& region, const std::vector<BalancedRegion>& balanced, const TrialSettings& settings,
           double slowest_rate, double nearest_foreign, double near) {
  double factor = widest_factor;  // no ball may deviate by half a turn on twice the level
  for (int i = 0; i < settings.system->balls(); ++i)
    factor = std::min(factor, 0.5 * std::pow(pi / region.reach[model::index::phi(i)], 2));
  factor = std::min(factor, 0.5 * nearest_foreign / region.level);
  // From half the level down, V decreases on twice the level anyway, and nothing is left to try.
  int halvings = 0;
  while (std::ldexp(factor, -halvings) > 0.5) ++halvings;
  const LevelLadder ladder{2.0 * factor * region.level, halvings};
  Directions directions(settings.system->dimension());
  const auto good = [&](double tried, const TryRange& tries) {
    return all_balance(region, balanced, directions, settings, slowest_rate, tried, tries);
  };
  const double level = highest_good_level(ladder, TrialCounts{}, good, near * region.level);
  set_level(region, level > 0.0 ? level : std::ldexp(factor, -halvings) * region.level);
}

std::vector<char> come_to_balance(std::vector<double> states, const ClassificationRule& rule,
                                  const TrialSettings& settings, double slowest_rate) {
  Trials trials{std::move(states), regions_of(rule)};
  trials.all_fly_for(patience(widest_factor, slowest_rate));
  return come_to(balanced_id, std::move(trials), settings);
}

}  // namespace equipoise
