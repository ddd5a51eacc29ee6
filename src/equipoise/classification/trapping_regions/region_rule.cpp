// Tables for lanes, and functions for single states: also which rest a stalled rotor comes to, by the order of balls
// that cannot pass each other.
#include "equipoise/classification/trapping_regions/region_rule.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "equipoise/attractors/equilibria/stuck.hpp"
#include "equipoise/attractors/motions/approach.hpp"
#include "equipoise/attractors/periodic_orbits/stroboscopic_section.hpp"
#include "equipoise/classification/balanced_regions/family_regions.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/orders.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/balance/room_in_race.hpp"
#include "equipoise/machine/model/unbalance.hpp"
#include "equipoise/simulation/batch/own_rotor.hpp"

namespace equipoise {

namespace {

// The unbalance on the continuum: 0 except with an off-centre race.
std::complex<double> unbalance_of_rest(const model::System& system) {
  const model::Parameters& p = system.parameters();
  const model::CentredTwin twin = model::centred_twin(p, model::balanced_speed(system).value_or(0.0));
  return p.eccentricity - std::polar(twin.parameters.eccentricity, twin.turn);
}

// Whether ball velocities and unbalance are within reach of those on the continuum.
bool balls_in_reach(const model::Parameters& p, const ContinuumRegion& region, std::complex<double> rest,
                    const double* state) {
  double away = std::abs(model::unbalance(p, state + model::index::phi(0)) - rest);
  for (int i = 0; i < p.balls; ++i) away = std::max(away, std::fabs(state[model::index::q(i, p.balls)]));
  return away < region.reach;
}

bool rotor_in_reach(const ContinuumRegion& region, const Eigen::VectorXd& state) {
  return (state.head(4) - region.place).lpNorm<Eigen::Infinity>() < region.reach;
}

// For comparing states with levels known to percents, at deviations of 1e-3 and more.
constexpr double near_enough = 1e-8;

// Finding the member that a state comes to is costly, and a refused state may stay near the continuum for long. It is
// tested again once the rotor has turned by a further share of all its turning. `half`: the turning in half a window,
// after which tests are made.
bool is_due(double psi, double half) {
  constexpr double later = 0.2;
  const double before = std::fabs(psi) - half;
  if (before <= half) return true;
  const auto times = [](double turned) { return std::floor(std::log(turned) / std::log1p(later)); };
  return times(std::fabs(psi)) != times(before);
}

// If gravity leaves motion on a continuum, the state on the next section is tested.
SharedRegions continuum_on_section(const model::System& system, const ContinuumRegion& region, double window) {
  return regions_by([system, region, passing = without_events(system), rest_of_all = unbalance_of_rest(system),
                     half = 0.5 * window * std::fabs(system.speed())](const double* at, double psi,
                                                                      const OwnRotor* own) -> Caught {
    const model::Parameters& p = (own ? own->system : system).parameters();
    const std::complex<double> rest = own ? unbalance_of_rest(own->system) : rest_of_all;
    if (!balls_in_reach(p, region, rest, at) || !is_due(psi, half)) return {};
    // This close to balance it does not matter whether balls touch on the way.
    const auto state = at_next_section(own ? without_events(own->system) : passing,
                                       Eigen::Map<const Eigen::VectorXd>(at, passing.dimension()), psi, near_enough);
    const bool holds = state && balls_in_reach(p, region, rest, state->data()) && rotor_in_reach(region, *state) &&
                       region.holds(*state, own);
    return {holds ? balanced_id : 0};
  });
}

// For a rotor of its own, the region of a balanced motion moves as the balanced state does.
SharedRegions cycles_on_section(const model::System& system, const OrbitRegions& cycles) {
  return regions_by([system, cycles](const double* state, double psi, const OwnRotor* own) -> Caught {
    // For all regions: to find balanced states costs as much as to test many.
    std::optional<std::vector<Eigen::VectorXd>> shifts;
    for (const auto& region : cycles) {
      double least = infinite;
      if (own && region->attractor == balanced_id) {
        if (!shifts) shifts = balanced_shifts(own->system, system);
        for (const Eigen::VectorXd& shift : *shifts) {
          const Eigen::VectorXd moved = Eigen::Map<const Eigen::VectorXd>(state, system.dimension()) - shift;
          least = std::min(least, value(system, *region, moved.data(), psi));
        }
      } else {
        least = value(system, *region, state, psi);
      }
      if (least < region->level) return {region->attractor};
    }
    return {};
  });
}

// All orders of four balls. With more, starts may meet the others.
constexpr std::size_t most_orders = 24;

// A rotor of its own has a well of its own, equally deep for every order of its balls.
SharedRegions stalled_rotors(const model::System& system, const StalledRegion& stalled) {
  return regions_by([system, stalled](const double* state, double, const OwnRotor* own) -> Caught {
    if (!own) return {stalled.caught(system, state)};
    const auto well = model::GravityWell::of(own->system);
    return {well ? StalledRegion{*well, stalled.rests}.caught(own->system, state) : 0};
  });
}

SharedRegions asked_in_turn(std::vector<SharedRegions> all) {
  return regions_by([all = std::move(all)](const double* state, double psi, const OwnRotor* own) -> Caught {
    for (const SharedRegions& regions : all)
      if (const Caught caught = regions->ask(state, psi, own); caught.attractor) return caught;
    return {};
  });
}

}  // namespace

std::vector<int> order_of(const model::System& system, const double* state) {
  if (!system.events().contact || system.parameters().equal_balls()) return {};
  const int n = system.balls();
  std::array<double, model::max_balls> from_below{};
  std::vector<int> order;
  for (int i = 0; i < n; ++i) {
    from_below[i] = wrapped(state[system.layout().psi] + state[model::index::phi(i)] + 0.5 * pi);
    order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&](int a, int b) { return from_below[a] < from_below[b]; });
  for (int& ball : order) {
    int kind = 0;
    while (!system.alike(kind, ball)) ++kind;
    ball = kind;
  }
  return order;
}

