// Bounds within which lanes test, and levels that trials passed.
#include "equipoise/classification/trapping_regions/path_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace equipoise {

namespace {

constexpr double window = 4.0;  // of trials, tested twice in it
// Share of the time that the slowest approach takes: other directions fall faster.
constexpr double approach = 0.5;
constexpr double away_in_window = 2.0;
constexpr int watched_half_windows = 12;

}  // namespace

double PathRegion::time_to_level(double value) const {
  return std::isfinite(value) && level_ > 0.0 && rate_ < 0.0 ? std::log(value / level_) / (-2.0 * rate_) : 0.0;
}

void PathRegion::hold(const Eigen::VectorXd& state) {
  low_ = low_.size() > 0 ? low_.cwiseMin(state).eval() : state;
  high_ = high_.size() > 0 ? high_.cwiseMax(state).eval() : state;
  double r2 = state.head<2>().squaredNorm();
  constexpr int of_tilt = 4;  // variables, more than any drive has, at the state's end; windows count slopes in r
  if (state.size() - model::dimension(balls_) >= of_tilt) r2 += state.tail(of_tilt).head<2>().squaredNorm();
  r2_low_ = std::min(r2_low_, r2);
  r2_high_ = std::max(r2_high_, r2);
}

double PathRegion::value(const double* state, const OwnRotor* own) const {
  double least = infinite;
  std::array<double, max_dimension> placed{};
  for (const Eigen::VectorXi& places : places_) {
    for (Eigen::Index i = 0; i < places.size(); ++i) placed[i] = state[places[i]];
    if (may_hold(placed.data())) least = std::min(least, value_in_place(placed.data(), own));
  }
  return least;
}

bool PathRegion::may_hold(const double* state) const {
  const double reach = level_ > 0.0 ? between_ + std::sqrt(level_) : infinite;
  for (Eigen::Index i = 0; i < low_.size(); ++i) {
    if (i >= 4 && i < 4 + balls_) continue;
    const double far = reach / inverse_scale_[i];
    if (!(state[i] > low_[i] - far && state[i] < high_[i] + far)) return false;
  }
  return true;
}

// By how much further off the states of a window may lie that ends inside the region.
void PathRegion::widen(WindowRegions& bounds) const {
  const double far = between_ + away_in_window * std::sqrt(level_);
  const double r = std::max(0.0, std::sqrt(r2_low_) - far / inverse_scale_[0]);
  bounds.r2_low = std::min(bounds.r2_low, r * r - 1e-300);
  bounds.r2_high = std::max(bounds.r2_high, std::pow(std::sqrt(r2_high_) + far / inverse_scale_[0], 2));
  for (int i = 4 + balls_; i < 4 + 2 * balls_; ++i) {
    bounds.q_low = std::min(bounds.q_low, low_[i] - far / inverse_scale_[i]);
    bounds.q_high = std::max(bounds.q_high, high_[i] + far / inverse_scale_[i]);
  }
}

bool validate(const std::shared_ptr<PathRegion>& region, const LevelLadder& ladder, const TrialSettings& settings,
              double near) {
  // Spread over the motion, whatever the order of its states.
  const auto state = [&](const Trial& trial) {
    return region->state_on_level(trial.number * 40503, trial.level, trial.direction, trial.own);
  };
  const auto complete = [&](Trials& trials, double level, const TryRange& tries) {
    const double share = std::max(tries.goes_far() ? come_close : come_inside, 4.0 * region->floor() / level);
    if (share > come_inside) return false;
    region->set_level(share * level);
    trials.rule.window = window;
    set_window_regions(trials.rule, {region});
    // Twice what the slowest approach takes, plus time to come close.
    trials.all_fly_for(2.0 * region->time_to_level(level) + 200.0);
    return true;
  };
  const Eigen::Index size = settings.system->dimension();
  region->set_level(level_by_trials(settings, size, ladder, {.first_goes_far = true}, near, state, complete));
  return region->level() > 0.0;
}

void set_window_regions(ClassificationRule& rule, const std::vector<std::shared_ptr<const PathRegion>>& regions) {
  rule.windowed = {};
  if (regions.empty()) return;
  rule.windowed.watched = watched_half_windows;
  rule.windowed.r2_low = rule.windowed.q_low = infinite;
  rule.windowed.r2_high = rule.windowed.q_high = -infinite;
  for (const auto& region : regions) region->widen(rule.windowed);
  rule.windowed.regions = regions_by([regions](const double* state, double, const OwnRotor* own) -> Caught {
    double wait = infinite;
    for (const auto& region : regions) {
      const double value = region->value(state, own);
      if (value < region->level()) return {region->attractor(), 0.0};
      wait = std::min(wait, region->time_to_level(value));
    }
    return {0, approach * wait};
  });
}

}  // namespace equipoise
