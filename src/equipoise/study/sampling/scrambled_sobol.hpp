// Scrambled Sobol points addressed by (seed, index): sixteen independent replicates of one low-discrepancy sequence.
#pragma once

#include <cstdint>

namespace equipoise {

/// Number of independent scramblings. Start i is point i / 16 of replicate i mod 16, so that the first starts are
/// always spread evenly. With errors like n^-3/4, R replicates give an interval as wide as t(R - 1) R^(1/4). That is
/// least for R = 8 and 7 % more for 16, whose standard error is known better (to 18 % instead of 27 %).
inline constexpr int sobol_replicates = 16;

/// Coordinates of a point. Ball angles come first, since the sequence is most even in its first coordinates.
inline constexpr int most_sobol_dimensions = 36;

/// Writes coordinates first .. first + count - 1 of start `index`, each uniform on [0, 1). Sobol's sequence with the
/// direction numbers of Joe and Kuo (SIAM J. Sci. Comput. 30 (2008) 2635, from Boost.Random) under nested uniform
/// scrambling (A. B. Owen, in: Monte Carlo and Quasi-Monte Carlo Methods (1995) 299). Each bit is flipped by a random
/// bit that Philox draws from (seed, replicate, coordinate, preceding bits). index < 2^52.
void sobol_fractions(std::uint64_t seed, std::uint64_t index, int first, int count, double* fractions);

}  // namespace equipoise
