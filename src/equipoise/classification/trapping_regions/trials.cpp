// Runs trials in chunks on all threads, and searches for levels by them: states on a level set, and whether all of them
// end in the motion inside.
#include "equipoise/classification/trapping_regions/trials.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "equipoise/classification/balanced_regions/family_regions.hpp"
#include "equipoise/classification/trapping_regions/region_rule.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/results/types/outcome.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"

namespace equipoise {

namespace {

// Lanes seldom wait for the last state of a large chunk; several threads need several chunks.
std::size_t chunk_of(const Trials& trials, const TrialSettings& settings) {
  return trials.alike && settings.threads == 1 ? trial_part : trial_chunk;
}

// Calls told(first, outcomes) for every chunk, from any thread, until it returns false or lanes are stopped.
template <class Told>
bool follow(Trials& trials, const TrialSettings& settings, Told&& told) {
  const std::size_t size = settings.system->dimension(), total = trials.states.size() / size;
  const std::size_t chunk = chunk_of(trials, settings);
  std::atomic<bool> good{true};
  if (settings.progress) settings.progress->begin("states tried on level sets");
  in_parallel(settings.threads, (total + chunk - 1) / chunk, [&](std::size_t k) {
    if (!good) return;
    const std::size_t first = k * chunk;
    const Trials::Flight flight = trials.flight(first);
    BatchTask task = batch_task(*settings.system, flight.psi);
    task.end = flight.end;
    task.tolerance = settings.tolerance;
    task.stop = settings.stop;
    const std::size_t count = std::min(chunk, total - first);
    std::vector<OwnRotor> rotors;
    for (std::size_t i = 0; i < count && !settings.rotors.empty(); ++i) {
      OwnRotor& rotor = rotors.emplace_back(*settings.rotor(trials.first + first + i));
      rotor.segment.psi = flight.psi;
      rotor.end = flight.end;
    }
    const std::vector<const OwnRotor*> own = pointers_to(rotors);
    task.take({&trials.states[first * size], count * size}, own, {});
    std::vector<Outcome> outcomes(count);
    if (!classify_batch(task, trials.rule, outcomes, nullptr) || !told(first, outcomes)) good = false;
    if (settings.progress) settings.progress->add(count);
  });
  return good;
}

bool is_attracted(const Outcome& outcome) { return outcome.kind == OutcomeKind::attracted; }

}  // namespace

ClassificationRule rule_of_regions(const model::System& system) {
  ClassificationRule rule;
  rule.balls = system.balls();
  rule.first_long_window = after_all_else;
  // If the rotor's angle matters, and for continua off centre, regions are tested where half a short window ends.
  if (system.autonomous() && (system.parameters().race_is_centred() || model::balanced_freedom(system) == 0))
    rule.window = after_all_else;
  return rule;
}

bool all_attracted(Trials trials, const TrialSettings& settings) {
  return noted(settings.notes, "all attracted", settings.stop, [&] {
    return follow(trials, settings, [](std::size_t, const std::vector<Outcome>& outcomes) {
      return std::all_of(outcomes.begin(), outcomes.end(), is_attracted);
    });
  });
}

namespace {

constexpr int steps_a_halving = 8;

double level_at(const LevelLadder& ladder, int step) {
  constexpr std::array<double, steps_a_halving> parts{1.0,
                                                      0.9170040432046712,
                                                      0.8408964152537145,
                                                      0.7711054127039704,
                                                      0.7071067811865476,
                                                      0.6484197773255048,
                                                      0.5946035575013605,
                                                      0.5452538663326288};  // 2^(-1/8) and its powers
  return std::ldexp(ladder.highest * parts[step % steps_a_halving], -(step / steps_a_halving));
}

// The first step in (bad, end] that is good, if `end` is. Steps beyond a good one are assumed good.
int halved(int bad, int end, const std::function<bool(int)>& good) {
  while (end - bad > 1) {
    const int middle = (bad + end) / 2;
    (good(middle) ? end : bad) = middle;
  }
  return end;
}

// The first step in (bad, end] that is good, or `end`. Steps beyond a good one are assumed good.
int first_good(int bad, int end, const std::function<bool(int)>& good) {
  int far = bad + 1;
  for (int by = 1; far < end && !good(far); by *= 2) {
    bad = far;
    far += by;
  }
  return halved(bad, std::min(far, end), good);
}

// The first good step near a guess: the guess, unless a few trials pass so far before it that all trials may also pass
// before it. (All of them pass some three steps later than a few.)
int first_good_near(int near, const std::function<bool(int)>& few_pass) {
  constexpr int before = 6;
  for (int by = before; near > 0; by *= 2) {
    const int up = std::max(0, near - by);
    if (!few_pass(up)) return by == before ? near : halved(up, near, few_pass);
    near = up;
  }
  return near;
}

// The first good step without a guess. The highest is tested first: many levels are bounded by how far trials may
// begin, not by their outcome. If low levels may also fail, levels that fall by a factor of four are tried last.
int first_good_anywhere(int steps, bool low_may_fail, const std::function<bool(int)>& few_pass) {
  if (steps > 0 && few_pass(0)) return 0;
  const int found = halved(0, steps, few_pass);
  if (found < steps || !low_may_fail) return found;
  constexpr int fourth = 2 * steps_a_halving;
  for (int k = fourth; k < steps; k += fourth)
    if (few_pass(k)) return halved(k - fourth, k, few_pass);
  return steps;
}

int step_of(const LevelLadder& ladder, double level) {
  const double step = std::round(steps_a_halving * std::log2(0.5 * ladder.highest / level));
  return static_cast<int>(std::clamp(step, 0.0, steps_a_halving * ladder.halvings - 1.0));
}

}  // namespace

double highest_good_level(const LevelLadder& ladder, const TrialCounts& counts,
                          const std::function<bool(double level, const TryRange& tries)>& good, double near) {
  const int steps = steps_a_halving * ladder.halvings;
  const auto few_pass = [&](int k) { return good(level_at(ladder, k), {0, counts.few, counts.few}); };
  near = steps > 0 ? near : 0.0;
  int step = near > 0.0 ? first_good_near(step_of(ladder, near), few_pass)
                        : first_good_anywhere(steps, counts.low_may_fail, few_pass);
  // Part after part, and round again, until all have passed on one level.
  const std::size_t size = std::min(trial_part, counts.all), parts = (counts.all + size - 1) / size;
  std::size_t passed = 0;
  if (counts.first_goes_far && step < steps)
    step = first_good(step - 1, steps, [&](int k) { return good(level_at(ladder, k), {0, counts.few, counts.all}); });
  // The first part costs most, so it comes last.
  for (std::size_t part = 1 % parts; step < steps && passed < parts; part = (part + 1) % parts) {
    const TryRange tries{part * size, std::min(size, counts.all - part * size), counts.all};
    const auto passes = [&](int k) { return good(level_at(ladder, k), tries); };
    if (passes(step)) {
      ++passed;
      continue;
    }
    step = first_good(step, steps, passes);
    passed = 1;
  }
  return step >= steps ? 0.0 : 0.5 * level_at(ladder, step);
}

namespace {

constexpr double widest_factor = 64.0;
// If other rotors' motions lie further off, V says too little about states near them: other motions come as close.
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
    // A rotor of its own has its motion next to this one, where V does not fall to zero.
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
  return noted(
      settings.notes, "come to", settings.stop,
      [&] {
        std::vector<char> came(trials.states.size() / settings.system->dimension());
        follow(trials, settings, [&](std::size_t first, const std::vector<Outcome>& outcomes) {
          std::transform(
              outcomes.begin(), outcomes.end(), came.begin() + static_cast<std::ptrdiff_t>(first),
              [](const Outcome& outcome) { return is_attracted(outcome) && outcome.attractor == balanced_id; });
          return true;
        });
        return came;
      },
      [&](const std::vector<char>& came) {
        return came.size() * settings.system->dimension() == trials.states.size();
      });
}

}  // namespace equipoise
