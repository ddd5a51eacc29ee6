// The plots of a reproduced paper: shares against speed or duration, and the figures' curves.
#pragma once

#include <optional>
#include <vector>

#include "equipoise/extras/reproduction/reproduction.hpp"
#include "equipoise/report/drawing/plot.hpp"

namespace equipoise {

/// Balanced share of every row: printed, published law, kinematic law. Empty for table 7, whose rows share no axis.
std::optional<Plot> table_plot(const ReproducedTable& table);

/// One plot per panel.
std::vector<Plot> figure_plots(const PaperFigure& figure);

/// Balanced share against speed, for starts in the box and at rest.
Plot plot_of_box(const OpenQuestions& open);

/// Columns panel, series, law, t, r, after comment lines with the caption and every curve's study.
std::string figure_csv(const PaperFigure& figure);

}  // namespace equipoise
