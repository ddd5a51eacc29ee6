// Table 7 of Wright and Peng (2019), the trapezoid, and the best lead on how it was computed
// (docs/evidence/table-7.md).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "equipoise/analyses/one_study/observation.hpp"
#include "equipoise/core/statistics/share.hpp"

namespace equipoise {

/// A printed row: the ramp function rises from 0 to 3 until T0, stays until T1 and falls to 2 until T2.
struct Table7Row {
  double t0, t1, t2;
  double printed;  ///< balanced, in percent of 300 000 starts
  std::string label() const;
};
inline constexpr std::array<Table7Row, 4> table_7_rows{
    {{50, 400, 500, 98.43}, {100, 300, 500, 97.19}, {100, 400, 500, 97.64}, {200, 400, 500, 93.64}}};

/// A test of balance at a finite time: r stays below `tolerance` throughout [from, to], multiples of table_7_window, or
/// at one time if both are equal.
struct Table7Test {
  double from, to, tolerance;
};
inline constexpr double table_7_window = 10.0;

/// How many of the starts observed in windows of table_7_window pass `test`.
std::uint64_t called_balanced(const Observation& observation, const Table7Test& test);

struct LeadReading {
  Table7Row row;
  Share balanced;  ///< starts that pass the test
};

/// The best lead, not a claim: kinematic law, balls released at 2.2, balanced if r stays below 0.00134 from t = 630 to
/// 730. The release was chosen among 96 protocols; time and tolerance were FITTED to the printed shares; none is in the
/// paper's text. Uses starts 0 .. starts - 1 of seed 1. Throws RunError if stopped early.
std::vector<LeadReading> observe_table_7_lead(std::uint64_t starts, int threads = 0, const StopFlag* stop = nullptr);

}  // namespace equipoise
