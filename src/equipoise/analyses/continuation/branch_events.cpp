// Locates changes of stability and kind by bisection, and finds their cause from multipliers. Names branches: one
// identifier per branch, the same wherever the branch is met.
#include "equipoise/analyses/continuation/branch_follower.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/attractors/periodic_orbits/recurrence.hpp"
#include "equipoise/results/types/outcome.hpp"

namespace equipoise {

namespace {

constexpr double fine = 1.0 / 256, coarse = 1.0 / 16;
// At the last orbit before a fold, a multiplier differs from 1 by the root of the distance: up to 0.06 was seen.
constexpr double near_one = 0.1;

bool symmetric(int balls, const Motion& motion) {
  const auto& c = motion.cluster;
  bool some_coincide = false;
  for (int i = 0; i < balls; ++i)
    for (int k = 0; k < i; ++k) some_coincide = some_coincide || c[i] == c[k];
  return some_coincide || motion.half_period_exchange;
}

// The cause of a change of stability, from its unstable side.
BranchCause cause_of_instability(int balls, const Motion& unstable) {
  if (unstable.orbit.nodes.empty()) {
    const std::complex<double> leading = unstable.spectrum[0];
    if (leading.imag() != 0.0) return BranchCause::hopf;
    return symmetric(balls, unstable) ? BranchCause::pitchfork : BranchCause::fold;
  }
  const std::complex<double> leading = unstable.orbit.decays()[0];
  if (leading.imag() != 0.0) return BranchCause::neimark_sacker;
  if (leading.real() < 0.0) return BranchCause::period_doubling;
  return symmetric(balls, unstable) ? BranchCause::pitchfork : BranchCause::fold;
}

BranchEvent stability_change(const BranchContinuation& follower, const BranchPoint& low, const BranchPoint& high) {
  BranchEvent event;
  event.change = high.motion.stable ? BranchChange::stability_gained : BranchChange::stability_lost;
  Motion below = low.motion, above = high.motion;
  event.low = low.value;
  event.high = high.value;
  while (event.high - event.low > fine * follower.line().step() && !follower.stopped()) {
    // At the change itself the equations may be too nearly singular for Newton's method; then try next to it.
    std::optional<Motion> found;
    double middle = event.low;
    for (const double share : {0.5, 0.4, 0.6, 0.25, 0.75}) {
      middle = event.low + share * (event.high - event.low);
      found = follower.refine(below, middle);
      if (!found) found = follower.refine(above, middle);
      if (found) break;
    }
    if (!found) break;
    const bool like_below = found->stable == below.stable;
    (like_below ? event.low : event.high) = middle;
    (like_below ? below : above) = std::move(*found);
  }
  event.cause = cause_of_instability(follower.line().system_at(event.low).balls(), below.stable ? above : below);
  event.set_excursion(below);
  return event;
}

long growing_ways(const Equilibrium& equilibrium) {
  constexpr double surely = 1e-7;  // of a continuum's eigenvalues, which are zero, rounding makes less
  return std::count_if(equilibrium.eigenvalues.begin(), equilibrium.eigenvalues.end(),
                       [](std::complex<double> value) { return value.real() > surely; });
}

// Whether the periodic motion ends in an equilibrium: all of it is near one, whose stability also changes there. (If
// two small orbits meet in a fold, it does not.)
bool shrinks_to_equilibrium(const ParameterLine& line, const Advance& end) {
  constexpr double near = 0.2;  // in natural sizes
  const Motion& motion = end.motion;
  const model::System system = line.system_at(end.value);
  if (motion.kind != MotionKind::periodic || !system.autonomous()) return false;
  const auto centre = refine_equilibrium(system, motion.state);
  if (!centre) return false;
  const StateDifference difference(system);
  if (!std::all_of(motion.orbit.nodes.begin(), motion.orbit.nodes.end(),
                   [&](const Eigen::VectorXd& node) { return difference.distance(node, centre->state) < near; }))
    return false;
  // The smallest orbits cannot be distinguished from the equilibrium, so the change may come a little later.
  const double later = end.refused + std::copysign(coarse * line.step(), end.refused - end.value);
  const double beyond = std::clamp(later, line.values().front(), line.values().back());
  const auto after = refine_equilibrium(line.system_at(beyond), centre->state);
  return after && growing_ways(*centre) != growing_ways(*after);
}

// Whether the torus grew out of the periodic motion: nearly the same means, slightly wider extremes.
bool grew_from(const Motion& periodic, const Motion& torus) {
  return periodic.kind == MotionKind::periodic && torus.kind == MotionKind::quasi_periodic &&
         std::fabs(periodic.r_mean - torus.r_mean) < 0.05 * torus.r_max &&
         std::fabs(periodic.r_max - torus.r_max) < 0.1 * torus.r_max &&
         std::fabs(std::fabs(periodic.drift[0]) - std::fabs(torus.drift[0])) < 0.05 * std::fabs(torus.drift[0]);
}

BranchCause cause_of_kind(const Motion& below, const Motion& above) {
  if (!is_restless(above)) return BranchCause::to_periodic;
  if (!is_restless(below)) return BranchCause::from_periodic;
  return above.kind == MotionKind::chaotic ? BranchCause::torus_to_chaos : BranchCause::chaos_to_torus;
}

BranchEvent kind_change(const BranchContinuation& follower, const BranchPoint& low, const BranchPoint& high) {
  BranchEvent event;
  event.change = BranchChange::kind;
  event.low = low.value;
  event.high = high.value;
  Motion below = low.motion, above = high.motion;
  while (event.high - event.low > coarse * follower.line().step() * (1.0 + 1e-9) && !follower.stopped()) {
    const double middle = 0.5 * (event.low + event.high);
    const model::System system = follower.line().system_at(middle);
    auto found = motion_from(system, below.state);
    if (!found || !found->stable || !resembles(system.parameters(), below, *found))
      found = motion_from(system, above.state);
    if (!found || !found->stable || !resembles(system.parameters(), below, *found)) break;
    const bool like_below = found->kind == below.kind;
    (like_below ? event.low : event.high) = middle;
    (like_below ? below : above) = std::move(*found);
  }
  event.cause = cause_of_kind(low.motion, high.motion);  // between a torus and chaos the motion may lock for a while
  event.set_excursion(below);
  return event;
}

// Distance of the nearest multiplier from 1, or of the nearest eigenvalue from 0.
double nearest_to_fold(const Motion& motion) {
  double nearest = 1e300;
  const bool orbit = !motion.orbit.nodes.empty();
  for (const std::complex<double>& value : orbit ? motion.orbit.decays() : motion.spectrum)
    nearest = std::min(nearest, orbit ? std::abs(value - 1.0) : std::abs(value));
  return nearest;
}

// Towards a fold a multiplier approaches 1 like the root of the distance. A multiplier that is always near 1 (a slow
// motion) does not explain why the branch ends.
bool folds(const BranchContinuation& follower, const Advance& end) {
  constexpr double root_like = 1.3;  // at twice the distance: 1.41
  const double at_end = nearest_to_fold(end.motion);
  if (!(at_end < near_one)) return false;
  const double inwards = end.value > end.refused ? 1.0 : -1.0;
  Motion motion = end.motion;
  for (const double share : {fine, 4.0 * fine, coarse}) {
    auto found = follower.refine(motion, end.value + inwards * share * follower.line().step());
    if (!found) return false;
    if (nearest_to_fold(*found) > root_like * at_end) return true;
    motion = std::move(*found);
  }
  return false;
}

}  // namespace

BranchCause cause_of_end(const BranchContinuation& follower, const Advance& end) {
  const Motion& last = end.motion;
  if (end.carried) {
    if (end.beyond && grew_from(*end.beyond, last)) return BranchCause::neimark_sacker;
    return end.left ? BranchCause::attraction_ends : BranchCause::unresolved;
  }
  if (end.beyond && end.beyond->kind == MotionKind::periodic && last.kind == MotionKind::periodic) {
    Winding doubled = end.beyond->winding;
    for (int& turns : doubled) turns *= 2;
    if (last.winding == doubled && doubled != Winding{}) return BranchCause::period_doubling;
  }
  if (end.beyond && end.beyond->kind == last.kind && end.beyond->copies < last.copies) return BranchCause::pitchfork;
  if (shrinks_to_equilibrium(follower.line(), end)) return BranchCause::hopf;
  return folds(follower, end) ? BranchCause::fold : BranchCause::unresolved;
}

std::vector<BranchEvent> changes_between(const BranchContinuation& follower, const BranchPoint& low,
                                         const BranchPoint& high) {
  const bool restless = is_restless(low.motion) || is_restless(high.motion);
  std::vector<BranchEvent> events;
  if (restless && low.motion.kind != high.motion.kind) events.push_back(kind_change(follower, low, high));
  if (!restless && low.motion.stable != high.motion.stable) events.push_back(stability_change(follower, low, high));
  return events;
}

namespace {

struct Naming {
  Branch* branch = nullptr;
  int id = 0;
  std::size_t votes = 0, stable = 0, first = 0;
};

std::size_t stable_points(const Branch& branch) {
  return static_cast<std::size_t>(std::count_if(branch.points.begin(), branch.points.end(),
                                                [](const BranchPoint& point) { return point.motion.stable; }));
}

Naming name_one(const std::vector<model::System>& systems, Branch& branch) {
  Naming naming{&branch, 0, 0, stable_points(branch), branch.points.front().at};
  std::map<std::string, std::pair<int, MotionName>> names;
  for (const BranchPoint& point : branch.points) {
    if (naming.stable > 0 && !point.motion.stable) continue;
    const model::Parameters& p = systems[point.at].parameters();
    auto& [count, name] = names[family_of(p, point.motion)];
    const MotionName here = motion_name(p, point.motion);
    if (count++ == 0 || (name.id == 0 && here.id != 0)) name = here;
  }
  const auto most = std::max_element(names.begin(), names.end(),
                                     [](const auto& a, const auto& b) { return a.second.first < b.second.first; });
  branch.name = most->first;
  branch.alias = most->second.second.alias;
  naming.id = branch.name == "balanced" ? balanced_id : most->second.second.id;
  const auto first_kind = branch.points.front().motion.kind;
  const bool one_kind = std::all_of(branch.points.begin(), branch.points.end(),
                                    [&](const BranchPoint& point) { return point.motion.kind == first_kind; });
  if (one_kind) branch.name = most->second.second.name;  // with ", chaotic" if it is so throughout
  return naming;
}

}  // namespace

void name_branches(const std::vector<model::System>& systems, const std::vector<std::size_t>& votes,
                   std::vector<Branch>& branches) {
  std::vector<Naming> namings;
  for (std::size_t b = 0; b < branches.size(); ++b) {
    namings.push_back(name_one(systems, branches[b]));
    namings.back().votes = votes[b];
  }
  std::stable_sort(namings.begin(), namings.end(), [](const Naming& a, const Naming& b) {
    return std::tuple(b.votes, b.stable, a.first) < std::tuple(a.votes, a.stable, b.first);
  });
  std::set<int> taken;
  for (Naming& n : namings)
    if (n.id != 0 && !taken.insert(n.id).second) n.id = 0;
  // Free identifiers and numbers are given in the order in which branches begin.
  std::stable_sort(namings.begin(), namings.end(), [](const Naming& a, const Naming& b) {
    return (a.id != 0) != (b.id != 0) ? a.id != 0 : a.first < b.first;
  });
  int free = first_free_id;
  std::map<std::string, int> named;
  for (Naming& n : namings) {
    n.branch->id = n.id != 0 ? n.id : free++;
    if (const int earlier = named[n.branch->name]++; earlier > 0) {
      n.branch->name += fmt::format(" ({})", earlier + 1);
      n.branch->alias.clear();  // the paper's name belongs to one motion
    }
  }
  for (Branch& branch : branches)
    for (BranchEvent& event : branch.events) event.id = branch.id;
  std::sort(branches.begin(), branches.end(), [](const Branch& a, const Branch& b) { return a.id < b.id; });
}

}  // namespace equipoise
