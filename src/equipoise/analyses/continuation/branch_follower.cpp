// Continuation in the parameter itself: the orbit at the last value is the guess at the next.
#include "equipoise/analyses/continuation/branch_follower.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <tuple>
#include <utility>

#include "equipoise/analyses/one_study/attractors.hpp"
#include "equipoise/attractors/motions/motion_statistics.hpp"
#include "equipoise/attractors/periodic_orbits/recurrence.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"

namespace equipoise {

namespace {

// Shortest Newton step, relative to the line's step: ends are located this accurately.
constexpr double shortest_step = 1.0 / 65536;
// Basins of tori may be so thin that a trajectory carried further than this leaves them.
constexpr double shortest_restless_step = 1.0 / 64;
// From this step on, trajectories begin in several states, some time apart on the motion, before it is given up.
constexpr double careful_step = 1.0 / 16;
constexpr int careful_states = 4;
constexpr double time_between_states = 37.0;  // some turns, and no multiple of any period
// Chaos may be left only after a long time, and the next motion approached slowly: both get this much longer.
constexpr double long_patience = 4.0 * motion_patience;
// How often random starts check, between two values of the line, whether the motion still exists.
constexpr int most_searches = 4;
// A motion that changes by more than this within half a step, in natural sizes, may be another one.
constexpr double largest_change = 0.5;
// A step is smooth if its two halves change the motion about equally. At a fold (a square root) they differ by 2.4.
constexpr double uneven = 4.0, smallest_uneven = 0.02;
constexpr double centred = 1e-9;  // off_balance() of balanced states

// Properties that no smooth change of a motion alters.
bool same_signature(const model::Parameters& p, const Motion& a, const Motion& b) {
  const auto is_centred = [&](const Motion& m) { return model::off_balance(p, m.state) < centred; };
  return a.kind == b.kind && a.winding == b.winding && a.cluster == b.cluster &&
         a.half_period_exchange == b.half_period_exchange && a.copies == b.copies &&
         (a.kind != MotionKind::equilibrium || is_centred(a) == is_centred(b));
}

double change(const model::System& system, const Motion& a, const Motion& b) {
  const StateDifference difference(system);
  if (a.orbit.nodes.empty()) return difference.distance(a.state, b.state);
  if (a.orbit.nodes.size() != b.orbit.nodes.size()) return 2.0 * largest_change;
  double farthest = 0.0;
  for (std::size_t k = 0; k < a.orbit.nodes.size(); ++k)
    farthest = std::max(farthest, difference.distance(a.orbit.nodes[k], b.orbit.nodes[k]));
  return farthest;
}

bool smooth(double first, double second) {
  const double large = std::max(first, second), small = std::min(first, second);
  return large < largest_change && (large < smallest_uneven || large < uneven * small);
}

// Whether `next`, met by a trajectory, continues `motion` at another value of the parameter.
bool goes_on(const model::Parameters& p, const Motion& motion, const Motion& next) {
  return next.stable && resembles(p, motion, next) &&
         (is_restless(motion) || is_restless(next) || may_be_locked(motion) || may_be_locked(next));
}

// Mean rates of the balls, in any order, differ by less than a twentieth of the fastest.
bool drift_alike(const model::Parameters& p, const Motion& a, const Motion& b) {
  std::vector<double> first(a.drift.begin(), a.drift.begin() + p.balls);
  std::vector<double> second(b.drift.begin(), b.drift.begin() + p.balls);
  std::sort(first.begin(), first.end());
  std::sort(second.begin(), second.end());
  double fastest = 0.0, apart = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    fastest = std::max({fastest, std::fabs(first[i]), std::fabs(second[i])});
    apart = std::max(apart, std::fabs(first[i] - second[i]));
  }
  return apart < 0.05 * fastest;
}

}  // namespace

bool may_be_locked(const Motion& motion) {
  return motion.kind == MotionKind::periodic &&
         std::any_of(motion.winding.begin(), motion.winding.end(), [](int turns) { return std::abs(turns) > 1; });
}

bool is_restless(const Motion& motion) { return never_repeats(motion.kind) || motion.eventful; }

std::string family_of(const model::Parameters& p, const Motion& motion) {
  std::string name = motion_name(p, motion).name;
  for (const MotionKind kind : {MotionKind::quasi_periodic, MotionKind::chaotic}) {
    const std::string ending = std::string(", ") + name_of(kind);
    if (name.ends_with(ending)) name.resize(name.size() - ending.size());
  }
  return name;
}

