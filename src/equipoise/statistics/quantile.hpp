// The distribution of a figure over starts: mean, quantiles and their intervals, in bounded memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace equipoise {

/// Quantiles that are reported.
inline constexpr std::array<double, 3> reported_quantiles{0.5, 0.9, 0.99};

/// A quantile with its interval; with too few starts `low` is 0 or `high` infinite.
struct QuantileEstimate {
  double value = 0.0, low = 0.0, high = 0.0;
};

/// Ranks l, u, counted from 1, of `count` independent values in order, between which the quantile of `probability` lies
/// with at least `confidence`, whatever the distribution: at most count values K are at or below it, K is binomial, and
/// P(K < l) and P(K >= u) are each at most half of what `confidence` leaves (H. A. David and H. N. Nagaraja, Order
/// Statistics, 3rd ed., 2003, section 7.1). l = 0 and u = count + 1: no bound on that side.
struct RankInterval {
  std::uint64_t low = 0, high = 0;
};
RankInterval quantile_ranks(std::uint64_t count, double probability, double confidence = 0.95);

/// What a sample of figures says.
struct SampleSummary {
  std::uint64_t count = 0;                             ///< starts
  std::uint64_t open = 0;                              ///< of these, starts whose figure has no end: infinite
  double mean = 0.0, mean_low = 0.0, mean_high = 0.0;  ///< of those that are finite; Student's t
  double largest = 0.0;                                ///< infinite if any is open
  std::array<QuantileEstimate, reported_quantiles.size()> quantiles{};  ///< of all
  bool exact = true;  ///< quantiles are values of the sample; else middles of bins (Distribution::bins_per_octave)
};

/// Figures >= 0, also infinite, in single precision. Up to `exact` of them are kept; more are counted in bins.
/// Summaries depend on the figures and their order alone.
class Distribution {
 public:
  /// A bin is 2^(1/128), 0.54 %, wide: quantiles are good to 0.27 %.
  static constexpr double bins_per_octave = 128.0;

  explicit Distribution(std::size_t exact = std::size_t{1} << 18) : exact_(exact) {}

  /// `weight` > 0: what the start counts.
  void add(float value, double weight = 1.0);
  /// Takes in another one's figures.
  void merge(const Distribution& other);

  std::uint64_t count() const { return count_; }
  /// Quantile intervals are those of as many independent starts (for weights: of Kish's number of starts).
  SampleSummary summary(double confidence = 0.95) const;

 private:
  struct Weighed {
    double value, weight;
  };
  static int bin_of(float value);
  void into_bins();
  std::vector<Weighed> in_order() const;

  std::size_t exact_;
  bool binned_ = false, weighted_ = false;
  std::vector<float> values_, weights_;  // no weights while all are 1
  std::map<int, double> bins_;           // weight by bin
  std::uint64_t count_ = 0, open_ = 0;
  double weight_ = 0.0, weight_squared_ = 0.0, largest_ = 0.0;
  double finite_weight_ = 0.0, finite_weight_squared_ = 0.0, mean_ = 0.0, squares_ = 0.0;
};

}  // namespace equipoise
