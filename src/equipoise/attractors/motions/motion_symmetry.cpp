// Compares motions under exchange of alike balls, shifts in time and whole turns.
#include "equipoise/attractors/motions/motion_symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "equipoise/attractors/equilibria/equilibria.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/orders.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"

namespace equipoise {

// The Hungarian method with potentials: rows join one after the other, each by the shortest way that lets the earlier
// ones take other columns.
std::vector<int> cheapest_pairs(const Eigen::MatrixXd& cost) {
  const int n = static_cast<int>(cost.rows()), none = n;
  // Column n stands for the row that is about to join.
  std::vector<double> of_row(static_cast<std::size_t>(n)), of_column(static_cast<std::size_t>(n) + 1);
  std::vector<int> row_of(static_cast<std::size_t>(n) + 1, none), before(row_of.size());
  for (int row = 0; row < n; ++row) {
    std::vector<double> least(row_of.size(), std::numeric_limits<double>::infinity());
    std::vector<char> seen(row_of.size());
    int at = n;
    row_of[at] = row;
    while (row_of[at] != none) {
      seen[at] = true;
      double step = std::numeric_limits<double>::infinity();
      int next = 0;
      for (int k = 0; k < n; ++k) {
        if (seen[k]) continue;
        const double reduced = cost(row_of[at], k) - of_row[row_of[at]] - of_column[k];
        if (reduced < least[k]) {
          least[k] = reduced;
          before[k] = at;
        }
        if (least[k] < step) {
          step = least[k];
          next = k;
        }
      }
      for (int k = 0; k <= n; ++k)
        if (seen[k]) {
          of_row[row_of[k]] += step;
          of_column[k] -= step;
        } else {
          least[k] -= step;
        }
      at = next;
    }
    for (; at != n; at = before[at]) row_of[at] = row_of[before[at]];
  }
  std::vector<int> column_of(static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k) {
    if (!(cost(row_of[k], k) < no_pair)) return {};
    column_of[row_of[k]] = k;
  }
  return column_of;
}

// ways[set]: for the first rows, as many as there are columns in the set.
std::int64_t count_pairings(const Eigen::MatrixXi& allowed) {
  const int n = static_cast<int>(allowed.rows());
  std::vector<std::int64_t> ways(std::size_t{1} << n);
  ways[0] = 1;
  for (std::size_t set = 0; set < ways.size(); ++set) {
    if (ways[set] == 0) continue;
    int row = 0;
    for (std::size_t rest = set; rest != 0; rest &= rest - 1) ++row;
    for (int k = 0; row < n && k < n; ++k)
      if (!(set >> k & 1) && allowed(row, k) != 0) ways[set | std::size_t{1} << k] += ways[set];
  }
  return ways.back();
}

namespace {

// Point sets this close are the same. Refined motions are exact to 1e-10 or better. Different ones lie much further
// apart, except those just born in a bifurcation.
constexpr double same_point = 1e-6;
// Points of a curve that are interpolated before they are compared.
constexpr double near_point = 1e-5;
// For measured statistics. On a torus extremes and means settle like 1/duration. Those of chaos scatter, extremes most
// (three balls, slow chaos: the mean r by 8 %, extremes of rates by 27 % between stretches of 10 000).
struct Sameness {
  double means, extremes;
};
constexpr Sameness same_torus{0.02, 0.02}, same_chaos{0.1, 0.3};

Eigen::VectorXd exchanged(const Eigen::VectorXd& state, int balls, const BallOrder& order) {
  return state(exchanged_components(balls, order, state.size()));
}

// Pairs the balls of two states, with allowed(i, k) for ball i of `a` and ball k of `b`, so that the states are as
// close as an exchange of balls makes them.
class Matching {
 public:
  Matching(const model::System& system, const StateDifference& difference, Eigen::MatrixXi allowed)
      : n_(system.balls()), difference_(difference), allowed_(std::move(allowed)), cost_(n_, n_) {}

  // The distance that is left. Infinite if there is no such pairing.
  double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    const Eigen::VectorXd d = difference_(a, b);
    double square = d.head(4).squaredNorm() + d.tail(d.size() - model::dimension(n_)).squaredNorm();
    // Differences of all balls, a turn of the list after the other.
    for (int shift = 0; shift < n_; ++shift) {
      for (int i = 0; i < n_; ++i) turned_[i] = (i + shift) % n_;
      const Eigen::VectorXd e = difference_(a, exchanged(b, n_, turned_));
      for (int i = 0; i < n_; ++i)
        cost_(i, turned_[i]) = allowed_(i, turned_[i]) ? e[model::index::phi(i)] * e[model::index::phi(i)] +
                                                             e[model::index::q(i, n_)] * e[model::index::q(i, n_)]
                                                       : no_pair;
    }
    pairs_ = cheapest_pairs(cost_);
    if (pairs_.empty()) return std::numeric_limits<double>::infinity();
    for (int i = 0; i < n_; ++i) square += cost_(i, pairs_[i]);
    return std::sqrt(square);
  }
  // Of the last distance: ball order()[i] of `b` is nearest to ball i of `a`.
  BallOrder order() const {
    BallOrder order{};
    std::copy(pairs_.begin(), pairs_.end(), order.begin());
    return order;
  }

