// Tries: states on a level set, followed by the kernels that decide.
#include "equipoise/traps/validated_level.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <vector>

#include <Eigen/Core>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "equipoise/base/angles.hpp"
#include "equipoise/base/random.hpp"
#include "equipoise/deciding/fate.hpp"
#include "equipoise/kernels/lane_kernels.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/traps/balanced_trap.hpp"
#include "equipoise/traps/orbit_trap.hpp"

namespace equipoise {

namespace {

constexpr std::size_t balanced_tries = 4096, orbit_tries = 1024, few_tries = 128, chunk = 128;
constexpr double widest_factor = 64.0;
// A trajectory this much nearer, in |F d|^2, than where it started has come to the orbit.
constexpr double come_close = 1e-3;

// Unit vectors, the same for every study.
class Directions {
 public:
  explicit Directions(int size) : v_(size) {}
  const Eigen::VectorXd& next() {
    for (double& x : v_) x = random_.normal();
    v_.normalize();
    return v_;
  }

 private:
  RandomStream random_;
  Eigen::VectorXd v_;
};

// Calls work(first, count) for chunks of `total` states until one returns false. True if none did.
template <class Work>
bool all_chunks(std::size_t total, const TrialSettings& settings, Work&& work) {
  std::atomic<bool> good{true};
  if (settings.progress) settings.progress->begin("states tried on level sets");
  tbb::task_arena arena(settings.threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, (total + chunk - 1) / chunk, [&](std::size_t k) {
      if (!good) return;
      const std::size_t count = std::min(chunk, total - k * chunk);
      if (!work(k * chunk, count)) good = false;
      if (settings.progress) settings.progress->add(count);
    });
  });
  return good;
}

LaneTask task_for(const TrialSettings& settings, double end, std::size_t count, double* states) {
  LaneTask task;
  task.parameters = settings.parameters;
  task.segment = {0.0, 1e300, 0.0, settings.speed, 0.0, false};
  task.end = end;
  task.tolerance = settings.tolerance;
  task.count = count;
  task.states = states;
  task.stop = settings.stop;
  return task;
}

bool all_attracted(LaneTask task, const DecisionRule& rule) {
  std::vector<Fate> fates(task.count);
  return decide_lanes(task, rule, fates, nullptr) &&
         std::all_of(fates.begin(), fates.end(), [](const Fate& fate) { return fate.outcome == Outcome::attracted; });
}

DecisionRule rule_of(const std::vector<BalancedTrap>& balanced, int balls) {
  DecisionRule rule;
  rule.balls = balls;
  rule.traps = balanced;
  rule.window = rule.first_long_window = 1e9;
  return rule;
}

// Ten times what the linear flow needs from a level `factor` times the trap's own, and time to settle on it.
double patience(double factor, double slowest_rate) { return 10.0 * std::log(factor) / -slowest_rate + 500.0; }

// All states on the level `factor` times the trap's own enter one of the `balanced` traps.
bool all_balance(const BalancedTrap& trap, const std::vector<BalancedTrap>& balanced, const TrialSettings& settings,
                 double slowest_rate, double factor) {
  const int balls = settings.parameters->balls, size = model::dimension(balls);
  const auto f = factor_of(trap);
  std::vector<double> states(balanced_tries * size);
  Directions directions(size);
  for (std::size_t i = 0; i < balanced_tries; ++i) {
    const Eigen::VectorXd d =
        std::sqrt(factor * trap.level) * f.triangularView<Eigen::Upper>().solve(directions.next());
    for (int k = 0; k < size; ++k) states[i * size + k] = d[k];
    for (int k = 0; k < balls; ++k) states[i * size + 4 + k] += trap.phi[k];
  }
  const DecisionRule rule = rule_of(balanced, balls);
  const double end = patience(factor, slowest_rate);
  return all_chunks(balanced_tries, settings, [&](std::size_t first, std::size_t count) {
    return all_attracted(task_for(settings, end, count, &states[first * size]), rule);
  });
}

