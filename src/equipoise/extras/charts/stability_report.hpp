// Where balance is stable in a plane: text, JSON, CSV, picture.
#pragma once

#include <string>

#include "equipoise/extras/planes/stability_plane.hpp"
#include "equipoise/report/text/table_text.hpp"

namespace equipoise {

/// The parts of the plane, and the study's own point with its ways to the boundaries, in sentences.
std::string stability_answer(const StabilityPlane& plane);

/// The study, and both axes with their points: lines.
std::string plane_heading(const StabilityPlane& plane);

/// What linear theory leaves out, and how rates are meant: lines.
std::string plane_notes(const StabilityPlane& plane);

/// "stable", "impossible": what balance is, in words.
const char* balance_words(BalanceKind kind);

/// The answer, then the axes and how the plane was computed.
std::string stability_text(const StabilityPlane& plane, const TextStyle& style = wide_style);

/// One JSON object. docs/reference/commands/stability.md lists the keys.
std::string stability_json(const StabilityPlane& plane);

/// One line a point: both values, then the numbers of point_numbers.
std::string stability_csv(const StabilityPlane& plane);

/// A picture file (SVG). Where balance is stable or unstable the plane is the darker, the faster deviations die out or
/// grow. Lines show where a pair of eigenvalues crosses (solid), where a real one does (dotted) and where the balanced
/// state ends (dashed); a ring the study's own point. Axes are in the machine's units if it has them. `title` goes
/// before the parameters.
std::string stability_plot(const StabilityPlane& plane, const std::string& title);

/// How an axis is drawn, in the machine's units if it has them: its label, what a dimensionless value is multiplied by,
/// and the unit that it then has, if any.
struct ShownAxis {
  std::string label;
  double factor = 1.0;
  std::string unit = {};
};
ShownAxis shown_axis(const Study& study, const SliceAxis& axis);

}  // namespace equipoise
