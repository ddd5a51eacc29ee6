// Counter-based random ball angles.
#include "equipoise/sampling/starts.hpp"

#include <Random123/philox.h>

#include "equipoise/base/angles.hpp"
#include "equipoise/sampling/start_numbers.hpp"

namespace equipoise {

namespace {

void fractions_of(std::uint64_t seed, std::uint64_t index, StartNumbers group, int count, double* fractions) {
  const r123::Philox4x64 generator;
  const r123::Philox4x64::key_type key = {{seed, 0}};
  for (int first = 0; first < count; first += 4) {
    const r123::Philox4x64::ctr_type counter = {
        {index, static_cast<std::uint64_t>(first / 4), static_cast<std::uint64_t>(group), 0}};
    const auto words = generator(counter, key);
    for (int i = first; i < count && i < first + 4; ++i)
      fractions[i] = static_cast<double>(words[i - first] >> 11) * 0x1p-53;
  }
}

}  // namespace

void start_angles(std::uint64_t seed, std::uint64_t index, int balls, double* phi) {
  fractions_of(seed, index, StartNumbers::angles, balls, phi);
  for (int i = 0; i < balls; ++i) phi[i] *= two_pi;
}

void start_fractions(std::uint64_t seed, std::uint64_t index, int count, double* fractions) {
  fractions_of(seed, index, StartNumbers::others, count, fractions);
}

}  // namespace equipoise
