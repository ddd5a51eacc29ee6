// Continuation with natural steps: the orbit at the last value is the guess at the next.
#include "equipoise/branches/branch_follower.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "equipoise/model/balanced_state.hpp"
#include "equipoise/motions/event_motion.hpp"
#include "equipoise/orbits/recurrence.hpp"

namespace equipoise {

namespace {

// Shortest Newton step as a part of the line's step: ends are known that well.
constexpr double shortest_step = 1.0 / 65536;
constexpr double restless_step = 1.0 / 16;
// A motion that changes by more than this within half a step, in natural sizes, may be another one.
constexpr double largest_change = 0.5;
// Two halves of a step that change the motion about equally are smooth: at a fold, where changes go like a square root,
// they differ by 2.4.
constexpr double uneven = 4.0, smallest_uneven = 0.02;
constexpr double centred = 1e-9;  // off_balance() of balanced states

// Balls in contact may come to touch on a motion that was refined as if they passed each other.
std::optional<Motion> if_clear(const model::System& system, Motion motion) {
  if (!stays_clear(system, motion)) return std::nullopt;
  return motion;
}

std::optional<Motion> refined(const model::System& system, const Motion& guess, const StopFlag* stop) {
  // Where equations begin to depend on the rotor's angle, or cease to, motions become others.
  if (guess.state.size() != system.dimension()) return std::nullopt;
  if (guess.orbit.nodes.empty()) {
    if (system.section() == model::Section::strobe) return std::nullopt;
    const auto found = refine_equilibrium(system, guess.state);
    if (!found) return std::nullopt;
    return if_clear(system, describe_equilibrium(system, *found));
  }
  if (guess.orbit.imposed != (system.section() == model::Section::strobe)) return std::nullopt;
  const auto found =
      refine_orbit(system, guess.orbit.nodes, guess.orbit.period, std::numeric_limits<double>::infinity(), stop);
  if (!found) return std::nullopt;
  return if_clear(system, describe_orbit(system, *found));
}

// What no smooth change of a motion alters.
bool same_signature(const model::Parameters& p, const Motion& a, const Motion& b) {
  const auto is_centred = [&](const Motion& m) { return model::off_balance(p, m.state[0], m.state[1]) < centred; };
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

}  // namespace

bool is_restless(const Motion& motion) {
  return motion.kind == MotionKind::quasi_periodic || motion.kind == MotionKind::chaotic || motion.eventful;
}

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
  return family_of(p, a) == family_of(p, b) && std::fabs(a.r_max - b.r_max) < 0.25 * size &&
         std::fabs(a.r_mean - b.r_mean) < 0.15 * size;
}

std::optional<Motion> BranchFollower::refine(const Motion& motion, double to) const {
  const model::System system = line_.system_at(to);
  auto found = refined(system, motion, stop_);
  if (!found || !same_signature(system.parameters(), motion, *found)) return std::nullopt;
  return found;
}

Advance BranchFollower::advance(const Motion& motion, double from, double to) const {
  if (stopped()) return {from, motion, false, to, {}};
  if (is_restless(motion)) return advance_restless(motion, from, to);
  Advance result = advance_refined(motion, from, to);
  if (result.arrived || !result.motion.stable || motion.kind == MotionKind::equilibrium || stopped()) return result;
  // A periodic motion locked within a torus ends where the torus goes on.
  const model::System system = line_.system_at(to);
  auto next = motion_from(system, result.motion.state, motion_patience, stop_);
  if (next && next->stable && is_restless(*next) && resembles(system.parameters(), motion, *next))
    return {to, std::move(*next), true, to, {}};
  return result;
}

Advance BranchFollower::advance_refined(const Motion& motion, double from, double to) const {
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
    std::optional<Motion> half = refined(line_.system_at(middle), at.motion, stop_), whole;
    const std::optional<Motion>* stranger = nullptr;
    if (half && !same_signature(p, at.motion, *half)) stranger = &half;
    if (half && !stranger) {
      whole = refined(there, *half, stop_);
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

// The motion that a trajectory from a restless one comes to, if it resembles that; `stranger` gets what does not.
std::optional<Motion> BranchFollower::settled(const Motion& from, double value, std::optional<Motion>& stranger) const {
  const model::System system = line_.system_at(value);
  auto found = motion_from(system, from.state, motion_patience, stop_);
  if (found && found->stable && resembles(system.parameters(), from, *found)) return found;
  stranger = std::move(found);
  return std::nullopt;
}

Advance BranchFollower::advance_restless(const Motion& motion, double from, double to) const {
  Advance at{from, motion, false, to, {}};
  if (auto found = settled(motion, to, at.beyond)) return {to, std::move(*found), true, to, {}};
  bool asked_again = false;
  while (std::fabs(at.refused - at.value) > restless_step * line_.step() * (1.0 + 1e-9) && !stopped()) {
    const double middle = 0.5 * (at.value + at.refused);
    std::optional<Motion> stranger;
    auto found = settled(at.motion, middle, stranger);
    if (!found) {
      at.refused = middle;
      at.beyond = std::move(stranger);
      continue;
    }
    at.value = middle;
    at.motion = std::move(*found);
    if (asked_again) continue;
    asked_again = true;  // the way to the whole step may have been too far for the basin
    if (auto whole = settled(at.motion, to, stranger)) return {to, std::move(*whole), true, to, {}};
  }
  return at;
}

Advance BranchFollower::narrowed(const Advance& end) const {
  if (!is_restless(end.motion)) {
    Advance refined_end = advance_refined(end.motion, end.value, end.refused);
    return refined_end.arrived ? end : refined_end;
  }
  Advance at = end;
  while (std::fabs(at.refused - at.value) > restless_step * line_.step() * (1.0 + 1e-9) && !stopped()) {
    const double middle = 0.5 * (at.value + at.refused);
    std::optional<Motion> stranger;
    auto found = settled(at.motion, middle, stranger);
    if (found && is_restless(*found)) {
      at.value = middle;
      at.motion = std::move(*found);
    } else {
      at.refused = middle;
      at.beyond = found ? std::move(found) : std::move(stranger);
    }
  }
  return at;
}

}  // namespace equipoise
