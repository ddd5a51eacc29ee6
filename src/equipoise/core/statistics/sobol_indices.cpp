// Sobol indices from sums over rows, with bootstrap intervals.
#include "equipoise/core/statistics/sobol_indices.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/core/base/random.hpp"

namespace equipoise {

namespace {

// The ends of a 95 % interval are then the 25th and the 975th sample, give or take five.
constexpr std::size_t bootstrap_samples = 1000;

struct Sums {
  double weight = 0.0, all = 0.0, all_squared = 0.0, both = 0.0;  // of a and b; both: products of the two
  // By input. sum, squares, products: of b and the mixed row (that input from b). differences: a and the mixed row.
  std::vector<double> sum, squares, products, differences;

  explicit Sums(std::size_t inputs) : sum(inputs), squares(inputs), products(inputs), differences(inputs) {}

  void add(const PickFreezeRows& rows, std::size_t row, double times) {
    const double a = rows.a(row), b = rows.b(row);
    weight += times;
    all += times * (a + b);
    all_squared += times * (a * a + b * b);
    both += times * a * b;
    for (std::size_t k = 0; k < rows.inputs; ++k) {
      const double mixed = rows.mixed(row, k);
      sum[k] += times * (b + mixed);
      squares[k] += times * (b * b + mixed * mixed);
      products[k] += times * b * mixed;
      differences[k] += times * (a - mixed) * (a - mixed);
    }
  }

  double variance() const {
    const double mean = 0.5 * all / weight;
    return 0.5 * all_squared / weight - mean * mean;
  }
  double first(std::size_t k) const {
    const double mean = 0.5 * sum[k] / weight, own = 0.5 * squares[k] / weight - mean * mean;
    return own > 0.0 ? (products[k] / weight - mean * mean - chance(k)) / own : 0.0;
  }
  // a and b are independent: their covariance is 0 but for chance, which the mixed row shares as far as it is like a.
  double chance(std::size_t k) const {
    const double mean = 0.5 * all / weight;
    return std::clamp(1.0 - total(k), 0.0, 1.0) * (both / weight - mean * mean);
  }
  double total(std::size_t k) const { return 0.5 * differences[k] / weight / variance(); }
};

void set_interval(Estimate& estimate, std::vector<double>& samples) {
  const auto nth = [&](double part) {
    const auto at = samples.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(samples.size() - 1));
    std::nth_element(samples.begin(), at, samples.end());
    return *at;
  };
  estimate.low = std::min(estimate.value, nth(0.025));
  estimate.high = std::max(estimate.value, nth(0.975));
}

}  // namespace

std::vector<SobolIndices> sobol_indices(const PickFreezeRows& rows, std::uint64_t seed) {
  const std::size_t count = rows.rows();
  Sums sums(rows.inputs);
  for (std::size_t row = 0; row < count; ++row) sums.add(rows, row, 1.0);
  // Equal outcomes leave a variance of rounding errors.
  const double rounding = 1e-14 * sums.all_squared / std::max(sums.weight, 1.0);
  if (count == 0 || !(sums.variance() > rounding)) return {};
  std::vector<SobolIndices> indices(rows.inputs);
  for (std::size_t k = 0; k < rows.inputs; ++k) {
    indices[k].first.value = sums.first(k);
    indices[k].total.value = sums.total(k);
  }
  RandomStream random(seed);
  std::vector<std::vector<double>> first(rows.inputs), total(rows.inputs);
  std::vector<double> times(count);
  for (std::size_t sample = 0; sample < bootstrap_samples; ++sample) {
    std::fill(times.begin(), times.end(), 0.0);
    for (std::size_t i = 0; i < count; ++i)
      ++times[std::min(static_cast<std::size_t>(random.uniform() * static_cast<double>(count)), count - 1)];
    Sums again(rows.inputs);
    for (std::size_t row = 0; row < count; ++row)
      if (times[row] > 0.0) again.add(rows, row, times[row]);
    if (!(again.variance() > rounding)) continue;
    for (std::size_t k = 0; k < rows.inputs; ++k) {
      first[k].push_back(again.first(k));
      total[k].push_back(again.total(k));
    }
  }
  for (std::size_t k = 0; k < rows.inputs; ++k) {
    if (first[k].empty()) continue;
    set_interval(indices[k].first, first[k]);
    set_interval(indices[k].total, total[k]);
  }
  return indices;
}

}  // namespace equipoise
