// The pictures on a sweep's page, as SVG.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "equipoise/drawing/chart.hpp"
#include "equipoise/results/sweep_result.hpp"

namespace equipoise {

/// Along one axis: stacked shares, with the interval of balance; a single value becomes a column.
std::string stacked_svg(const SweepResult& result);

/// Over the last two axes, from cell `first` on: the balanced share of every cell as a colour, and as a number where
/// there is room. Values stand in order, evenly spaced.
std::string heat_svg(const SweepResult& result, std::size_t first);

/// Along one axis: median and 90 % quantile of the peak displacement, against the limit. Empty without transients.
std::optional<Chart> peak_chart(const SweepResult& result);

}  // namespace equipoise