bool resembles(const model::Parameters& p, const Motion& a, const Motion& b) {
  const double size = std::max(a.r_max, b.r_max);
  const double of_max = std::fabs(a.r_max - b.r_max) / size, of_mean = std::fabs(a.r_mean - b.r_mean) / size;
  if (family_of(p, a) == family_of(p, b)) return of_max < 0.25 && of_mean < 0.15;
  // Whether two balls drift at one rate is measured and may differ by chance; then compare the motions themselves.
  return is_restless(a) && is_restless(b) && of_max < 0.1 && of_mean < 0.05 && drift_alike(p, a, b);
}

std::optional<Motion> BranchContinuation::refine(const Motion& motion, double to) const {
  const model::System system = line_.system_at(to);
  auto found = refined_motion(system, motion, stop_);
  if (!found || !same_signature(system.parameters(), motion, *found)) return std::nullopt;
  return found;
}

ValueSearch attractors_at(const Study& study, std::uint64_t starts,
                          const std::vector<std::vector<double>>& warm_start_states, const StopFlag* stop) {
  AttractorsOptions search;
  search.starts = starts;
  search.threads = 1;
  search.warm_start_states = warm_start_states;
  search.stop = stop;
  const AttractorsResult found = attractors(study, search);
  ValueSearch result;
  std::map<std::string, std::pair<std::uint64_t, const Motion*>> commonest;
  for (const Attractor& a : found.attractors) {
    if (!a.motion.stable && a.name != "balanced") continue;
    if (a.motion.kind == MotionKind::measured) continue;  // no state to continue from
    result.motions.push_back(a.motion);
    const auto share = std::find_if(found.basin.attractors.begin(), found.basin.attractors.end(),
                                    [&](const OutcomeShare& s) { return s.id == a.id; });
    auto& [most, motion] = commonest[family_of(study.parameters, a.motion)];
    if (!motion || share->share.count > most) std::tie(most, motion) = std::pair(share->share.count, &a.motion);
  }
  for (const auto& [name, most] : commonest) result.commonest.push_back(*most.second);
  return result;
}

Advance BranchContinuation::advance(const Motion& motion, double from, double to) const {
  if (stopped()) return {from, motion, false, to, {}};
  if (is_restless(motion)) return advance_restless(motion, from, to);
  Advance result = advance_refined(motion, from, to);
  if (motion.kind == MotionKind::equilibrium || !motion.stable || stopped()) return result;
  if (result.arrived && (result.motion.stable || !may_be_locked(motion))) return result;
  // A periodic motion locked within a torus ends, or stops attracting, where the torus continues.
  if (result.arrived) {
    Meeting met = meet({from, motion, false, to, {}}, to, careful_states);
    return met.same ? Advance{to, std::move(*met.same), true, to, {}, true} : result;
  }
  if (!result.motion.stable) return result;
  if (may_be_locked(motion)) {
    Advance on = advance_restless(result.motion, result.value, to);
    return on.arrived || on.value != result.value ? on : result;
  }
  const model::System system = line_.system_at(to);
  auto next = motion_from(system, result.motion.state, motion_patience, stop_);
  if (next && next->stable && is_restless(*next) && resembles(system.parameters(), motion, *next))
    return {to, std::move(*next), true, to, {}, true};
  return result;
}

Advance BranchContinuation::advance_refined(const Motion& motion, double from, double to) const {
  const double shortest = shortest_step * line_.step();
  constexpr int growth_after = 4;  // smooth steps in a row before the step is doubled
  Advance at{from, motion, false, to, {}};
  double step = to - from;
  int smooth_steps = 0;
  while (!stopped()) {
    const bool last = std::fabs(step) >= std::fabs(to - at.value) * (1.0 - 1e-9);
    const double next = last ? to : at.value + step, middle = 0.5 * (at.value + next);
    const model::System there = line_.system_at(next);
    const model::Parameters& p = there.parameters();
    std::optional<Motion> half = refined_motion(line_.system_at(middle), at.motion, stop_), whole;
    const std::optional<Motion>* stranger = nullptr;
    if (half && !same_signature(p, at.motion, *half)) stranger = &half;
    if (half && !stranger) {
      whole = refined_motion(there, *half, stop_);
      if (whole && !same_signature(p, at.motion, *whole)) stranger = &whole;
    }
    if (whole && !stranger && smooth(change(there, at.motion, *half), change(there, *half, *whole))) {
      at.value = next;
      at.motion = std::move(*whole);
      at.beyond.reset();
      if (last) {
        at.arrived = true;
        return at;
      }
      if (++smooth_steps == growth_after) {
        step *= 2.0;
        smooth_steps = 0;
      }
      continue;
    }
    smooth_steps = 0;
    at.refused = next;
    if (stranger) at.beyond = *stranger;
    step *= 0.5;
    if (std::fabs(step) < shortest) break;
  }
  return at;
}

