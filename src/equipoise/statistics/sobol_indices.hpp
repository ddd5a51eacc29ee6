// Which of several independent inputs an outcome depends on: Sobol's indices from a pick-freeze design.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace equipoise {

/// Outcomes in rows of `inputs` + 2: of one draw of all inputs, a; of another, b; and of a with one input after the
/// other taken from b.
struct PickFreezeRows {
  std::size_t inputs = 0;
  std::vector<double> outcomes;

  std::size_t rows() const { return outcomes.size() / (inputs + 2); }
  double a(std::size_t row) const { return outcomes[row * (inputs + 2)]; }
  double b(std::size_t row) const { return outcomes[row * (inputs + 2) + 1]; }
  double mixed(std::size_t row, std::size_t input) const { return outcomes[row * (inputs + 2) + 2 + input]; }
};

/// An estimate with its 95 % interval.
struct IndexEstimate {
  double value = 0.0, low = 0.0, high = 0.0;
};

/// The part of the outcome's variance that goes away on average if one input is known, and the part left if all others
/// are.
struct SobolIndices {
  IndexEstimate first, total;
};

/// First order by A. Janon, T. Klein, A. Lagnoux, M. Nodet and C. Prieur (ESAIM: Prob. Stat. 18 (2014) 342), total by
/// M. J. W. Jansen (Comput. Phys. Commun. 117 (1999) 35). Intervals: quantiles over bootstrap samples of the rows,
/// drawn by `seed`. Empty where the outcome does not vary. An index near 0 may come out below it.
std::vector<SobolIndices> sobol_indices(const PickFreezeRows& rows, std::uint64_t seed = 1);

}  // namespace equipoise