// All of `tries` states on the level come to the orbit.
bool all_approach(const OrbitTrap& trap, const TrialSettings& settings, double slowest_rate, double level,
                  std::size_t tries) {
  const int balls = settings.parameters->balls, size = model::dimension(balls), others = size - 1;
  const int rows = trap.turns * trap.cells;
  std::vector<double> states(tries * size);
  Directions directions(others);
  for (std::size_t i = 0; i < tries; ++i) {
    const Eigen::VectorXd d = std::sqrt(level) * directions.next();
    // Rows in an order that spreads any first few tries over the whole orbit (golden section).
    const double share = 0.6180339887498949 * static_cast<double>(i);
    trap_state(trap, balls, static_cast<int>(rows * (share - std::floor(share))), d.data(), &states[i * size]);
  }
  DecisionRule rule;
  rule.balls = balls;
  rule.orbits = {trap};
  set_level(rule.orbits.front(), balls, come_close * level);
  rule.window = rule.first_long_window = 1e9;
  const double end = 2.0 * std::log(1.0 / come_close) / (2.0 * -slowest_rate) + 200.0;
  return all_chunks(tries, settings, [&](std::size_t first, std::size_t count) {
    return all_attracted(task_for(settings, end, count, &states[first * size]), rule);
  });
}

}  // namespace

void widen(BalancedTrap& trap, const std::vector<BalancedTrap>& balanced, const TrialSettings& settings,
           double slowest_rate, double nearest_foreign) {
  const int balls = settings.parameters->balls;
  double factor = widest_factor;  // no ball may deviate by half a turn on twice the level
  for (int i = 0; i < balls; ++i) factor = std::min(factor, 0.5 * std::pow(pi / trap.reach[model::index::phi(i)], 2));
  factor = std::min(factor, 0.5 * nearest_foreign / trap.level);
  // At half the level and below, twice of it is where V decreases, and nothing is left to try.
  while (factor > 0.5 && !is_set(settings.stop) && !all_balance(trap, balanced, settings, slowest_rate, 2.0 * factor))
    factor *= 0.5;
  set_level(trap, factor * trap.level);
}

std::vector<char> come_to_balance(std::vector<double> states, const std::vector<BalancedTrap>& balanced,
                                  const TrialSettings& settings, double slowest_rate) {
  const int size = model::dimension(settings.parameters->balls);
  const DecisionRule rule = rule_of(balanced, settings.parameters->balls);
  const double end = patience(widest_factor, slowest_rate);
  std::vector<char> came(states.size() / size);
  all_chunks(came.size(), settings, [&](std::size_t first, std::size_t count) {
    std::vector<Fate> fates(count);
    if (!decide_lanes(task_for(settings, end, count, &states[first * size]), rule, fates, nullptr)) return false;
    for (std::size_t i = 0; i < count; ++i) came[first + i] = fates[i].outcome == Outcome::attracted;
    return true;
  });
  return came;
}

void set_level(BalancedTrap& trap, double level) {
  const double stretch = std::sqrt(level / trap.level);
  trap.level = level;
  for (double& reach : trap.reach) reach *= stretch;
}

namespace {

// Half the largest of a falling series of levels for which good(level, tries) holds; 0 if it never does. A few tries
// find where to begin, all of them where to stop.
template <class Good>
double highest_good_level(double highest, Good&& good, std::size_t few = few_tries, std::size_t all = orbit_tries) {
  constexpr int rungs = 24;  // of a ladder of halvings
  int low = -1, high = rungs;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (good(std::ldexp(highest, -middle), few) ? high : low) = middle;
  }
  while (high < rungs && !good(std::ldexp(highest, -high), all)) ++high;
  return high == rungs ? 0.0 : 0.5 * std::ldexp(highest, -high);
}