 private:
  int n_;
  const StateDifference& difference_;
  Eigen::MatrixXi allowed_;
  Eigen::MatrixXd cost_;
  BallOrder turned_{};
  std::vector<int> pairs_;
};

Eigen::MatrixXi pairs_where(int balls, const std::function<bool(int, int)>& allowed) {
  Eigen::MatrixXi pairs(balls, balls);
  for (int i = 0; i < balls; ++i)
    for (int k = 0; k < balls; ++k) pairs(i, k) = allowed(i, k) ? 1 : 0;
  return pairs;
}

double largest_rate(const Motion& m, int balls) {
  double rate = 0.0;
  for (int i = 0; i < balls; ++i) rate = std::max({rate, std::fabs(m.rate_min[i]), std::fabs(m.rate_max[i])});
  return rate;
}

// Whether ball k of `b` does what ball i of `a` does, to shares of the largest rate.
bool same_ball(const Motion& a, int i, const Motion& b, int k, const Sameness& share, double rate) {
  const auto close = [rate](double f, double g, double to) { return std::fabs(f - g) <= to * rate + 1e-9; };
  return close(a.drift[i], b.drift[k], share.means) && close(a.rate_min[i], b.rate_min[k], share.extremes) &&
         close(a.rate_max[i], b.rate_max[k], share.extremes);
}

Sameness sameness(const Motion& m) {
  if (m.kind == MotionKind::chaotic) return same_chaos;
  return m.kind == MotionKind::quasi_periodic ? same_torus : Sameness{1e-5, 1e-5};
}

bool is_balanced_continuum(const model::System& system, const Motion& motion) {
  return is_balanced(system, motion) && model::balanced_freedom(system) > 0;
}

// Product of the factorials of the sizes of classes that `like`, an equivalence, makes of the balls.
std::int64_t orders_within(int balls, const std::function<bool(int, int)>& like) {
  std::int64_t orders = 1;
  for (int i = 0; i < balls; ++i) {
    int place = 1;
    for (int k = 0; k < i; ++k) place += like(i, k);
    orders *= place;
  }
  return orders;
}

// Balls that are alike and move as one, or rest in one place: to exchange them changes nothing.
bool are_one(const model::System& system, const Motion& m, int i, int k) {
  if (!system.alike(i, k)) return false;
  if (m.kind == MotionKind::periodic) return m.cluster[i] == m.cluster[k];
  if (m.kind != MotionKind::equilibrium) return false;
  if (has_free_angle(system, m.state, i)) return true;
  return std::fabs(wrapped(m.state[model::index::phi(i)] - m.state[model::index::phi(k)])) < same_point;
}

// Exchanges that a periodic motion turns into shifts in time, those of balls that move as one apart. They form a cyclic
// group: a shift that leaves every ball in its place is a whole period. Its order is a product of powers of primes p^a,
// each of which is the order of the shift by a p^a-th of the period and moves p^a balls in a cycle.
std::int64_t count_shifts(const model::System& system, const Motion& motion, const OrbitCurve& orbit,
                          const StateDifference& difference, const Eigen::MatrixXi& allowed) {
  const int n = system.balls();
  Matching matching(system, difference, allowed);
  std::int64_t shifts = 1;
  for (int prime = 2; prime <= n; ++prime) {
    bool divides = false;
    for (int k = 2; k < prime; ++k) divides = divides || prime % k == 0;
    for (int power = prime; !divides && power <= n; power *= prime) {
      if (motion.orbit.imposed && motion.orbit.nodes.size() % static_cast<std::size_t>(power) != 0) break;
      if (!(matching.distance(orbit.at(1.0 / power), motion.state) < near_point)) break;
      if (!(orbit.distance(exchanged(motion.state, n, matching.order())) < same_point)) break;
      shifts *= prime;
    }
  }
  return shifts;
}

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

double distance_in_any_order(const model::System& system, const StateDifference& difference, const Eigen::VectorXd& a,
                             const Eigen::VectorXd& b) {
  const auto alike = [&](int i, int k) { return system.alike(i, k); };
  return Matching(system, difference, pairs_where(system.balls(), alike)).distance(a, b);
}

std::vector<BallOrder> exchange_images(const model::System& system, const Motion& motion) {
  const int n = system.balls();
  std::optional<OrbitCurve> orbit;
  if (!motion.orbit.nodes.empty()) orbit.emplace(system, motion.orbit);
  const StateDifference difference(system);
  const double rate = largest_rate(motion, n);
  std::vector<BallOrder> images;
  // Each image is visited once for every shift in time that leaves the motion alone. Where rounding decides what is the
  // same, images could be fewer than copies.
  constexpr int most_visited = 40320;
  int visited = 0;
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
      n, [&](int i, int k) { return system.alike(i, k); }, [&](int i, int k) { return are_one(system, motion, i, k); },
      [&](const std::vector<int>& places) {
        BallOrder order{};
        std::copy(places.begin(), places.end(), order.begin());
        if (std::none_of(images.begin(), images.end(), [&](const BallOrder& e) { return makes_the_same(e, order); }))
          images.push_back(order);
        return static_cast<std::int64_t>(images.size()) == motion.copies || ++visited == most_visited;
      });
  return images;
}

