// What a design comes to for those who buy it: things, not keys; and the first lines of its answer.
#pragma once

#include <string>

#include "equipoise/core/statistics/share.hpp"
#include "equipoise/results/commands/design_result.hpp"

namespace equipoise {

/// Whether a figure keeps a limit; whether its whole interval does.
bool keeps(const DesignLimit& limit, double value);
bool surely_keeps(const DesignLimit& limit, const DesignEstimate& estimate);
/// Whether the values of what was varied are in an order, so that it may go from one to another.
bool has_ends(const DesignMargin& margin);
/// A figure in words: "starts that balance" of "balanced", "peak displacement, 95 % of starts below" of
/// "peak_radial.0.95"; `brief`: for a table, "peak displacement, 95 %". A name that has no words stands for itself.
std::string figure_words(const DesignFigure& figure, bool brief = false);
/// "below 0.3 mm".
std::string limit_text(const DesignFigure& figure, const DesignLimit& limit);
/// "99.62 %", "0.31 mm", and with its interval "99.62 % (99.50 to 99.71 %)".
std::string estimate_text(const DesignFigure& figure, double value);
std::string estimate_with_interval(const DesignFigure& figure, const DesignEstimate& estimate);
/// "0.05", "12 g", "0 at 0, 2.8 at 60": a candidate's value.
std::string setting_text(const StudyValue& value);
/// "balancer.drag"; for a spin-up "speed of point 1", where point 0 is its start.
std::string margin_name(const std::string& key);

/// What was chosen, as things: "4 balls of 12 mm, ISO VG 46, balls released at 840 rpm".
std::string things_chosen(const Study& study, const std::vector<DesignSetting>& settings);
/// A variable as a thing: "ball diameter" of "balancer.ball_diameter", "speed of point 1" of "speed.speeds[1]".
std::string thing_of(const std::string& key);

/// The figures of the chosen design, and those of the study as it is, in a sentence or two.
std::string design_answer(const DesignResult& result);
/// The first lines of a design's answer.
struct DesignVerdict {
  std::string words;    ///< what to buy, and whether all requirements are met
  std::string because;  ///< the deciding numbers with their intervals, and those of the study as it is
  std::string margins;  ///< how much each value may vary
};
DesignVerdict design_verdict(const DesignResult& result);

}  // namespace equipoise