// Slower ones are decided by windows: following the tries would take longer than the ensemble. Balance is not, so that
// more patience is worth it there.
constexpr double slowest_worth_it = 2e-3, slowest_balance = 2e-4;

// All of `tries` states on the level, a chunk each at angles and strobes spread over the orbit, come to the orbit.
bool all_approach(const StrobedTrap& trap, const TrialSettings& settings, double slowest_rate, double level,
                  std::size_t tries) {
  const model::Parameters& p = *settings.parameters;
  const int size = model::dimension(p.balls);
  const auto row_of = [&](std::size_t first) {
    return static_cast<int>(first / chunk) * 7 % (trap.strobes * trap.cells);
  };
  std::vector<double> states(tries * size);
  Directions directions(size);
  for (std::size_t i = 0; i < tries; ++i) {
    const Eigen::VectorXd z = strobed_trap_state(p, trap, row_of(i), level, directions.next());
    std::copy(z.begin(), z.end(), &states[i * size]);
  }
  auto close = std::make_shared<StrobedTrap>(trap);
  close->level = come_close * level;
  DecisionRule rule;
  rule.balls = p.balls;
  rule.strobed = traps_as_rule(p, settings.speed, {close}, {});
  rule.first_long_window = 1e9;
  const double end = 2.0 * std::log(1.0 / come_close) / (2.0 * -slowest_rate) + 200.0;
  const double cell_angle = model::strobe_angle(p) / trap.cells * (settings.speed < 0.0 ? -1.0 : 1.0);
  return all_chunks(tries, settings, [&](std::size_t first, std::size_t count) {
    LaneTask task = task_for(settings, end, count, &states[first * size]);
    task.segment.psi = cell_angle * (row_of(first) % trap.cells);
    return all_attracted(task, rule);
  });
}

// A state of a continuum's trap falls to this share of its V: so much nearer, it is where linear theory holds.
constexpr double come_near = 0.03;
// A state beside the slowest member that is tried may come to one a little slower.
constexpr double slower = 0.5;

// Members of a continuum to try levels around, and how far from rest what gravity makes of them is.
struct Members {
  std::vector<ContinuumMember> all;
  double unit = 0.0, slowest_rate = 0.0, unrest = 0.0;
};

Members members_to_try(const BalancedContinuum& continuum, const ContinuumSurvey& survey,
                       const TrialSettings& settings) {
  constexpr std::size_t most = 64;
  // Slower ones would hold all levels down: errors of integration keep states about tolerance over rate away from them.
  constexpr double slowest_share = 0.1, slowest_of_all = 2e-4;
  Members result;
  result.slowest_rate = std::min(-slowest_of_all, slowest_share * survey.fastest_rate);
  const auto first = static_cast<std::size_t>(
      std::find_if(survey.rates.begin(), survey.rates.end(), [&](double r) { return r <= result.slowest_rate; }) -
      survey.rates.begin());
  const std::size_t count = survey.members.size() - first, taken = std::min(most, count);
  const int balls = settings.parameters->balls;
  for (std::size_t k = 0; k < taken && !is_set(settings.stop); ++k) {
    auto m = continuum.member(survey.members[first + k * count / taken].data());
    if (!m || m->form.size() == 0 || !(m->rate <= result.slowest_rate)) continue;
    result.unit = std::max(result.unit, m->unit);
    for (Eigen::Index i = 0; i < m->centre.size(); ++i)
      if (i < 4 || i >= 4 + balls) result.unrest = std::max(result.unrest, std::fabs(m->centre[i]));
    result.all.push_back(*std::move(m));
  }
  return result;
}

DecisionRule rule_of(const ContinuumTrap& trap, const TrialSettings& settings) {
  const model::Parameters& p = *settings.parameters;
  DecisionRule rule;
  rule.balls = p.balls;
  rule.first_long_window = 1e9;
  if (model::is_strobed(p))
    rule.strobed = traps_as_rule(p, settings.speed, {}, strobed_family_test(p, settings.speed, trap));
  else
    rule.family = family_test(trap, p.balls);
  return rule;
}

