// The paper's figures as curves: r against t.
#pragma once

#include <string>
#include <vector>

#include "equipoise/model/speed.hpp"

namespace equipoise {

/// Curves of one picture.
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
  std::string choice;  ///< what the paper's caption leaves open and how it was settled here; empty if nothing
  bool two_laws = true;
  std::vector<FigurePanel> panels;
};

}  // namespace equipoise
