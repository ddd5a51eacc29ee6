// The pictures of a sweep's page, as SVG.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "equipoise/drawing/chart.hpp"
#include "equipoise/results/sweep_result.hpp"

namespace equipoise {

/// Along one axis: shares stacked, with the interval of balance; a lone value is a column.
std::string stacked_svg(const SweepResult& result);

/// Over the last two axes, from cell `first` on: the balanced share of every cell by colour, and as a number where
/// there is room. Values stand in order, evenly.
std::string heat_svg(const SweepResult& result, std::size_t first);

/// Along one axis: median of the peak displacement and what nine of ten stay below, against the limit; none where
/// transients were not gathered.
std::optional<Chart> peak_chart(const SweepResult& result);

}  // namespace equipoise
