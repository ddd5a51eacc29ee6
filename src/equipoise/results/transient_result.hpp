// What the transients of an ensemble cost.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/statistics/quantile.hpp"
#include "equipoise/statistics/share.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/types/transient_table.hpp"

namespace equipoise {

/// Limits whose exceedance is counted, in the order of TransientGroup::exceeded: peak_radial above
/// limits.displacement, peak_force above limits.force, rms_velocity above limits.velocity.
inline constexpr std::array<const char*, 3> transient_limit_names{"displacement", "force", "velocity"};

/// The starts of one outcome, or all.
struct TransientGroup {
  std::string name;  ///< "all" or the outcome's
  int id = -1;       ///< attractor; 0: undecided or stalled; -1: all
  std::uint64_t starts = 0;
  std::optional<double> mean_speed;  ///< of driven rotors: |psi'| in the end, mean over starts
  std::uint64_t lasting = 0;         ///< of these, whose motion exceeds limits.displacement for good
  std::uint64_t never = 0;           ///< whose motion exceeds limits.settled for good
  std::array<SampleSummary, transient_columns.size()> figures{};  ///< by column
  std::array<std::optional<Share>, 3> exceeded{};                 ///< of the starts of this group; none without a limit

  /// Whether column `k` has figures: none of them does where it was not asked.
  bool tells(std::size_t k) const { return starts == 0 || figures[k].count > 0; }
};

/// Starts that were lost (diverged, failed) have no figures and are in no group.
struct TransientResult {
  TransientSettings settings;
  std::uint64_t lost = 0;
  std::vector<TransientGroup> groups;  ///< all, then by outcome
};

}  // namespace equipoise
