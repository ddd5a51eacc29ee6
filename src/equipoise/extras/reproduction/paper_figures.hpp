// The figures of Wright and Peng (2019): r against t on the vibrating attractors and through spin-ups.
#pragma once

#include <string>
#include <vector>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/machine/drives/speed.hpp"

namespace equipoise {

struct FigureSeries {
  std::string label;
  model::SpeedLaw law = model::SpeedLaw::published;
  std::vector<double> t, r;
  std::string study;  ///< resolved, as TOML
};
struct FigurePanel {
  std::string title;
  std::vector<FigureSeries> series;
};
struct PaperFigure {
  std::string id, title, caption;
  std::string choice;  ///< how a gap in the paper's caption was filled here; empty if there is none
  std::vector<FigurePanel> panels;
};

/// "figure-attractors", "figure-transients", "figure-ball-lag", "figure-release".
std::vector<std::string> paper_figure_ids();

/// Computes a figure's curves by simulate(). Panels are empty if stopped early. `id`: one of paper_figure_ids().
PaperFigure paper_figure(const std::string& id, const StopFlag* stop = nullptr);

/// Columns panel, series, law, t, r, after comment lines with the caption and every curve's study.
std::string figure_csv(const PaperFigure& figure);

}  // namespace equipoise
