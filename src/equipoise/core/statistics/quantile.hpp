// The distribution of a figure over starts: mean, quantiles and their intervals, in bounded memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "equipoise/core/statistics/share.hpp"

namespace equipoise {

/// Quantiles shown in results.
inline constexpr std::array<double, 3> reported_quantiles{0.5, 0.9, 0.99};

/// With too few starts `low` is 0 or `high` is infinite.
using QuantileEstimate = Estimate;

/// Ranks l and u, counted from 1, of `count` independent values in order. The quantile of `probability` lies between
/// them with at least `confidence`, whatever the distribution. The number K of values at or below it is at most
/// binomial, and P(K < l) and P(K >= u) are each at most half of what `confidence` leaves (H. A. David and H. N.
/// Nagaraja, Order Statistics, 3rd ed., 2003, section 7.1). l = 0 or u = count + 1: no bound on that side.
struct RankInterval {
  std::uint64_t low = 0, high = 0;
};
RankInterval quantile_ranks(std::uint64_t count, double probability, double confidence = 0.95);

/// Summary of a sample of figures.
struct SampleSummary {
  std::uint64_t count = 0;                                              ///< starts
  std::uint64_t open = 0;                                               ///< starts whose figure has no end: infinite
  double mean = 0.0, mean_low = 0.0, mean_high = 0.0;                   ///< of the finite ones; Student's t
  double largest = 0.0;                                                 ///< infinite if any is open
  std::array<QuantileEstimate, reported_quantiles.size()> quantiles{};  ///< of all starts
  bool exact = true;  ///< quantiles are values of the sample; else centres of bins (Distribution::bins_per_octave)
};

/// Figures >= 0, also infinite, in single precision. Up to `exact` are kept; more are counted in bins. A summary
/// depends only on the figures and their order.
class Distribution {
 public:
  /// A bin is 2^(1/128), or 0.54 %, wide: quantiles are good to 0.27 %.
  static constexpr double bins_per_octave = 128.0;

  explicit Distribution(std::size_t exact = std::size_t{1} << 18) : exact_(exact) {}

  /// `weight` > 0: how much the start counts.
  void add(float value, double weight = 1.0);
  /// Adds another distribution's figures.
  void merge(const Distribution& other);

  std::uint64_t count() const { return count_; }
  /// Quantile intervals are those of as many independent starts; with weights, of Kish's number of starts.
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
