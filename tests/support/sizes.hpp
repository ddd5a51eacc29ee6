// Sizes of tests: full with EQUIPOISE_TESTS=all (./dev test --all, ctest --preset long), smaller otherwise.
#pragma once

#include <cstdlib>
#include <string_view>

namespace equipoise {

/// `full`, or `quick` in a run of minutes and under sanitizers, where kernels run at a tenth of the speed. The same code
/// runs, with fewer repetitions.
template <class T>
T sized([[maybe_unused]] T full, T quick) {
#ifdef EQUIPOISE_SANITIZE
  return quick;
#else
  const char* tests = std::getenv("EQUIPOISE_TESTS");
  return tests && std::string_view(tests) == "all" ? full : quick;
#endif
}

}  // namespace equipoise
