// A test of balance at a finite time, applied to the slow rows of tables 1 to 6.
#pragma once

#include <cstdint>
#include <string>

namespace equipoise::table_7 {

/// Prints, for each row, the share of starts whose r stays below `tolerance` over `span` (a multiple of 10) at several
/// times, its z-score against the printed share, and the earliest time from which the two agree within 3. `studies`:
/// the folder studies/paper.
int elsewhere(const std::string& studies, double tolerance, double span, std::uint64_t starts, double until);

}  // namespace equipoise::table_7
