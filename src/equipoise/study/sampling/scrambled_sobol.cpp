// Sobol points from direction numbers, with nested uniform scrambling by a counter-based generator.
#include "equipoise/study/sampling/scrambled_sobol.hpp"

#include <array>

#include <boost/random/sobol.hpp>

#include "equipoise/core/base/random.hpp"
#include "equipoise/study/sampling/starts.hpp"

namespace equipoise {

namespace {

constexpr int index_bits = 48;
using Directions = std::array<std::array<std::uint64_t, index_bits>, most_sobol_dimensions>;

// Boost's engine follows the Gray code, without point 0: its output 2^(j+1) - 2 has the code 2^j and is direction j.
Directions direction_numbers() {
  Directions result;
  boost::random::sobol engine(most_sobol_dimensions);
  for (int j = 0; j < index_bits; ++j) {
    engine.seed((std::uint64_t{2} << j) - 2);
    for (auto& dimension : result) dimension[static_cast<std::size_t>(j)] = engine();
  }
  return result;
}

std::uint64_t sobol_point(std::uint64_t number, int dimension) {
  static const Directions directions = direction_numbers();
  std::uint64_t point = 0;
  for (std::size_t j = 0; number != 0; ++j, number >>= 1)
    if (number & 1) point ^= directions[static_cast<std::size_t>(dimension)][j];
  return point;
}

// Scrambles eight bits at a time. Their random bits form a tree of 255 nodes, numbered as a heap, which one call of the
// generator provides. The result uses 53 bits.
std::uint64_t scrambled(std::uint64_t seed, std::uint64_t replicate, int dimension, std::uint64_t point) {
  const std::uint64_t tree = replicate << 32 | static_cast<std::uint64_t>(dimension);
  std::uint64_t flips = 0;
  for (int level = 0; level < 56; level += 8) {
    const std::uint64_t before = level == 0 ? 0 : point >> (64 - level);
    const RandomWords words = random_words({seed, 0}, {before, static_cast<std::uint64_t>(level),
                                                       static_cast<std::uint64_t>(StartNumbers::scrambling), tree});
    const std::uint64_t byte = point >> (56 - level) & 0xff;
    for (int depth = 0; depth < 8; ++depth) {
      const std::uint64_t node = std::uint64_t{1} << depth | byte >> (8 - depth);
      flips |= (words[node / 64] >> node % 64 & 1) << (63 - level - depth);
    }
  }
  return point ^ flips;
}

}  // namespace

void sobol_fractions(std::uint64_t seed, std::uint64_t index, int first, int count, double* fractions) {
  const std::uint64_t replicate = index % sobol_replicates, number = index / sobol_replicates;
  for (int k = 0; k < count; ++k) {
    const int dimension = first + k;
    fractions[k] = fraction(scrambled(seed, replicate, dimension, sobol_point(number, dimension)));
  }
}

}  // namespace equipoise
