// Designs as text and JSON.
#pragma once

#include <cstddef>
#include <string>

#include "equipoise/results/design_result.hpp"
#include "equipoise/text/table_text.hpp"

namespace equipoise {

/// For a terminal: the front, the chosen design beside the original study, its margins, what limits it.
std::string design_text(const DesignResult& result, const TextStyle& style = wide_style);
/// One JSON object; figures are in the units of "units", shares are fractions of one, infinite values are null.
std::string design_json(const DesignResult& result);
/// One line per member of the front.
std::string design_csv(const DesignResult& result);

/// The result in a sentence or two.
std::string design_answer(const DesignResult& result);

/// "99.62 %", "0.31 mm", and with its interval "99.62 % (99.50 to 99.71 %)".
std::string estimate_text(const DesignFigure& figure, double value);
std::string estimate_with_interval(const DesignFigure& figure, const DesignEstimate& estimate);
/// "0.05", "12 g", "0 at 0, 2.8 at 60": a candidate's value.
std::string setting_text(const StudyValue& value);
/// "balancer.drag"; for a spin-up "speed of point 1", where point 0 is its start.
std::string margin_name(const std::string& key);

}  // namespace equipoise
