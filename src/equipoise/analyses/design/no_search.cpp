// Stands in for pagmo2's optimisers in builds without it.
#include <stdexcept>

#include "equipoise/analyses/design/search.hpp"

namespace equipoise {

void search_methods::cmaes(const SearchSpace&, std::uint64_t, const Judge&) {
  throw std::logic_error("built without pagmo2");
}

void search_methods::nsga2(const SearchSpace&, std::uint64_t, const Judge&) {
  throw std::logic_error("built without pagmo2");
}

bool optimisers_built_in() { return false; }

const char* optimisers_version() { return "none"; }

}  // namespace equipoise
