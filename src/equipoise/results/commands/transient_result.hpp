// The transients of an ensemble.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/core/statistics/quantile.hpp"
#include "equipoise/core/statistics/share.hpp"
#include "equipoise/results/columns/transient_figures.hpp"

namespace equipoise {

/// The starts of one outcome, or all.
struct TransientGroup {
  std::string name;       ///< "all" or the outcome's
  std::optional<int> id;  ///< attractor, or a code of no_attractors; empty: all
  std::uint64_t starts = 0;
  std::optional<double> mean_speed;  ///< of driven rotors: |psi'| in the end, mean over starts
  std::uint64_t lasting = 0;         ///< of these, whose motion exceeds limits.displacement for good
  std::uint64_t never = 0;           ///< whose motion exceeds limits.settled for good
  std::array<SampleSummary, transient_figures.size()> figures{};  ///< by column
  std::array<std::optional<Share>, transient_limits.size()>
      exceeded{};  ///< of the starts in this group; empty without a limit
  std::array<std::optional<Share>, transient_limits.size()> exceeded_at_end{};  ///< by their motion at the end
  std::array<std::optional<Share>, standard_levels.size()> beyond{};  ///< starts that exceed a standard's level
  /// Starts within all limits (Within); empty where no such limit is stated.
  std::array<std::optional<Share>, within_names.size()> within{};
  /// Of all starts: the RMS velocity at the end, with bounds that hold however the undecided starts end.
  std::array<QuantileEstimate, reported_quantiles.size()> sure_end_velocity{};

  /// Starts within all limits stated: on the way and at the end, or in one of the two where no limit is on the other.
  const std::optional<Share>& kept() const {
    for (const Within w : {Within::both, Within::at_end})
      if (const auto& share = within[static_cast<std::size_t>(w)]) return share;
    return within[static_cast<std::size_t>(Within::on_the_way)];
  }
  /// For a figure that may have no end: starts that lack one for good.
  std::uint64_t for_good(const TransientFigure& f) const { return f.needs == &Limits::settled ? never : lasting; }
  const SampleSummary& figure(float TransientRow::*value) const { return figures[figure_place(value)]; }
  /// Whether column `k` has figures; it has none if it was not requested.
  bool tells(std::size_t k) const { return starts == 0 || figures[k].count > 0; }
};

/// What a start is compared by with the same start of another ensemble; not-a-number of one that was lost.
struct PairedStart {
  bool undecided = false;
  double weight = 1.0;
  float peak_radial = 0.0f, rms_velocity = 0.0f;
};
/// Starts that are compared in pairs: enough for a quantile to a few per cent of its spread.
inline constexpr std::uint64_t most_paired_starts = 256;

/// Starts that were lost (diverged, failed) have no figures and are in no group.
struct TransientResult {
  TransientSettings settings;
  std::uint64_t lost = 0;
  std::vector<TransientGroup> groups;  ///< all, then by outcome
  std::vector<PairedStart> first{};    ///< the first starts, by index

  /// The figures of the starts with an outcome, or of all without one; null if there are no such starts.
  const TransientGroup* of(std::optional<int> outcome) const {
    for (const TransientGroup& group : groups)
      if (group.id == outcome && group.starts > 0) return &group;
    return nullptr;
  }
  bool asks(const TransientFigure& f, const Limits& limits) const {
    return f.value == &TransientRow::energy ? settings.work != WorkSource::none : !f.needs || limits.*f.needs;
  }
};

// What an ensemble's rotor does without its balls, and with balls that stay where they start.

/// One body's runs over the same drive, by the figures of the ensemble's transients.
struct OneBodyRuns {
  TransientGroup figures;     ///< of all runs that were not lost; without the drive's work
  bool one = false;           ///< all starts have the same: a single run, whose intervals say nothing
  std::uint64_t runs = 0;     ///< followed
  std::uint64_t stalled = 0;  ///< driven rotors that their motor does not bring up to speed
  std::uint64_t open = 0;     ///< without a steady motion while followed; their figures at the end are the last seen
  std::uint64_t lost = 0;     ///< that diverged or failed
  std::vector<PairedStart> first{};  ///< runs that have the rotors of the ensemble's first starts
};

/// Displacements of each count from its own place of rest. Depends on the study and on how many starts there are.
struct WithoutBalls {
  OneBodyRuns bare;  ///< no balls
  OneBodyRuns held;  ///< balls held where they start: the first starts
};
/// Starts whose balls are held.
inline constexpr std::uint64_t most_held_starts = most_paired_starts;

}  // namespace equipoise
