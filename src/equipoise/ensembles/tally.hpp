// Fates counted in the order of starts, and the shares they give under each way of sampling.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "equipoise/attractors/catalogue.hpp"
#include "equipoise/results/basin_result.hpp"
#include "equipoise/sampling/sampling.hpp"
#include "equipoise/sampling/scrambled_sobol.hpp"
#include "equipoise/statistics/share.hpp"
#include "equipoise/types/fate.hpp"

namespace equipoise {

/// Takes fates in by index, from start 0 on.
class Tally {
 public:
  /// `settled`: study time at which the last branch has begun, from which decision times are counted.
  Tally(const Sampler& sampler, std::uint64_t seed, double settled);

  void add(const Fate& fate);

  std::uint64_t total() const { return total_; }
  /// 95 % interval by what the method of sampling allows, and bounds that hold whatever the undecided come to.
  Share share(Outcome outcome, int attractor = 0) const;
  OutcomeShare share(const Attractor& attractor) const;
  /// All of them into `result`, whose study is that of the starts.
  void count(const Catalogue& catalogue, BasinResult& result) const;
  /// Every outcome that was met, and last one that was not.
  std::vector<Share> shares() const;

  /// Whether a half-width may be looked at now. Where sampling ends is part of the result, so this depends on the
  /// starts counted and on nothing else.
  bool at_checkpoint() const;
  bool narrow(double half_width) const;

 private:
  // Pairs of a grid's starts that differ.
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
    std::map<float, double> unbalance;  // that is left, with weights
    std::array<std::uint64_t, decided_by_count> by{};
    std::array<std::uint64_t, sobol_replicates> in_replicate{};  // for Sobol points
    Split split, from_undecided;                                 // for a grid: from any other outcome; from that one
  };
  using Key = std::pair<int, int>;
  static Key key_of(Outcome outcome, int attractor);
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

}  // namespace equipoise
