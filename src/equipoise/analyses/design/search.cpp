// Latin hypercubes: where the optimisers begin, and what searches without them.
#include "equipoise/analyses/design/search.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace equipoise {

namespace {

constexpr std::size_t at_a_time = 32;  // points per batch: work for many threads

// Fisher and Yates.
void shuffle(std::vector<std::size_t>& places, RandomStream& draws) {
  for (std::size_t k = places.size(); k > 1; --k)
    std::swap(places[k - 1], places[static_cast<std::size_t>(draws.uniform() * static_cast<double>(k))]);
}

// One hypercube with as many points as will probably be judged, then others.
void latin_points(const SearchSpace& space, RandomStream draws, const Judge& judge) {
  for (;;) {
    const auto points =
        search_methods::latin_hypercube(space.dimensions, static_cast<std::size_t>(space.points), draws);
    for (std::size_t first = 0; first < points.size(); first += at_a_time)
      judge({points.begin() + static_cast<std::ptrdiff_t>(first),
             points.begin() + static_cast<std::ptrdiff_t>(std::min(first + at_a_time, points.size()))});
  }
}

}  // namespace

std::vector<SearchPoint> search_methods::latin_hypercube(std::size_t dimensions, std::size_t count,
                                                         RandomStream& draws) {
  std::vector<SearchPoint> points(count, SearchPoint(dimensions));
  for (std::size_t d = 0; d < dimensions; ++d) {
    std::vector<std::size_t> parts(count);
    std::iota(parts.begin(), parts.end(), std::size_t{0});
    shuffle(parts, draws);
    for (std::size_t k = 0; k < count; ++k)
      points[k][d] = (static_cast<double>(parts[k]) + draws.uniform()) / static_cast<double>(count);
  }
  return points;
}

void search(DesignMethod method, const SearchSpace& space, std::uint64_t seed, const Judge& judge) {
  try {
    switch (method) {
      case DesignMethod::cmaes:
        return search_methods::cmaes(space, seed, judge);
      case DesignMethod::nsga2:
        return search_methods::nsga2(space, seed, judge);
      case DesignMethod::latin:
        return latin_points(space, RandomStream(seed), judge);
      case DesignMethod::automatic:
        break;
    }
  } catch (const SearchOver&) {
    return;
  }
  throw std::logic_error("a search needs a method");
}

}  // namespace equipoise
