// Counter-based random ball angles.
#include "equipoise/study/sampling/starts.hpp"

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/random.hpp"

namespace equipoise {

namespace {

void fractions_of(std::uint64_t seed, std::uint64_t index, StartNumbers group, int count, double* fractions) {
  for (int first = 0; first < count; first += 4) {
    const RandomWords words =
        random_words({seed, 0}, {index, static_cast<std::uint64_t>(first / 4), static_cast<std::uint64_t>(group), 0});
    for (int i = first; i < count && i < first + 4; ++i) fractions[i] = fraction(words[i - first]);
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

double start_fraction(std::uint64_t seed, std::uint64_t index, std::string_view name) {
  const auto group = static_cast<std::uint64_t>(StartNumbers::parameters);
  return fraction(random_words({seed, 0}, {index, hash_of(name), group, 0})[0]);
}

}  // namespace equipoise
