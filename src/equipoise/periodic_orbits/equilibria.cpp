// Newton's method from random ball angles.
#include "equipoise/periodic_orbits/equilibria.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "equipoise/base/angles.hpp"
#include "equipoise/base/random.hpp"
#include "equipoise/math/assignment.hpp"
#include "equipoise/math/dense.hpp"
#include "equipoise/mechanics/balanced_state.hpp"
#include "equipoise/mechanics/linearisation.hpp"
#include "equipoise/periodic_orbits/recurrence.hpp"

namespace equipoise {

namespace {

using Eigen::VectorXd;

// Refined equilibria are exact to 1e-10; different ones lie farther apart, except those just born.
constexpr double same_equilibrium = 1e-6;
// A balanced rotor is centred to rounding.
constexpr double centred_rotor = 1e-9;

// The components of the centre and of the slope, which the equations are linear in while the balls are held.
std::vector<int> rotor_places(const model::System& system) {
  std::vector<int> places{0, 1, 2, 3};
  for (int k = 0; system.tilts() && k < 4; ++k) places.push_back(system.layout().tilt + k);
  return places;
}

// Where the rotor rests with its balls held at the angles of `state`.
void rest_rotor(const model::System& system, VectorXd& state) {
  const std::vector<int> places = rotor_places(system);
  const VectorXd rate = model::rate(system, state);
  const Eigen::MatrixXd jacobian = model::jacobian(system, state);
  const Eigen::MatrixXd own = jacobian(places, places);
  const VectorXd rest = rate(places);
  state(places) -= dense::inverse(own) * rest;
}

// With balls that are alike in the order that makes the distance least.
double distance_in_any_order(const model::System& system, const StateDifference& difference, const VectorXd& a,
                             const VectorXd& b) {
  const int n = system.balls();
  Eigen::MatrixXd cost(n, n);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const double apart = wrapped(a[model::index::phi(i)] - b[model::index::phi(k)]);
      cost(i, k) = system.alike(i, k) ? apart * apart : no_pair;
    }
  const std::vector<int> pairs = cheapest_pairs(cost);
  VectorXd d = difference(a, b);
  for (int i = 0; i < n; ++i) d[model::index::phi(i)] = d[model::index::q(i, n)] = 0.0;
  double square = d.squaredNorm();
  for (int i = 0; i < n; ++i) square += cost(i, pairs[static_cast<std::size_t>(i)]);
  return std::sqrt(square);
}

}  // namespace

std::vector<Equilibrium> unbalanced_equilibria(const model::System& system, int starts, const StopFlag* stop) {
  const StateDifference difference(system);
  RandomStream random;
  std::vector<Equilibrium> found;
  for (int k = 0; k < starts && !is_set(stop); ++k) {
    VectorXd state = VectorXd::Zero(system.dimension());
    for (int i = 0; i < system.balls(); ++i) state[model::index::phi(i)] = two_pi * random.uniform();
    rest_rotor(system, state);
    if (!state.allFinite()) continue;
    std::optional<Equilibrium> e = refine_equilibrium(system, state);
    if (!e || model::off_balance(system.parameters(), e->state) < centred_rotor) continue;
    e->state = system.with_angles_reduced(e->state);
    const auto is_it = [&](const Equilibrium& other) {
      return distance_in_any_order(system, difference, e->state, other.state) < same_equilibrium;
    };
    if (std::none_of(found.begin(), found.end(), is_it)) found.push_back(std::move(*e));
  }
  std::stable_sort(found.begin(), found.end(), [](const Equilibrium& a, const Equilibrium& b) {
    return a.eigenvalues[0].real() < b.eigenvalues[0].real();
  });
  return found;
}

}  // namespace equipoise
