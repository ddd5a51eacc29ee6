// Order statistics, exact or from bins.
#include "equipoise/core/statistics/quantile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "equipoise/core/statistics/distributions.hpp"

namespace equipoise {

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
// Bins without width: for zero, and for figures without an end.
constexpr int zero_bin = std::numeric_limits<int>::min(), open_bin = std::numeric_limits<int>::max();

double middle_of(int bin) {
  if (bin == zero_bin) return 0.0;
  if (bin == open_bin) return infinity;
  return std::exp2((static_cast<double>(bin) + 0.5) / Distribution::bins_per_octave);
}
}  // namespace

RankInterval quantile_ranks(std::uint64_t count, double probability, double confidence) {
  if (count == 0) return {0, 1};
  const double tail = 0.5 * (1.0 - confidence);
  const Binomial law{static_cast<double>(count), probability};
  // The largest l with P(K < l) <= tail, by bisection: true for `from`, false for `to`.
  std::uint64_t from = 0, to = count + 1;
  while (to - from > 1) {
    const std::uint64_t l = from + (to - from) / 2;
    (law.up_to(l - 1) <= tail ? from : to) = l;
  }
  RankInterval result;
  result.low = from;
  // The smallest u with P(K >= u) <= tail: false for `from`, true for `to`.
  from = 0;
  to = count + 1;
  while (to - from > 1) {
    const std::uint64_t u = from + (to - from) / 2;
    (law.above(u - 1) <= tail ? to : from) = u;
  }
  result.high = to;
  return result;
}

int Distribution::bin_of(float value) {
  if (!(value > 0.0f)) return zero_bin;
  if (std::isinf(value)) return open_bin;
  return static_cast<int>(std::floor(bins_per_octave * std::log2(static_cast<double>(value))));
}

void Distribution::add(float value, double weight) {
  ++count_;
  weight_ += weight;
  weight_squared_ += weight * weight;
  largest_ = std::max(largest_, static_cast<double>(value));
  if (std::isinf(value)) {
    ++open_;
  } else {
    finite_weight_ += weight;
    finite_weight_squared_ += weight * weight;
    const double change = value - mean_;
    mean_ += change * weight / finite_weight_;
    squares_ += weight * change * (value - mean_);
  }
  if (!binned_ && values_.size() == exact_) into_bins();
  if (binned_) {
    bins_[bin_of(value)] += weight;
    return;
  }
  if (weight != 1.0 && !weighted_) {
    weighted_ = true;
    weights_.assign(values_.size(), 1.0f);
  }
  values_.push_back(value);
  if (weighted_) weights_.push_back(static_cast<float>(weight));
}

void Distribution::into_bins() {
  for (std::size_t i = 0; i < values_.size(); ++i) bins_[bin_of(values_[i])] += weighted_ ? weights_[i] : 1.0;
  binned_ = true;
  values_ = {};
  weights_ = {};
}

void Distribution::merge(const Distribution& other) {
  const double finite = finite_weight_ + other.finite_weight_, apart = other.mean_ - mean_;
  if (other.finite_weight_ > 0.0) {
    squares_ += other.squares_ + apart * apart * finite_weight_ * other.finite_weight_ / finite;
    mean_ += apart * other.finite_weight_ / finite;
  }
  finite_weight_ = finite;
  finite_weight_squared_ += other.finite_weight_squared_;
  count_ += other.count_;
  open_ += other.open_;
  weight_ += other.weight_;
  weight_squared_ += other.weight_squared_;
  largest_ = std::max(largest_, other.largest_);
  if (!binned_ && (other.binned_ || values_.size() + other.values_.size() > exact_)) into_bins();
  if (binned_) {
    for (const auto& [bin, weight] : other.bins_) bins_[bin] += weight;
    for (std::size_t i = 0; i < other.values_.size(); ++i)
      bins_[bin_of(other.values_[i])] += other.weighted_ ? other.weights_[i] : 1.0;
    return;
  }
  if (weighted_ || other.weighted_) {
    if (!weighted_) weights_.assign(values_.size(), 1.0f);
    weighted_ = true;
    if (other.weighted_)
      weights_.insert(weights_.end(), other.weights_.begin(), other.weights_.end());
    else
      weights_.insert(weights_.end(), other.values_.size(), 1.0f);
  }
  values_.insert(values_.end(), other.values_.begin(), other.values_.end());
}

std::vector<Distribution::Weighed> Distribution::in_order() const {
  std::vector<Weighed> sorted;
  for (const auto& [bin, weight] : bins_) sorted.push_back({middle_of(bin), weight});
  for (std::size_t i = 0; i < values_.size(); ++i) sorted.push_back({values_[i], weighted_ ? weights_[i] : 1.0});
  std::sort(sorted.begin(), sorted.end(), [](const Weighed& a, const Weighed& b) { return a.value < b.value; });
  return sorted;
}

SampleSummary Distribution::summary(double confidence) const {
  SampleSummary result;
  result.count = count_;
  result.open = open_;
  result.largest = largest_;
  result.exact = !binned_;
  if (count_ == 0) return result;
  result.mean = result.mean_low = result.mean_high = mean_;
  const double finite = finite_weight_ > 0.0 ? finite_weight_ * finite_weight_ / finite_weight_squared_ : 0.0;
  if (finite > 1.0) {
    const double error = std::sqrt(squares_ / finite_weight_ / (finite - 1.0));
    const double half = error * students_t_half_width(finite - 1.0, confidence);
    result.mean_low = std::max(0.0, mean_ - half);
    result.mean_high = mean_ + half;
  } else {  // one start does not show how others differ
    result.mean_low = 0.0;
    result.mean_high = infinity;
  }
  const std::vector<Weighed> sorted = in_order();
  const double effective = std::floor(weight_ * weight_ / weight_squared_ * (1.0 + 1e-12));
  const auto value_at = [&](double share) {
    const double wanted = share * weight_ * (1.0 - 1e-12);  // so that rounding does not select the next value
    double sum = 0.0;
    for (const Weighed& w : sorted)
      if ((sum += w.weight) >= wanted) return w.value;
    return sorted.back().value;
  };
  for (std::size_t k = 0; k < reported_quantiles.size(); ++k) {
    const double p = reported_quantiles[k];
    const RankInterval ranks = quantile_ranks(static_cast<std::uint64_t>(effective), p, confidence);
    const double low = static_cast<double>(ranks.low), high = static_cast<double>(ranks.high);
    result.quantiles[k] = {value_at(p), low == 0.0 ? 0.0 : value_at(low / effective),
                           high > effective ? infinity : value_at(high / effective)};
  }
  return result;
}

}  // namespace equipoise