int StalledRegion::caught(const model::System& system, const double* state) const {
  if (!well.holds(state)) return 0;
  const std::vector<int> order = order_of(system, state);
  if (!order.empty() && !well.holds_balls(state)) return 0;
  for (const Rest& rest : rests)
    if (rest.order == order) return rest.attractor;
  return 0;
}

std::vector<Eigen::VectorXd> places_to_hang(const model::System& system, const model::GravityWell& well) {
  const int n = system.balls();
  const double contact = system.parameters().contact_angle;
  std::vector<std::vector<int>> seen;
  std::vector<Eigen::VectorXd> places;
  any_order(
      n, [](int, int) { return true; }, [&](int i, int k) { return system.alike(i, k); },
      [&](const std::vector<int>& balls) {
        Eigen::VectorXd state = well.bottom();
        for (int k = 0; k < n; ++k)
          state[model::index::phi(balls[k])] += model::side_by_side * contact * (k - 0.5 * (n - 1));
        const std::vector<int> order = order_of(system, state.data());
        if (std::find(seen.begin(), seen.end(), order) != seen.end()) return order.empty();
        seen.push_back(order);
        places.push_back(std::move(state));
        return places.size() == most_orders;
      });
  return places;
}

void set_regions(ClassificationRule& rule, const model::System& system, const OrbitRegions& cycles,
                 const std::optional<ContinuumRegion>& continuum, const std::optional<StalledRegion>& stalled) {
  rule.cycles.clear();
  rule.continuum = {};
  std::vector<SharedRegions> on_section;
  if (stalled) on_section.push_back(stalled_rotors(system, *stalled));
  if (system.autonomous())
    for (const auto& region : cycles) rule.cycles.push_back(table_of(*region, system.balls()));
  else if (!cycles.empty())
    on_section.push_back(cycles_on_section(system, cycles));
  // Lanes measure the way to a continuum from the centred rotor.
  if (continuum && system.autonomous() && system.parameters().race_is_centred())
    rule.continuum = {continuum->reach, regions_by([region = *continuum, size = system.dimension()](
                                                       const double* state, double, const OwnRotor* own) -> Caught {
                        return {region.holds(Eigen::Map<const Eigen::VectorXd>(state, size), own) ? balanced_id : 0};
                      })};
  else if (continuum)
    on_section.push_back(continuum_on_section(system, *continuum, rule.window));
  rule.section.regions = on_section.empty() ? nullptr : asked_in_turn(std::move(on_section));
}

SharedRegions stuck_balls(const model::System& system, const Catalogue& listed) {
  return regions_by([system, listed](const double* state, double psi, const OwnRotor* own) -> Caught {
    const model::System& rotor = own ? own->system : system;
    const Eigen::Map<const Eigen::VectorXd> y(state, system.dimension());
    const auto end = stuck_for_good(rotor, y, psi);
    return {end ? listed.find(rotor.parameters(), describe_stuck(rotor, *end)) : 0};
  });
}

}  // namespace equipoise
