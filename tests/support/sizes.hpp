// Sizes of tests: full with EQUIPOISE_TESTS=all (./dev test --all), smaller otherwise: the same code runs, less often.
#pragma once

#include <cstdlib>
#include <string_view>

namespace equipoise {

/// `full`, or `quick` in the run of minutes and under sanitizers, where kernels run at a tenth of the speed.
template <class T>
T sized(T full, T quick) {
#ifdef EQUIPOISE_SANITIZE
  return static_cast<void>(full), quick;
#else
  const char* tests = std::getenv("EQUIPOISE_TESTS");
  return tests && std::string_view(tests) == "all" ? full : quick;
#endif
}

}  // namespace equipoise
