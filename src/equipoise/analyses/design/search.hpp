// Proposes points of a cube to a judge that says how good they are; knows no study and no physics.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <vector>

#include "equipoise/core/base/random.hpp"
#include "equipoise/results/commands/design_result.hpp"

namespace equipoise {

/// Thrown by a judge that wants no more points.
struct SearchOver final : std::exception {
  const char* what() const noexcept override { return "the search is over"; }
};

/// A point of the cube, each coordinate from 0 to 1, and its worth: one number per objective, less is better.
using SearchPoint = std::vector<double>;
using SearchWorth = std::vector<double>;
/// Worths of a batch of points, in order. May throw SearchOver.
using Judge = std::function<std::vector<SearchWorth>(const std::vector<SearchPoint>&)>;

struct SearchSpace {
  std::size_t dimensions = 1, objectives = 1;
  std::uint64_t points = 1000;  ///< probably judged
};

/// Proposes points until `judge` throws SearchOver; the same points for the same seed and worths. `method` must not be
/// automatic. Throws std::logic_error for a method of pagmo in builds without it.
void search(DesignMethod method, const SearchSpace& space, std::uint64_t seed, const Judge& judge);

/// Whether CMA-ES and NSGA-II are available; they are pagmo2's.
bool optimisers_built_in();
/// "pagmo 2.18.0", "none".
const char* optimisers_version();

namespace search_methods {
/// The two of pagmo (pagmo_search.cpp, or no_search.cpp without it). `first`: points that they begin with.
void cmaes(const SearchSpace& space, std::uint64_t seed, const Judge& judge);
void nsga2(const SearchSpace& space, std::uint64_t seed, const Judge& judge);
/// `count` points of a Latin hypercube: each coordinate has one in each of `count` equal parts.
std::vector<SearchPoint> latin_hypercube(std::size_t dimensions, std::size_t count, RandomStream& draws);
}  // namespace search_methods

}  // namespace equipoise
