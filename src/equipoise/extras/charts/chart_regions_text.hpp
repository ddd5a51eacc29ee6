// Regions of a chart in words.
#pragma once

#include <string>
#include <vector>

#include "equipoise/extras/planes/bifurcation_chart.hpp"
#include "equipoise/report/text/table_text.hpp"

namespace equipoise {

/// "balance stable; balls together unstable (2)".
std::string region_words(const BifurcationChart& chart, const ChartRegion& region);

/// Of them those that are stable: "balance, balls together".
std::string stable_words(const BifurcationChart& chart, const ChartRegion& region);

/// Regions that are told of and drawn, the largest first: no part below half a percent, and at most as many as letters.
std::size_t told_regions(const BifurcationChart& chart);
/// "A" of the largest.
std::string region_letter(std::size_t number);

/// A paragraph a region: letter, part of the plane, what is at rest there.
std::string regions_list(const BifurcationChart& chart, const TextStyle& style);
/// What the table leaves out, and what regions do not tell.
std::string region_notes(const BifurcationChart& chart);

}  // namespace equipoise
