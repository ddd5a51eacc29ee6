// Curves on which balance changes, as text, JSON and CSV.
// This room: planes as text, tables and pictures.
#pragma once

#include <string>

#include "equipoise/extras/planes/bifurcation_chart.hpp"
#include "equipoise/report/text/table_text.hpp"

namespace equipoise {

/// How the lines on which a stable balance loses its stability are made up: their length in the plane, whose sides
/// count 1.
struct BalanceLoss {
  double soft = 0.0, abrupt = 0.0;  ///< by a swing that stays small beyond the line, or does not
  double unknown = 0.0;             ///< by a swing of which that is not known
  double real = 0.0;                ///< without a swing
  double length() const { return soft + abrupt + unknown; }
};
BalanceLoss balance_loss(const BifurcationChart& chart);

/// Where balance is stable, how it is lost, what is proved: in sentences.
std::string chart_answer(const BifurcationChart& chart);

/// The answer, then curves and points.
std::string chart_text(const BifurcationChart& chart, const TextStyle& style = wide_style);

/// One JSON object. docs/reference/commands/chart.md lists the keys.
std::string chart_json(const BifurcationChart& chart);

/// One line a point of a curve.
std::string chart_csv(const BifurcationChart& chart);

}  // namespace equipoise
