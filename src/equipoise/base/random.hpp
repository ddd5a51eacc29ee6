// Random numbers that are the same everywhere: the distributions of the standard library differ between libraries.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace equipoise {

using RandomWords = std::array<std::uint64_t, 4>;

/// Philox 4x64-10 (Salmon and others, "Parallel random numbers: as easy as 1, 2, 3", SC 2011): the words of a counter
/// under a key.
RandomWords random_words(const std::array<std::uint64_t, 2>& key, const RandomWords& counter);

/// The upper 53 bits of a word as a number on [0, 1).
constexpr double fraction(std::uint64_t word) { return static_cast<double>(word >> 11) * 0x1p-53; }

/// A stream for searches whose number of draws is not known before. It shares no counter with the starts of any seed.
class RandomStream {
 public:
  /// A fixed default, so that the same study has the same trapping regions.
  explicit RandomStream(std::uint64_t seed = 20190614) : seed_(seed) {}

  double uniform();  ///< on [0, 1)
  double normal();   ///< of mean 0 and variance 1; two uniform ones each (Box and Muller)

 private:
  std::uint64_t seed_, blocks_ = 0;
  RandomWords words_{};
  std::size_t used_ = 4;  // of words_
};

}  // namespace equipoise
