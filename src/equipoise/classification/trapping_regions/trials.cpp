// Runs trials in chunks on all threads, and searches for a level by them.
#include "equipoise/classification/trapping_regions/trials.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "equipoise/core/running/parallel.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/results/types/fate.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"

namespace equipoise {

namespace {

// Lanes seldom wait for the last state of a large chunk; several threads need several chunks.
std::size_t chunk_of(const Trials& trials, const TrialSettings& settings) {
  return trials.alike && settings.threads == 1 ? trial_part : trial_chunk;
}

// Calls told(first, fates) for every chunk, from any thread, until it returns false or lanes are stopped.
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
    task.count = std::min(chunk, total - first);
    task.states = &trials.states[first * size];
    task.stop = settings.stop;
    std::vector<OwnRotor> rotors;
    for (std::size_t i = 0; i < task.count && !settings.rotors.empty(); ++i) {
      OwnRotor& rotor = rotors.emplace_back(*settings.rotor(trials.first + first + i));
      rotor.segment.psi = flight.psi;
      rotor.end = flight.end;
    }
    const std::vector<const OwnRotor*> own = pointers_to(rotors);
    if (!own.empty()) task.own = own.data();
    std::vector<Fate> fates(task.count);
    if (!classify_batch(task, trials.rule, fates, nullptr) || !told(first, fates)) good = false;
    if (settings.progress) settings.progress->add(task.count);
  });
  return good;
}

bool is_attracted(const Fate& fate) { return fate.outcome == Outcome::attracted; }

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
    return follow(trials, settings, [](std::size_t, const std::vector<Fate>& fates) {
      return std::all_of(fates.begin(), fates.end(), is_attracted);
    });
  });
}

std::vector<char> which_balance(Trials trials, const TrialSettings& settings) {
  return noted(
      settings.notes, "come to", settings.stop,
      [&] {
        std::vector<char> came(trials.states.size() / settings.system->dimension());
        follow(trials, settings, [&](std::size_t first, const std::vector<Fate>& fates) {
          std::transform(fates.begin(), fates.end(), came.begin() + static_cast<std::ptrdiff_t>(first),
                         [](const Fate& fate) { return is_attracted(fate) && fate.attractor == balanced_id; });
          return true;
        });
        return came;
      },
      [&](const std::vector<char>& came) {
        return came.size() * settings.system->dimension() == trials.states.size();
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

// The first good step near a guess: the guess, unless a few trials pass so far before it that all trials may pass
// before it too. (All of them pass some three steps later than a few.)
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
// begin, not by their outcome. Where low levels may fail, too, levels that fall by a factor of four are tried last.
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

}  // namespace equipoise
