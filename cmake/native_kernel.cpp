// Prints the best instruction set of this machine that kernels can be built for (cmake/kernels.cmake).
#include <cstdio>

#include "hwy/targets.h"

int main() {
#if HWY_ARCH_X86
  const auto here = hwy::SupportedTargets();
  std::fputs(here & HWY_AVX3 ? "AVX-512" : here & HWY_AVX2 ? "AVX2" : here & HWY_SSE4 ? "SSE4" : "scalar", stdout);
#else
  std::fputs("all", stdout);
#endif
}
