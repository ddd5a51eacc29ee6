// The charts of a reproduced paper: shares against speed or duration, and the figures' curves.
#pragma once

#include <optional>
#include <vector>

#include "equipoise/extras/reproduction/reproduction.hpp"
#include "equipoise/report/drawing/chart.hpp"

namespace equipoise {

/// Balanced share of every row: printed, published law, kinematic law. Empty for table 7, whose rows share no axis.
std::optional<Chart> table_chart(const ReproducedTable& table);

/// One chart per panel.
std::vector<Chart> figure_charts(const PaperFigure& figure);

/// Balanced share against speed, for starts in the box and at rest.
Chart box_chart(const OpenQuestions& open);

/// Columns panel, series, law, t, r, after comment lines with the caption and every curve's study.
std::string figure_csv(const PaperFigure& figure);

}  // namespace equipoise
