// Orders of balls that cannot pass each other, and the energy below which they last.
#include "equipoise/classification/trapping_regions/stalled_region.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/orders.hpp"
#include "equipoise/machine/balance/room_in_race.hpp"

namespace equipoise {

namespace {

// All orders of four balls. With more, starts may meet the others.
constexpr std::size_t most_orders = 24;

std::vector<int> kinds_of(const model::System& system) {
  std::vector<int> kinds;
  for (int i = 0; i < system.balls(); ++i) {
    int kind = 0;
    while (!system.alike(kind, i)) ++kind;
    kinds.push_back(kind);
  }
  return kinds;
}

}  // namespace

std::vector<int> order_of(const model::System& system, const double* state) {
  if (!system.events().contact || system.parameters().equal_balls()) return {};
  const std::vector<int> kinds = kinds_of(system);
  const int n = system.balls();
  std::array<double, model::max_balls> from_below{};
  std::vector<int> order;
  for (int i = 0; i < n; ++i) {
    from_below[i] = wrapped(state[system.layout().psi] + state[model::index::phi(i)] + 0.5 * pi);
    order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&](int a, int b) { return from_below[a] < from_below[b]; });
  for (int& ball : order) ball = kinds[ball];
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

}  // namespace equipoise
