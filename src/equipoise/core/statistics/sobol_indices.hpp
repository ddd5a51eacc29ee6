// How much an outcome depends on each of several independent inputs: Sobol's indices from a pick-freeze design.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "equipoise/core/statistics/share.hpp"

namespace equipoise {

/// Outcomes in rows of `inputs` + 2: for a draw a of all inputs, a draw b, and a with one input at a time from b.
struct PickFreezeRows {
  std::size_t inputs = 0;
  std::vector<double> outcomes;

  std::size_t rows() const { return outcomes.size() / (inputs + 2); }
  double a(std::size_t row) const { return outcomes[row * (inputs + 2)]; }
  double b(std::size_t row) const { return outcomes[row * (inputs + 2) + 1]; }
  double mixed(std::size_t row, std::size_t input) const { return outcomes[row * (inputs + 2) + 2 + input]; }
};

/// first: the part of the outcome's variance that knowing one input removes on average. total: the part that is left
/// when all others are known.
struct SobolIndices {
  Estimate first, total;
};

/// First order by A. Janon, T. Klein, A. Lagnoux, M. Nodet and C. Prieur (ESAIM: Prob. Stat. 18 (2014) 342), with the
/// covariance of a and b, which is 0 but for chance, as a control variate; total by M. J. W. Jansen (Comput. Phys.
/// Commun. 117 (1999) 35). Intervals are quantiles over bootstrap samples of the rows,
/// drawn with `seed`. Empty if the outcome does not vary. An index near 0 may come out negative.
std::vector<SobolIndices> sobol_indices(const PickFreezeRows& rows, std::uint64_t seed = 1);

}  // namespace equipoise
