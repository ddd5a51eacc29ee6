// Random numbers that are the same on every platform; those of the standard library's distributions are not.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace equipoise {

using RandomWords = std::array<std::uint64_t, 4>;

/// Philox 4x64-10 (Salmon and others, "Parallel random numbers: as easy as 1, 2, 3", SC 2011): words of a counter and
/// key.
RandomWords random_words(const std::array<std::uint64_t, 2>& key, const RandomWords& counter);

/// The upper 53 bits of a word as a number in [0, 1).
constexpr double fraction(std::uint64_t word) { return static_cast<double>(word >> 11) * 0x1p-53; }

/// The same number for the same text on every machine, others for the few others that a study or a run has (FNV-1a, G.
/// Fowler, L. C. Noll, K.-P. Vo).
constexpr std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

/// A stream for searches that do not know in advance how many numbers they draw. It shares no counter with any start.
class RandomStream {
 public:
  /// The default is fixed, so that the same study gets the same trapping regions.
  explicit RandomStream(std::uint64_t seed = 20190614) : seed_(seed) {}

  double uniform();  ///< on [0, 1)
  double normal();   ///< mean 0, variance 1, from two uniform numbers (Box and Muller)

 private:
  std::uint64_t seed_, blocks_ = 0;
  RandomWords words_{};
  std::size_t used_ = 4;  // of words_
};

}  // namespace equipoise