// States of the motion, some time apart; on the section where the rotor's angle matters.
std::vector<Eigen::VectorXd> BranchContinuation::states_along(const Advance& at, int count) const {
  std::vector<Eigen::VectorXd> states{at.motion.state};
  if (count == 1) return states;
  const model::System system = line_.system_at(at.value);
  const bool stroboscopic = system.section() == model::Section::stroboscopic;
  const double piece = stroboscopic ? system.section_period() : time_between_states;
  const int pieces = stroboscopic ? std::max(1, static_cast<int>(std::lround(time_between_states / piece))) : 1;
  constexpr double tolerance = 1e-9;  // as the motion itself was followed
  Eigen::VectorXd z = at.motion.state;
  while (static_cast<int>(states.size()) < count) {
    for (int k = 0; k < pieces; ++k)
      if (follow(system, z, piece, tolerance, nullptr, nullptr, stop_) != IntegrationStatus::done) return states;
    z = system.with_angles_reduced(std::move(z));
    states.push_back(z);
  }
  return states;
}

// What trajectories from several states of the motion at `at` come to.
BranchContinuation::Meeting BranchContinuation::meet(const Advance& at, double value, int states) const {
  const model::System system = line_.system_at(value);
  const model::Parameters& p = system.parameters();
  Meeting meeting;
  for (const Eigen::VectorXd& state : states_along(at, states)) {
    auto found = motion_from(system, state, motion_patience, stop_);
    if (!found && states > 1) found = motion_from(system, state, long_patience, stop_);
    if (found && goes_on(p, at.motion, *found)) {
      meeting.same = std::move(found);
      return meeting;
    }
    meeting.left = meeting.left && found && found->stable;
    if (!meeting.other) meeting.other = std::move(found);
  }
  return meeting;
}

std::optional<Motion> BranchContinuation::find_by_starts(const Advance& at, double value) const {
  std::vector<std::vector<double>> warm_start_states;
  for (const Eigen::VectorXd& state : states_along(at, careful_states))
    warm_start_states.emplace_back(state.begin(), state.end());
  const Study study = line_.study_at(value);
  for (const Motion& motion : attractors_at(study, starts_, warm_start_states, stop_).motions)
    if (goes_on(study.parameters, at.motion, motion)) return motion;
  return std::nullopt;
}

Advance BranchContinuation::advance_restless(const Motion& motion, double from, double to) const {
  const double shortest = shortest_restless_step * line_.step(), careful = careful_step * line_.step();
  constexpr double rounding = 1.0 + 1e-9;
  Advance at{from, motion, false, to, {}};
  at.carried = true;
  double step = to - from;
  int searches = 0;
  while (!stopped()) {
    const bool whole = std::fabs(step) * rounding >= std::fabs(to - at.value);
    const double next = whole ? to : at.value + step, length = std::fabs(next - at.value);
    Meeting met = meet(at, next, length <= careful * rounding ? careful_states : 1);
    const bool last_try = !met.same && length <= shortest * rounding;
    if (last_try && searches < most_searches) {
      ++searches;
      met.same = find_by_starts(at, next);
    } else if (last_try) {
      met.left = false;
    }
    if (met.same) {
      at.value = next;
      at.motion = std::move(*met.same);
      at.beyond.reset();
      at.left = false;
      if (whole) {
        at.arrived = true;
        return at;
      }
      // A torus that has become a periodic motion of one turn is continued as such.
      if (!is_restless(at.motion) && !may_be_locked(at.motion)) return advance(at.motion, at.value, to);
      step *= 2.0;
      continue;
    }
    at.refused = next;
    at.beyond = std::move(met.other);
    at.left = met.left;
    if (last_try) return at;
    step = std::copysign(std::max(0.5 * length, shortest), step);
  }
  at.left = false;
  return at;
}

Advance BranchContinuation::narrowed(const Advance& end) const {
  if (!is_restless(end.motion)) {
    Advance refined_end = advance_refined(end.motion, end.value, end.refused);
    return refined_end.arrived ? end : refined_end;
  }
  Advance at = end;
  at.carried = true;
  while (std::fabs(at.refused - at.value) > careful_step * line_.step() * (1.0 + 1e-9) && !stopped()) {
    const double middle = 0.5 * (at.value + at.refused);
    Meeting met = meet(at, middle, careful_states);
    if (met.same && is_restless(*met.same)) {
      at.value = middle;
      at.motion = std::move(*met.same);
    } else {
      at.refused = middle;
      at.left = met.same || met.left;  // a motion that is not restless belongs to the other branch
      at.beyond = met.same ? std::move(met.same) : std::move(met.other);
    }
  }
  return at;
}

}  // namespace equipoise
