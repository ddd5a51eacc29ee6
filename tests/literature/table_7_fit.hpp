// Shares of starts that a test at a finite time calls balanced, for all times and tolerances at once, and their
// agreement with printed shares.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "table_7_protocol.hpp"

namespace equipoise::table_7 {

/// Twice the logarithm of the likelihood ratio of two shares against one: `count` of `starts` here, `printed` percent
/// of `printed_starts` there, allowing half of the printed value's last digit (0.01). Chi-squared with one degree of
/// freedom if both are samples of one share.
double deviance(std::uint64_t count, std::uint64_t starts, double printed, std::uint64_t printed_starts);

/// What is compared with the tolerance: r at one time, or its largest value over this long before.
inline constexpr std::array<double, 5> spans{0.0, 10.0, 50.0, 100.0, 200.0};
inline constexpr double window = table_7_window;

/// Tolerances of the scan: 0.00003 to 0.3, 40 a decade.
inline constexpr int tolerances = 161;
double tolerance(int index);

/// Counts of starts below every tolerance, for every span and time of one row.
class Counts {
 public:
  Counts(std::size_t windows, double release);
  void add(const Observation& observation);
  std::uint64_t starts() const { return starts_; }
  std::size_t windows() const { return windows_; }
  double release() const { return release_; }
  /// At time (k + 1) window; 0 for spans that begin before the release.
  std::uint64_t below(std::size_t span, std::size_t k, int tolerance) const;
  void close();  ///< no more to add: sums up

 private:
  std::size_t windows_;
  double release_;
  std::uint64_t starts_ = 0;
  std::vector<std::uint32_t> counts_;
};

/// Origin of the test's time.
enum class Origin { start, rise_end, hold_end, settling, release, rise_multiple };
inline constexpr std::array<const char*, 6> origin_names{"t", "T0 +", "T1 +", "T2 +", "release +", "T0 times"};

/// A test: r below a tolerance, at a time. Two fitted numbers.
struct Test {
  Origin origin = Origin::start;
  double offset = 0.0;  ///< time after the origin; the factor of T0 for rise_multiple
  std::size_t span = 0;
  int tolerance = 0;
};
std::string name_of(const Test& test);

struct Fit {
  Test test;
  double chi2 = 1e300;
  std::array<double, 4> share{};  ///< percent
};

/// The four rows of one variant, with the ends of their pieces.
struct Cells {
  std::vector<Counts> counts;
  std::vector<std::array<double, 3>> ends;
};

/// The best tolerance and time for every origin and span: origins x spans.
std::vector<Fit> best_fits(const Cells& cells);
/// One test. Skips the remaining rows once chi-squared exceeds `enough`.
Fit evaluate(const Cells& cells, const Test& test, double enough = 1e299);

}  // namespace equipoise::table_7
