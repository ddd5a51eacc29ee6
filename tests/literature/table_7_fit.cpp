// Sums histograms of r over time; scans times and tolerances.
#include "table_7_fit.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace equipoise::table_7 {

namespace {

constexpr double least_tolerance = 3e-5, steps_per_decade = 40.0;
constexpr std::size_t bins = tolerances + 1;  // the last: below none

// Index of the smallest tolerance above r^2.
int bin_of(float r2) {
  if (!(r2 < 1.0f)) return tolerances;  // also NaN and infinity
  if (r2 <= 0.0f) return 0;
  const float steps = (0.5f * std::log10(r2) - static_cast<float>(std::log10(least_tolerance))) * 40.0f;
  return std::clamp(static_cast<int>(std::floor(steps)) + 1, 0, tolerances);
}

double log_likelihood(double k, double n, double p) {
  return (k > 0.0 ? k * std::log(p) : 0.0) + (n > k ? (n - k) * std::log1p(-p) : 0.0);
}

double time_of(const Test& test, const std::array<double, 3>& ends, double release) {
  switch (test.origin) {
    case Origin::start:
      return test.offset;
    case Origin::rise_end:
      return ends[0] + test.offset;
    case Origin::hold_end:
      return ends[1] + test.offset;
    case Origin::settling:
      return ends[2] + test.offset;
    case Origin::release:
      return release + test.offset;
    case Origin::rise_multiple:
      break;
  }
  return ends[0] * test.offset;
}

}  // namespace

double deviance(std::uint64_t count, std::uint64_t starts, double printed, std::uint64_t printed_starts) {
  const double n1 = static_cast<double>(starts), n2 = static_cast<double>(printed_starts);
  const double k1 = static_cast<double>(count), p1 = k1 / n1;
  const double p2 = std::clamp(p1, printed / 100.0 - 0.5e-4, printed / 100.0 + 0.5e-4), k2 = p2 * n2;
  const double pooled = (k1 + k2) / (n1 + n2);
  const double apart = log_likelihood(k1, n1, p1) + log_likelihood(k2, n2, p2);
  return std::max(0.0, 2.0 * (apart - log_likelihood(k1 + k2, n1 + n2, pooled)));
}

double tolerance(int index) { return least_tolerance * std::pow(10.0, index / steps_per_decade); }

Counts::Counts(std::size_t windows, double release)
    : windows_(windows), release_(release), counts_(spans.size() * windows * bins) {}

void Counts::add(const Observation& o) {
  std::vector<float> largest(windows_);
  for (std::size_t i = 0; i < o.starts; ++i) {
    const float* row = &o.largest[i * windows_];
    for (std::size_t s = 0; s < spans.size(); ++s) {
      const std::size_t wide = static_cast<std::size_t>(spans[s] / window);
      const std::size_t first = wide == 0 ? 0 : wide - 1;
      for (std::size_t k = first; k < windows_; ++k) {
        if (window * static_cast<double>(k + 1) < release_ + std::max(spans[s], 1.0)) {
          largest[k] = 0.0f;  // of another start: forces a new search for the next
          continue;
        }
        // A running maximum: searched again only when the value that leaves was the largest.
        float value = wide == 0 ? o.at_end[i * windows_ + k] : row[k];
        if (wide > 1) {
          const bool fresh = k == first || !(row[k - wide] < largest[k - 1]);
          value = fresh ? *std::max_element(row + k + 1 - wide, row + k + 1) : std::max(largest[k - 1], row[k]);
        }
        largest[k] = value;
        ++counts_[(s * windows_ + k) * bins + static_cast<std::size_t>(bin_of(value))];
      }
    }
  }
  starts_ += o.starts;
}

void Counts::close() {
  for (std::size_t at = 0; at < counts_.size(); ++at)
    if (at % bins != 0) counts_[at] += counts_[at - 1];
}

std::uint64_t Counts::below(std::size_t span, std::size_t k, int tolerance) const {
  return counts_[(span * windows_ + k) * bins + static_cast<std::size_t>(tolerance)];
}

std::string name_of(const Test& test) {
  const std::string what = spans[test.span] == 0.0 ? "r" : fmt::format("max r over {}", spans[test.span]);
  return fmt::format("{} < {:.2e} at {} {}", what, tolerance(test.tolerance),
                     origin_names[static_cast<std::size_t>(test.origin)], test.offset);
}

Fit evaluate(const Cells& cells, const Test& test, double enough) {
  Fit fit{test, 0.0, {}};
  for (std::size_t row = 0; row < cells.counts.size() && fit.chi2 < enough; ++row) {
    const Counts& counts = cells.counts[row];
    const long k = std::lround(time_of(test, cells.ends[row], counts.release()) / window) - 1;
    if (k < 0 || k >= static_cast<long>(counts.windows())) return {test, 1e300, {}};
    const std::uint64_t below = counts.below(test.span, static_cast<std::size_t>(k), test.tolerance);
    fit.share[row] = 100.0 * static_cast<double>(below) / static_cast<double>(counts.starts());
    fit.chi2 += deviance(below, counts.starts(), table_7_rows[row].printed, table_7_printed_starts);
  }
  return fit;
}

std::vector<Fit> best_fits(const Cells& cells) {
  std::vector<Fit> best;
  for (std::size_t origin = 0; origin < origin_names.size(); ++origin)
    for (std::size_t span = 0; span < spans.size(); ++span) {
      Fit fit;
      const bool multiple = origin == static_cast<std::size_t>(Origin::rise_multiple);
      // Tests may also come before T1 and T2; T0 times 2 to 20 by halves.
      const double first = multiple ? 2.0 : -200.0, last = multiple ? 20.0 : 2000.0, step = multiple ? 0.5 : window;
      for (double offset = first; offset <= last; offset += step)
        for (int tol = 0; tol < tolerances; ++tol) {
          const Fit tried = evaluate(cells, {static_cast<Origin>(origin), offset, span, tol}, fit.chi2);
          if (tried.chi2 >= 1e300) break;  // this time is not observed, whatever the tolerance
          if (tried.chi2 < fit.chi2) fit = tried;
        }
      best.push_back(fit);
    }
  return best;
}

}  // namespace equipoise::table_7