double reach_of(const Members& members, double factor) {
  return 1.5 * members.unrest + std::sqrt(std::min(factor * members.unit, 0.5));
}

// All of `tries` states at `factor` times the members' units of V come near to the continuum.
bool all_approach(const ContinuumTrap& trap, const Members& members, const TrialSettings& settings, double factor,
                  std::size_t tries) {
  const std::size_t size = model::dimension(settings.parameters->balls), count = members.all.size();
  std::vector<double> states(tries * size);
  Directions directions(static_cast<int>(trap.continuum->directions()));
  const auto member_of = [&](std::size_t i) -> const ContinuumMember& { return members.all[i * count / tries]; };
  for (std::size_t i = 0; i < tries; ++i) {
    const ContinuumMember& m = member_of(i);
    const Eigen::VectorXd z = trap.continuum->state_at(m, factor * m.unit, directions.next());
    std::copy(z.begin(), z.end(), &states[i * size]);
  }
  ContinuumTrap near = trap;
  near.factor = come_near * factor;
  near.slowest_rate *= slower;
  near.reach = reach_of(members, near.factor);
  const DecisionRule rule = rule_of(near, settings);
  return all_chunks(tries, settings, [&](std::size_t first, std::size_t length) {
    const double rate = -member_of(first).rate;  // the slowest of the chunk
    const double end = 2.0 * std::log(1.0 / come_near) / (2.0 * rate) + 500.0;
    return all_attracted(task_for(settings, end, length, &states[first * size]), rule);
  });
}

}  // namespace

FamilyTrap family_test(const ContinuumTrap& trap, int balls) {
  return {trap.reach, [trap, size = model::dimension(balls)](const double* state) {
            return trap.holds(Eigen::Map<const Eigen::VectorXd>(state, size));
          }};
}

std::optional<ContinuumTrap> continuum_trap(const std::shared_ptr<const BalancedContinuum>& continuum,
                                            const ContinuumSurvey& survey, const TrialSettings& settings) {
  if (!continuum || !survey.attracts()) return std::nullopt;
  const Members members = members_to_try(*continuum, survey, settings);
  if (members.all.empty()) return std::nullopt;
  ContinuumTrap trap{continuum, 0.0, members.slowest_rate, 0.0};
  // With anisotropic supports or gravity to tell what a state comes to is a flight of its own.
  const std::size_t part = model::is_strobed(*settings.parameters) ? 4 : 1;
  trap.factor = highest_good_level(
      0.5 / members.unit,
      [&](double factor, std::size_t tries) { return all_approach(trap, members, settings, factor, tries); },
      few_tries / part, orbit_tries / part);
  if (!(trap.factor > 0.0)) return std::nullopt;
  trap.reach = reach_of(members, trap.factor);
  return trap;
}

bool validate(std::vector<OrbitTrap>& copies, const TrialSettings& settings, double slowest_rate) {
  constexpr double highest = 16.0;
  if (copies.empty() || !(slowest_rate < -slowest_worth_it)) return false;
  const double level = highest_good_level(highest, [&](double tried, std::size_t tries) {
    return all_approach(copies.front(), settings, slowest_rate, tried, tries);
  });
  for (OrbitTrap& trap : copies)
    if (level > 0.0) set_level(trap, settings.parameters->balls, level);
  return level > 0.0;
}

bool validate(StrobedTrap& trap, const TrialSettings& settings, double slowest_rate) {
  constexpr double highest = 4.0;
  if (!(slowest_rate < -(trap.attractor == balanced_id ? slowest_balance : slowest_worth_it))) return false;
  trap.level = highest_good_level(highest, [&](double level, std::size_t tries) {
    return all_approach(trap, settings, slowest_rate, level, tries);
  });
  return trap.level > 0.0;
}

}  // namespace equipoise
