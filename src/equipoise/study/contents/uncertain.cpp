// Quantiles of distributions, and their text.
#include "equipoise/study/contents/uncertain.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/statistics/distributions.hpp"

namespace equipoise {

namespace {

// A fraction of 0 counts as half the smallest other fraction drawn; 1 is never drawn.
constexpr double least_fraction = 0x1p-54, most_probability = 1.0 - 0x1p-53;
constexpr double normal_reach = 5.0;

double weighted(double low, double high, double fraction) {
  // A weighted mean stays between the ends even where their difference rounds.
  return std::clamp((1.0 - fraction) * low + fraction * high, low, high);
}

double normal_at(const UncertainValue& v, double fraction) {
  const double mean = v.numbers[0], deviation = v.numbers[1];
  if (deviation == 0.0) return mean;
  if (!v.between) return mean + deviation * normal_quantile(std::max(fraction, least_fraction));
  const auto [low, high] = *v.between;
  // A probability is accurate in the tail where it is small.
  const bool upper = low > mean;
  const double sign = upper ? -1.0 : 1.0;
  const double from = normal_up_to(sign * (low - mean) / deviation),
               to = normal_up_to(sign * (high - mean) / deviation);
  const double probability = std::clamp((1.0 - fraction) * from + fraction * to, 1e-300, most_probability);
  return std::clamp(mean + sign * deviation * normal_quantile(probability), low, high);
}

}  // namespace

double UncertainValue::at(double fraction) const {
  switch (kind) {
    case DistributionKind::uniform:
      return weighted(numbers[0], numbers[1], fraction);
    case DistributionKind::normal:
      return normal_at(*this, fraction);
    case DistributionKind::loguniform:
      return std::clamp(std::exp(weighted(std::log(numbers[0]), std::log(numbers[1]), fraction)), numbers[0],
                        numbers[1]);
    case DistributionKind::values: {
      const double place = fraction * static_cast<double>(numbers.size());
      return numbers[std::min(static_cast<std::size_t>(place), numbers.size() - 1)];
    }
  }
  return 0.0;
}

// A middle of 180 degrees would cancel what lies at 0; at a quarter turn squares add, as in the mean over all
// directions.
double UncertainValue::taken() const {
  if (has_no_direction()) return 0.25 * turn;
  if (kind != DistributionKind::values) return at(0.5);
  std::vector<double> sorted = numbers;
  std::sort(sorted.begin(), sorted.end());
  return sorted[(sorted.size() - 1) / 2];
}

bool UncertainValue::has_no_direction() const {
  if (turn == 0.0) return false;
  constexpr int draws = 256;
  std::complex<double> sum;
  for (int k = 0; k < draws; ++k) sum += std::polar(1.0, two_pi * at((k + 0.5) / draws) / turn);
  return std::abs(sum) < 0.5 * draws;
}

std::array<double, 2> UncertainValue::ends() const {
  if (kind == DistributionKind::normal) {
    const double reach = normal_reach * numbers[1];
    return between.value_or(std::array{numbers[0] - reach, numbers[0] + reach});
  }
  const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
  return {*low, *high};
}

std::string UncertainValue::text(double number) const {
  return unit.empty() ? fmt::format("{}", number) : fmt::format("{} {}", number, unit);
}

StudyValue UncertainValue::written(double number) const {
  return unit.empty() ? StudyValue(number) : StudyValue(text(number));
}

StudyValue UncertainValue::written() const {
  StudyValue::Array entries;
  for (const double number : numbers) entries.push_back(written(number));
  StudyValue table{{distribution_names[static_cast<std::size_t>(kind)], std::move(entries)}};
  if (between) table.set("between", StudyValue::Array{written((*between)[0]), written((*between)[1])});
  return table;
}

}  // namespace equipoise
