// One ensemble with every start's outcome kept, and comparisons of two ensembles.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/core/running/run_info.hpp"

namespace equipoise::audit {

struct Ensemble {
  BasinResult result;
  Catalogue catalogue;
  std::vector<Outcome> outcomes;
  bool own_rotors = false;  ///< each start draws its own

  /// What became of start i: the attractor's name, "undecided", "stalled", "diverged", "failed".
  std::string name(std::size_t i) const;
  /// The same without what distinguishes motions of one kind: number, period, quasi-periodic, chaotic.
  std::string kind(std::size_t i) const;
  bool decided(std::size_t i) const;
  /// Starts by kind().
  std::map<std::string, std::uint64_t> kinds() const;
  /// Times of decided starts since the last piece began and the balls were free, ascending.
  std::vector<double> decision_times(const Study& study) const;
};

/// Starts 0 .. starts - 1 of `study`.
Ensemble run_ensemble(Study study, std::uint64_t starts, const BasinOptions& options);

/// "co-drifting" for "co-drifting, quasi-periodic (2)".
std::string kind_of_name(const std::string& name);

/// Pairs of the same start in two runs, where both are decided.
struct Pairs {
  std::size_t compared = 0, differ = 0, first_difference = 0;
};
Pairs compare_pairs(const Ensemble& a, const Ensemble& b, bool undecided_too);

/// The smallest probability, over all kinds, of shares that differ this much if both samples are independent and of one
/// law; and the kind.
struct SharesApart {
  double probability = 1.0;
  std::string kind;
  double first = 0.0, second = 0.0;
};
SharesApart compare_shares(const Ensemble& a, const Ensemble& b);

}  // namespace equipoise::audit
