// Counter-based random ball angles.
#include "equipoise/ensemble/starts.hpp"

#include <Random123/philox.h>

#include "equipoise/base/angles.hpp"

namespace equipoise {

void start_angles(std::uint64_t seed, std::uint64_t index, int balls, double* phi) {
  const r123::Philox4x64 generator;
  const r123::Philox4x64::key_type key = {{seed, 0}};
  for (int first = 0; first < balls; first += 4) {
    const r123::Philox4x64::ctr_type counter = {{index, static_cast<std::uint64_t>(first / 4), 0, 0}};
    const auto words = generator(counter, key);
    for (int i = first; i < balls && i < first + 4; ++i)
      phi[i] = two_pi * (static_cast<double>(words[i - first] >> 11) * 0x1p-53);
  }
}

}  // namespace equipoise