bool is_half_period_exchange(const model::System& system, const PeriodicOrbit& orbit) {
  if (system.balls() != 2 || !system.alike(0, 1)) return false;
  const std::vector<Eigen::VectorXd> halves = sample_orbit(system, orbit, 2);
  return StateDifference(system).distance(exchanged(halves[0], 2, {1, 0}), halves[1]) < same_point;
}

std::int64_t count_copies(const model::System& system, const Motion& motion) {
  const int n = system.balls();
  // All members of a continuum of balanced states are one motion, and so are their exchange images.
  if (is_balanced_continuum(system, motion)) return 1;
  // All orders of alike balls, over those that change nothing.
  const std::int64_t all = orders_within(n, [&](int i, int k) { return system.alike(i, k); });
  const double rate = largest_rate(motion, n);
  const Eigen::MatrixXi allowed = pairs_where(
      n, [&](int i, int k) { return system.alike(i, k) && same_ball(motion, i, motion, k, sameness(motion), rate); });
  if (never_repeats(motion.kind) || motion.kind == MotionKind::measured)
    return all / std::max<std::int64_t>(count_pairings(allowed), 1);
  std::int64_t unchanged = orders_within(n, [&](int i, int k) { return are_one(system, motion, i, k); });
  if (motion.kind == MotionKind::periodic) {
    const OrbitCurve orbit(system, motion.orbit);
    unchanged *= count_shifts(system, motion, orbit, StateDifference(system), allowed);
  }
  return all / unchanged;
}

bool is_balanced(const model::System& system, const Motion& motion) {
  return motion.kind == MotionKind::equilibrium && model::off_balance(system.parameters(), motion.state) < same_point;
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
  const Sameness share = a.kind != b.kind ? same_torus : sameness(a);
  const bool both_balanced = is_balanced_continuum(system, a) && is_balanced_continuum(system, b);
  if (std::fabs(a.speed - b.speed) > (a.motor ? share.means * std::fabs(a.speed) + 1e-9 : 0.0) && !both_balanced)
    return false;
  if (a.kind == MotionKind::equilibrium && same_continuum(system, a.state, b.state)) return true;
  // Slow drift may hide in such shares.
  const bool chaos = a.kind == MotionKind::chaotic && b.kind == MotionKind::chaotic;
  if (chaos && motion_name(p, a).name != motion_name(p, b).name) return false;
  const auto close = [&](double f, double g, double to) {
    return std::fabs(f - g) <= to * std::max(a.r_max, b.r_max) + 1e-9;
  };
  if (!close(a.r_min, b.r_min, share.extremes) || !close(a.r_mean, b.r_mean, share.means) ||
      !close(a.r_max, b.r_max, share.extremes))
    return false;
  const double rate = std::max(largest_rate(a, n), largest_rate(b, n));
  const Eigen::MatrixXi allowed = pairs_where(n, [&](int i, int k) {
    return system.alike(i, k) && (a.kind == MotionKind::equilibrium || same_ball(b, i, a, k, share, rate));
  });
  if (measured(a) || (a.eventful && a.kind == MotionKind::periodic)) return count_pairings(allowed) > 0;
  const StateDifference difference(system);
  Matching matching(system, difference, allowed);
  if (a.kind == MotionKind::equilibrium) return both_balanced || matching.distance(b.state, a.state) < same_point;
  // One common point is enough: orbits that meet are one orbit.
  return OrbitCurve(system, b.orbit)
             .least([&](const Eigen::VectorXd& point) { return matching.distance(point, a.state); }, same_point) <
         same_point;
}

}  // namespace equipoise
