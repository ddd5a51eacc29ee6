// Where the starts of an ensemble end: one line per attractor or other outcome, the same in all results.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/core/statistics/share.hpp"
#include "equipoise/results/columns/column.hpp"
#include "equipoise/results/types/outcome.hpp"

namespace equipoise {

/// The meaning of `alias` in files.
inline constexpr char name_by_wright_and_peng[] = "name that Wright and Peng (2019) give it";

/// Starts that ended in one attractor, or to one outcome without attractor.
struct OutcomeShare {
  int id = 0;                   ///< the attractor's identifier, or a code of no_attractors
  std::string name{}, alias{};  ///< alias: V1 to V4 of Wright and Peng (2019)
  Share share{};                ///< with its 95 % interval
  std::string kind{};           ///< of the attractor's motion
  double mean_time = 0.0;       ///< mean time from the start of the last piece (and release) to decision
  std::array<std::uint64_t, decided_by_count> decided_by{};  ///< starts by the grounds of decision
  /// For a continuum caused by dry friction: quantiles (unbalance_quantiles) of the unbalance left, over the starts
  /// that come there; else empty.
  std::vector<double> unbalance{};
  std::vector<double> grade{};  ///< in a study with physical units: their balance quality grades, mm/s
};
inline constexpr std::array<double, 4> unbalance_quantiles{0.1, 0.5, 0.9, 1.0};

/// The numbers of a share in files: one line each, for ensembles and for cells of sweeps.
struct ShareColumn {
  const char* name;  ///< a sweep's variable; an ensemble's has "kind_" before it
  double Share::*value;
  const char* of_ensemble;  ///< long_name
  const char* of_cell;
};
inline constexpr std::array<ShareColumn, 5> share_columns{{
    {"share", &Share::share, "share of the starts with the outcome", "share of the starts"},
    {"share_low", &Share::low, "lower end of the 95 % interval of the share", "lower end of its 95 % interval"},
    {"share_high", &Share::high, "upper end of the 95 % interval of the share", "upper end of its 95 % interval"},
    {"share_least", &Share::least, "lower bound of the share whatever undecided starts would come to",
     "lower bound whatever undecided starts come to"},
    {"share_most", &Share::most, "upper bound of the share whatever undecided starts would come to",
     "upper bound whatever undecided starts come to"},
}};

/// A number of every attractor in an ensemble, in addition to its share. A line here reaches the table of outcomes, on
/// terminals and pages, JSON, files and Python.
struct OutcomeNumber : Column {
  const char* title;                     ///< of its column in the table
  double (*value)(const OutcomeShare&);  ///< for an attractor in which some start ended
  bool in_files = true;                  ///< false: follows from what the file says of each start
};
inline constexpr auto outcome_numbers = std::to_array<OutcomeNumber>({
    {{"mean_time", "mean time to the decision", study::Dimension::time},
     "known after",
     [](const OutcomeShare& o) { return o.mean_time; },
     false},
});

/// "co-drifting (V1)".
template <class Named>
std::string title_of(const Named& o) {
  return o.alias.empty() ? o.name : o.name + " (" + o.alias + ")";
}
/// "V1: co-drifting".
template <class Named>
std::string legend_of(const Named& o) {
  return o.alias.empty() ? o.name : o.alias + ": " + o.name;
}

/// Shares of the starts that ended in no attractor.
struct OtherShares {
  Share undecided, diverged, failed;
  std::optional<Share> stalled;  ///< of a driven rotor: its motor did not bring it to stall_speed()

  std::uint64_t lost() const { return diverged.count + failed.count; }
  /// Null for impossible outcomes: only driven rotors stall.
  const Share* of(int code) const {
    return code == undecided_code  ? &undecided
           : code == diverged_code ? &diverged
           : code == failed_code   ? &failed
                                   : (stalled ? &*stalled : nullptr);
  }
  /// In display order: starts that stalled come to something, so they come first.
  std::vector<OutcomeShare> others() const {
    std::vector<OutcomeShare> lines;
    for (const NoAttractor& n : no_attractors)
      if (const Share* share = of(n.code))
        lines.insert(n.code == stalled_code ? lines.begin() : lines.end(), {n.code, n.name, "", *share});
    return lines;
  }
  /// Those that some start came to; for a driven rotor always including stalled.
  std::vector<OutcomeShare> others_met() const {
    std::vector<OutcomeShare> lines = others();
    std::erase_if(lines, [](const OutcomeShare& o) { return o.share.count == 0 && o.id != stalled_code; });
    return lines;
  }
};

}  // namespace equipoise
