// Builds without threads: one call after another.
#include "equipoise/core/running/parallel.hpp"

namespace equipoise {

int core_count() { return 1; }

void in_parallel(int /*threads*/, std::size_t count, const std::function<void(std::size_t)>& body) {
  for (std::size_t i = 0; i < count; ++i) body(i);
}

}  // namespace equipoise
