// Pictures of a sweep.
#pragma once

#include <optional>
#include <string>

#include "equipoise/report/drawing/document.hpp"
#include "equipoise/report/drawing/plot.hpp"
#include "equipoise/results/commands/sweep_result.hpp"

namespace equipoise {

/// Along one axis: stacked shares, with the interval of balance; a single value becomes a column. Over two axes: the
/// balanced share of every cell as a colour, and as a number where there is room, values in order and evenly spaced;
/// over three one such table for each value of the first. An identifier has the same colour in all pictures.
DrawingRow sweep_drawing(const SweepResult& result);

/// The same as a picture file (SVG); `title` goes before the parameters.
std::string sweep_plot(const SweepResult& result, const std::string& title);

/// Along one axis: median and 90 % quantile of the peak displacement, against the limit. Empty without transients.
std::optional<Plot> peak_plot(const SweepResult& result);

}  // namespace equipoise
