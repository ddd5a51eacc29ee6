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
// If other rotors' motions lie farther off, V says too little about states near them: other motions come as close.
constexpr double largest_floor = 0.01;
// Levels where the search begins. In Floquet coordinates, which have no common size: above any that was found good.
// With the rotor's angle as phase V is |d|^2 or more in natural sizes.
constexpr double highest_by_ball = 16.0, highest_by_rotor = 4.0;
// Motions slower than slowest_worth_it are decided by windows. Balance is not, and deserves more patience.
constexpr double slowest_balance = 2e-4;

// Ten times what the linear flow takes from a level `factor` times the region's own, plus time to come close.
double patience(double factor, double slowest_rate) { return 10.0 * std::log(factor) / -slowest_rate + 500.0; }

// The row in which trial `i` begins. With the rotor's angle as phase a chunk shares the row, as it shares that angle.
int row_of(const OrbitRegion& region, std::size_t i) {
  if (region.clock == OrbitRegion::rotor) return static_cast<int>(i / trial_chunk) * 7 % region.rows();
  // In an order that spreads any first few trials over the whole orbit (golden section).
  const double share = 0.6180339887498949 * static_cast<double>(i);
  return static_cast<int>(region.rows() * (share - std::floor(share)));
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
  const model::System& system = *settings.system;
  const bool by_rotor = one.clock == OrbitRegion::rotor;
  const double highest = by_rotor ? highest_by_rotor : highest_by_ball;
  // Unless it is the phase, the rotor's angle does not matter.
  const double cell_angle = by_rotor ? system.section_angle() / one.cells * (system.speed() < 0.0 ? -1.0 : 1.0) : 0.0;
  const auto state = [&](const Trial& trial) {
    Eigen::VectorXd z = state_on_level(one, row_of(one, trial.number), trial.level, trial.direction);
    if (trial.own && one.attractor == balanced_id && !system.autonomous())
      z += balanced_shift(trial.own->system, system, one.nodes.front().state);
    return z;
  };
  const auto complete = [&](Trials& trials, double tried, const TryRange& tries) {
    if (floor > std::min(come_inside * tried, largest_floor)) return false;
    auto close = std::make_shared<OrbitRegion>(one);
    // A rotor of its own has its motion beside this one, where V does not fall to zero.
    const double share = tries.goes_far() ? std::max(come_close, floor / tried) : come_inside;
    close->level = share * tried;
    set_regions(trials.rule, system, {close}, {});
    const double end = 2.0 * std::log(1.0 / share) / (2.0 * -slowest_rate) + 200.0;
    trials.alike = !by_rotor;
    trials.flight = [&one, &tries, end, cell_angle](std::size_t first) {
      return Trials::Flight{end, cell_angle * (row_of(one, tries.first + first) % one.cells)};
    };
    return true;
  };
  const double level =
      level_by_trials(settings, directions(one), {highest}, {.first_goes_far = true}, near, state, complete);
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
  const auto self = static_cast<std::size_t>(
      std::find_if(balanced.begin(), balanced.end(), [&](const BalancedRegion& b) { return b.state == region.state; }) -
      balanced.begin());
  const auto state = [&](const Trial& trial) {
    return trial.own ? state_on_level(*trial.own, self, trial.level, trial.direction)
                     : state_on_level(region, trial.level, trial.direction);
  };
  const auto complete = [&](Trials& trials, double tried, const TryRange&) {
    trials.rule.balanced = balanced;
    trials.all_fly_for(patience(tried / region.level, slowest_rate));
    return true;
  };
  const double level =
      level_by_trials(settings, settings.system->dimension(), ladder, {}, near * region.level, state, complete);
  set_level(region, level > 0.0 ? level : std::ldexp(factor, -halvings) * region.level);
}

std::vector<char> come_to_balance(std::vector<double> states, const ClassificationRule& rule,
                                  const TrialSettings& settings, double slowest_rate) {
  Trials trials{std::move(states), rule};
  trials.rule.blind = trials.rule.at_horizon = false;
  trials.rule.boxes.clear();
  trials.rule.known.clear();
  trials.rule.first_long_window = after_all_else;
  trials.all_fly_for(patience(widest_factor, slowest_rate));
  return which_balance(std::move(trials), settings);
}

}  // namespace equipoise
