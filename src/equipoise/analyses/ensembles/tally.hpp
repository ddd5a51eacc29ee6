// Counts outcomes in index order and computes their shares, for each sampling method; chooses the method that reaches
// a half-width with the fewest starts.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/core/statistics/escape_rate.hpp"
#include "equipoise/core/statistics/share.hpp"
#include "equipoise/results/commands/basin_result.hpp"
#include "equipoise/results/types/outcome.hpp"
#include "equipoise/study/sampling/sampling.hpp"
#include "equipoise/study/sampling/scrambled_sobol.hpp"

namespace equipoise {

/// Takes outcomes by index, from start 0 on.
class Tally {
 public:
  /// `settled`: study time at which the last piece of the drive begins. Decision times count from there.
  Tally(const Sampler& sampler, std::uint64_t seed, double settled);

  void add(const Outcome& outcome);

  std::uint64_t total() const { return total_; }
  /// The 95 % interval that suits the sampling method, with bounds that hold whatever the undecided starts come to.
  Share share(OutcomeKind kind, int attractor = 0) const;
  OutcomeShare share(const Attractor& attractor) const;
  /// Fills in every share of `result`, whose study must be that of the starts.
  void count(const Catalogue& catalogue, BasinResult& result) const;
  /// The shares of every outcome met, and of one not met.
  std::vector<Share> shares() const;

  /// How starts leave the chaos that some are still in at the horizon: from those decided after lasting_chaos. Starts
  /// that ended in a chaotic motion have not left it. Empty if no start is in it.
  std::optional<EscapeRate> chaos(const Catalogue& catalogue) const;

  /// Whether sampling may end here if a half-width is reached. The number of starts is part of the result, so this
  /// depends on the starts counted alone.
  bool at_checkpoint() const;
  bool narrow(double half_width) const;

 private:
  // A grid's pairs of starts whose outcomes differ.
  struct Split {
    std::uint64_t count = 0;
    double squared = 0.0;  // sum of weights squared

    void add(double weight) {
      ++count;
      squared += weight * weight;
    }
  };
  struct Line {
    std::uint64_t count = 0;
    double counted = 0.0, time = 0.0;   // weighted
    std::uint64_t late = 0;             // decided after lasting_chaos
    double late_time = 0.0;             // since then
    std::map<float, double> unbalance;  // residual unbalance and weight
    std::array<std::uint64_t, decided_by_count> by{};
    std::array<std::uint64_t, sobol_replicates> in_replicate{};  // for Sobol points
    Split split, from_undecided;                                 // for a grid: from any outcome; from undecided
  };
  using Key = std::pair<int, int>;
  static Key key_of(OutcomeKind kind, int attractor);
  void add_to_pair(Key key, Line& line, double weight);
  Share interval(const Line& line) const;
  Share share(Key key) const;
  static Line united(const Line& line, const Line& undecided);

  Sampler sampler_;
  std::uint64_t seed_;
  double settled_;
  std::map<Key, Line> lines_;
  std::uint64_t total_ = 0;
  Key before_{};  // of the pair's first start
  double weight_ = 0.0, weight_squared_ = 0.0;
};

/// Starts of the pilot: 16 replicates of 1024 scrambled Sobol points.
inline constexpr std::uint64_t pilot_starts = 16384;

/// Random starts after which every share's interval is within +- half_width, whatever the shares are.
double most_random_starts(double half_width);
/// The same for these shares.
double random_starts_for(const std::vector<Share>& shares, double half_width);

/// Chooses from a pilot's shares: every outcome met, and one not met. Sobol intervals are assumed to shrink only as 1 /
/// sqrt(N), as random ones do, so the choice errs towards random. The pilot counts as part of a Sobol sample.
SamplingChoice choose_sampling(const std::vector<Share>& pilot, double half_width);

}  // namespace equipoise
