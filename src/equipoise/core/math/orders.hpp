// Orders of things some of which are alike.
#pragma once

#include <vector>

namespace equipoise {

/// Calls visit(order) for orders of the things 0 .. count - 1 in lexicographic order, until it returns true; returns
/// whether it did. Thing order[i] takes place i where fits(i, order[i]) holds. Of all orders that differ only in the
/// places of things that are like each other, the first one is visited: there they rise. `like` is an equivalence, and
/// like things fit in the same places.
template <class Fits, class Like, class Visit>
bool any_order(int count, const Fits& fits, const Like& like, const Visit& visit) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::vector<char> taken(order.size());
  const auto place = [&](const auto& self, int i) -> bool {
    if (i == count) return visit(order);
    for (int k = 0; k < count; ++k) {
      if (taken[k] || !fits(i, k)) continue;
      bool first = true;
      for (int j = 0; j < k && first; ++j) first = taken[j] || !like(j, k);
      if (!first) continue;
      taken[k] = true;
      order[i] = k;
      if (self(self, i + 1)) return true;
      taken[k] = false;
    }
    return false;
  };
  return place(place, 0);
}

}  // namespace equipoise
