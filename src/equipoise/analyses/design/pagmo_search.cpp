// The only file that uses pagmo2: CMA-ES (N. Hansen and A. Ostermeier, Evol. Comput. 9 (2001) 159), restarted with
// larger populations, and NSGA-II (K. Deb and others, IEEE Trans. Evol. Comput. 6 (2002) 182).
#include <algorithm>
#include <cmath>
#include <utility>

#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/batch_evaluators/member_bfe.hpp>
#include <pagmo/bfe.hpp>
#include <pagmo/config.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>

#include "equipoise/analyses/design/search.hpp"

namespace equipoise {

namespace {

// The cube as pagmo expects it: points concatenated.
struct CubeProblem {
  const SearchSpace* space = nullptr;
  const Judge* judge = nullptr;

  pagmo::vector_double fitness(const pagmo::vector_double& x) const { return (*judge)({x}).front(); }

  pagmo::vector_double batch_fitness(const pagmo::vector_double& all) const {
    std::vector<SearchPoint> points;
    for (std::size_t k = 0; k < all.size(); k += space->dimensions)
      points.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(k),
                          all.begin() + static_cast<std::ptrdiff_t>(k + space->dimensions));
    pagmo::vector_double worths;
    for (const SearchWorth& worth : (*judge)(points)) worths.insert(worths.end(), worth.begin(), worth.end());
    return worths;
  }
  bool has_batch_fitness() const { return true; }

  pagmo::vector_double::size_type get_nobj() const { return space ? space->objectives : 1; }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    const std::size_t n = space ? space->dimensions : 1;
    return {pagmo::vector_double(n, 0.0), pagmo::vector_double(n, 1.0)};
  }
};

// A population of Latin hypercube points with their worths, in order.
pagmo::population population_of(const pagmo::problem& problem, const SearchSpace& space, std::size_t size,
                                unsigned seed, RandomStream& draws, const Judge& judge) {
  const std::vector<SearchPoint> points = search_methods::latin_hypercube(space.dimensions, size, draws);
  const std::vector<SearchWorth> worths = judge(points);
  pagmo::population population(problem, 0, seed);
  for (std::size_t k = 0; k < size; ++k) population.push_back(points[k], worths[k]);
  return population;
}

unsigned seed_of(RandomStream& draws) { return static_cast<unsigned>(draws.uniform() * 0x1p31); }

}  // namespace

void search_methods::cmaes(const SearchSpace& space, std::uint64_t seed, const Judge& judge) {
  RandomStream draws(seed);
  const pagmo::problem problem{CubeProblem{&space, &judge}};
  const auto usual = static_cast<std::size_t>(4.0 + 3.0 * std::log(static_cast<double>(space.dimensions)));
  constexpr std::size_t least = 6;  // pagmo requires five
  std::size_t size = std::max(least, usual);
  for (;; size *= 2) {
    // Begins at the best of a few times as many points, with a step of a quarter of the cube.
    constexpr std::size_t first_look = 4;
    pagmo::population wide = population_of(problem, space, first_look * size, seed_of(draws), draws, judge);
    pagmo::population population(problem, 0, seed_of(draws));
    std::vector<std::size_t> order(wide.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return wide.get_f()[a] < wide.get_f()[b]; });
    for (std::size_t k = 0; k < size; ++k) population.push_back(wide.get_x()[order[k]], wide.get_f()[order[k]]);
    // It ends by itself once its points, or their worths, are alike; a share of starts has no more digits than this.
    constexpr unsigned generations = 1000;
    constexpr double sigma = 0.25, alike = 1e-5;
    pagmo::cmaes method(generations, -1, -1, -1, -1, sigma, alike, alike, false, true, seed_of(draws));
    method.evolve(population);
  }
}

void search_methods::nsga2(const SearchSpace& space, std::uint64_t seed, const Judge& judge) {
  RandomStream draws(seed);
  const pagmo::problem problem{CubeProblem{&space, &judge}};
  // At least twenty generations of a population large enough to show a front; pagmo requires multiples of four.
  const std::size_t size = std::clamp<std::size_t>(static_cast<std::size_t>(space.points) / 80 * 4, 16, 80);
  pagmo::population population = population_of(problem, space, size, seed_of(draws), draws, judge);
  const double mutation = 1.0 / static_cast<double>(space.dimensions);
  for (;;) {
    pagmo::nsga2 method(1000, 0.95, 10.0, mutation, 20.0, seed_of(draws));
    method.set_bfe(pagmo::bfe{pagmo::member_bfe{}});
    population = method.evolve(population);
  }
}

bool optimisers_built_in() { return true; }

const char* optimisers_version() { return "pagmo " PAGMO_VERSION; }

}  // namespace equipoise
