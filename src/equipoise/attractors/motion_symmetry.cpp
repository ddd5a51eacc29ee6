// Compares motions under exchange of alike balls, shifts in time and whole turns.
#include "equipoise/attractors/motion_symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <vector>

#include "equipoise/mechanics/balanced_state.hpp"
#include "equipoise/periodic_orbits/recurrence.hpp"

namespace equipoise {

namespace {

// Point sets this close are the same. Refined motions are exact to 1e-10 or better. Different ones lie much farther
// apart, except those just born in a bifurcation.
constexpr double same_point = 1e-6;
// For measured statistics. On a torus extremes and means settle like 1/duration. Those of chaos scatter (Omega = 2.5,
// beta = 0.05: r_max by 10 % between stretches of 400).
constexpr double same_torus = 0.02, same_chaos = 0.1;

Eigen::VectorXd exchanged(const Eigen::VectorXd& state, int balls, const BallOrder& order) {
  return state(exchanged_components(balls, order, state.size()));
}

// Calls visit(order) for every order in which may_replace(i, order[i]) holds throughout, until it returns true.
bool any_order(int balls, const std::function<bool(int, int)>& may_replace,
               const std::function<bool(const BallOrder&)>& visit) {
  BallOrder order{};
  std::array<bool, model::max_balls> taken{};
  const std::function<bool(int)> place = [&](int i) {
    if (i == balls) return visit(order);
    for (int k = 0; k < balls; ++k) {
      if (taken[k] || !may_replace(i, k)) continue;
      taken[k] = true;
      order[i] = k;
      if (place(i + 1)) return true;
      taken[k] = false;
    }
    return false;
  };
  return place(0);
}

double largest_rate(const Motion& m, int balls) {
  double rate = 0.0;
  for (int i = 0; i < balls; ++i) rate = std::max({rate, std::fabs(m.rate_min[i]), std::fabs(m.rate_max[i])});
  return rate;
}

// Whether ball k of `b` does what ball i of `a` does, to `share` of the largest rate.
bool same_ball(const Motion& a, int i, const Motion& b, int k, double share, double rate) {
  const double within = share * rate + 1e-9;
  return std::fabs(a.drift[i] - b.drift[k]) <= within && std::fabs(a.rate_min[i] - b.rate_min[k]) <= within &&
         std::fabs(a.rate_max[i] - b.rate_max[k]) <= within;
}

double sameness(const Motion& m) {
  return m.kind == MotionKind::chaotic ? same_chaos : m.kind == MotionKind::quasi_periodic ? same_torus : 1e-5;
}

bool is_balanced_continuum(const model::System& system, const Motion& motion) {
  return is_balanced(system, motion) && model::balanced_freedom(system) > 0;
}

long factorial(long k) { return k < 2 ? 1 : k * factorial(k - 1); }

}  // namespace

Eigen::VectorXi exchanged_components(int balls, const BallOrder& order, Eigen::Index size) {
  if (size == 0) size = model::dimension(balls);
  Eigen::VectorXi from = Eigen::VectorXi::LinSpaced(size, 0, static_cast<int>(size) - 1);
  for (int i = 0; i < balls; ++i) {
    from[model::index::phi(i)] = model::index::phi(order[i]);
    from[model::index::q(i, balls)] = model::index::q(order[i], balls);
  }
  return from;
}

std::vector<BallOrder> exchange_images(const model::System& system, const Motion& motion) {
  const int n = system.balls();
  std::optional<OrbitCurve> orbit;
  if (!motion.orbit.nodes.empty()) orbit.emplace(system, motion.orbit);
  const StateDifference difference(system);
  const double rate = largest_rate(motion, n);
  std::vector<BallOrder> images;
  // Two orders make the same motion if the exchange between them leaves the motion alone.
  const auto makes_the_same = [&](const BallOrder& earlier, const BallOrder& order) {
    BallOrder between{};
    for (int i = 0; i < n; ++i) between[earlier[i]] = order[i];
    for (int i = 0; i < n; ++i)
      if (!same_ball(motion, i, motion, between[i], sameness(motion), rate)) return false;
    const Eigen::VectorXd there = exchanged(motion.state, n, between);
    return (orbit ? orbit->distance(there) : difference.distance(motion.state, there)) < same_point;
  };
  any_order(
      n, [&](int i, int k) { return system.alike(i, k); },
      [&](const BallOrder& order) {
        if (std::none_of(images.begin(), images.end(), [&](const BallOrder& e) { return makes_the_same(e, order); }))
          images.push_back(order);
        return static_cast<int>(images.size()) == motion.copies;
      });
  return images;
}

bool is_half_period_exchange(const model::System& system, const PeriodicOrbit& orbit) {
  if (system.balls() != 2 || !system.alike(0, 1)) return false;
  const std::vector<Eigen::VectorXd> halves = sample_orbit(system, orbit, 2);
  return StateDifference(system).distance(exchanged(halves[0], 2, {1, 0}), halves[1]) < same_point;
}

int count_copies(const model::System& system, const Motion& motion) {
  const int n = system.balls();
  // All members of a continuum of balanced states are one motion, and so are their exchange images.
  if (is_balanced_continuum(system, motion)) return 1;
  long images = 1;  // orders of alike balls ...
  for (int i = 0; i < n; ++i) {
    bool first = true;
    long size = 0;
    for (int k = 0; k < n; ++k) {
      if (!system.alike(i, k)) continue;
      first = first && k >= i;
      ++size;
    }
    if (first) images *= factorial(size);
  }
  long unchanged = 0;  // ... over those that change nothing
  const double rate = largest_rate(motion, n);
  if (motion.kind == MotionKind::periodic) {
    // Alike balls that move as one may be exchanged at will. Of all orders that differ only in this, the one that keeps
    // them rising is tried and counts for all.
    long within = 1;
    for (int i = 0; i < n; ++i) {
      int place = 1;
      for (int k = 0; k < i; ++k) place += motion.cluster[k] == motion.cluster[i] && system.alike(i, k);
      within *= place;
    }
    const OrbitCurve orbit(system, motion.orbit);
    any_order(
        n, [&](int i, int k) { return system.alike(i, k) && same_ball(motion, i, motion, k, sameness(motion), rate); },
        [&](const BallOrder& order) {
          for (int i = 0; i < n; ++i)
            for (int k = 0; k < i; ++k)
              if (motion.cluster[order[k]] == motion.cluster[order[i]] && system.alike(i, k) && order[k] > order[i])
                return false;
          if (orbit.distance(exchanged(motion.state, n, order)) < same_point) unchanged += within;
          return false;
        });
  } else {
    const StateDifference difference(system);
    any_order(
        n, [&](int i, int k) { return system.alike(i, k) && same_ball(motion, i, motion, k, sameness(motion), rate); },
        [&](const BallOrder& order) {
          unchanged += motion.kind != MotionKind::equilibrium ||
                       difference.distance(exchanged(motion.state, n, order), motion.state) < same_point;
          return false;
        });
  }
  return static_cast<int>(images / std::max(unchanged, 1L));
}

bool is_balanced(const model::System& system, const Motion& motion) {
  return motion.kind == MotionKind::equilibrium &&
         model::off_balance(system.parameters(), motion.state[0], motion.state[1]) < same_point;
}

bool same_motion(const model::Parameters& p, const Motion& a, const Motion& b) {
  const model::System system = system_of(p, a);
  const int n = p.balls;
  if (a.motor.has_value() != b.motor.has_value()) return false;
  // The rest of a continuum under dry friction is one motion, identified by its name.
  if (a.set_valued || b.set_valued)
    return a.set_valued && b.set_valued && motion_name(p, a).name == motion_name(p, b).name;
  if (a.eventful != b.eventful) return false;
  const auto measured = [](const Motion& m) { return never_repeats(m.kind); };
  if (a.kind != b.kind && !(measured(a) && measured(b))) return false;
  if (a.kind == MotionKind::periodic && std::fabs(a.period - b.period) > same_point * a.period) return false;
  const double share = a.kind != b.kind ? same_torus : sameness(a);
  const bool both_balanced = is_balanced_continuum(system, a) && is_balanced_continuum(system, b);
  if (std::fabs(a.speed - b.speed) > (a.motor ? share * std::fabs(a.speed) + 1e-9 : 0.0) && !both_balanced)
    return false;
  const auto close = [&](double f, double g) { return std::fabs(f - g) <= share * std::max(a.r_max, b.r_max) + 1e-9; };
  if (!close(a.r_min, b.r_min) || !close(a.r_mean, b.r_mean) || !close(a.r_max, b.r_max)) return false;
  const double rate = std::max(largest_rate(a, n), largest_rate(b, n));
  const auto may_replace = [&](int i, int k) {
    return system.alike(i, k) && (a.kind == MotionKind::equilibrium || same_ball(b, i, a, k, share, rate));
  };
  if (measured(a) || (a.eventful && a.kind == MotionKind::periodic))
    return any_order(n, may_replace, [](const BallOrder&) { return true; });
  if (a.kind == MotionKind::equilibrium) {
    if (both_balanced) return true;
    const StateDifference difference(system);
    return any_order(n, may_replace, [&](const BallOrder& order) {
      return difference.distance(exchanged(a.state, n, order), b.state) < same_point;
    });
  }
  // One common point is enough: orbits that meet are one orbit.
  const OrbitCurve orbit(system, b.orbit);
  return any_order(n, may_replace,
                   [&](const BallOrder& order) { return orbit.distance(exchanged(a.state, n, order)) < same_point; });
}

}  // namespace equipoise
