// Planes of stability, and the curves in them on which balance changes: documents, JSON, CSV, pictures.
// This room: planes as documents and pictures.
#pragma once

#include <cstddef>
#include <string>

#include "equipoise/extras/planes/bifurcation_chart.hpp"
#include "equipoise/extras/planes/stability_plane.hpp"
#include "equipoise/report/text/table_text.hpp"

namespace equipoise {

/// The parts of the plane, and the study's own point with its ways to the boundaries, in sentences.
std::string stability_answer(const StabilityPlane& plane);

/// Both axes with their points: lines.
std::string axes_text(const StabilityPlane& plane);

/// What linear theory leaves out, and how rates are meant: lines.
std::string plane_notes(const StabilityPlane& plane);

/// "stable", "impossible": what balance is, in words.
const char* balance_words(BalanceKind kind);

/// The answer, then the axes and how the plane was computed.
Document document_of(const StabilityPlane& plane);

/// One JSON object. docs/reference/commands/stability.md lists the keys.
std::string json_text(const StabilityPlane& plane);

/// One line per point: both values, then the numbers of point_numbers.
std::string stability_csv(const StabilityPlane& plane);

/// Where balance is stable or unstable the plane is the darker, the faster deviations die out or
/// grow. Lines show where a pair of eigenvalues crosses (solid), where a real one does (dotted) and where the balanced
/// state ends (dashed); a ring the study's own point. Axes are in the machine's units if it has them.
DrawingRow stability_drawing(const StabilityPlane& plane);

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
Document document_of(const BifurcationChart& chart);

/// One JSON object. docs/reference/commands/chart.md lists the keys.
std::string json_text(const BifurcationChart& chart);

/// One line per point of a curve.
std::string chart_csv(const BifurcationChart& chart);

/// Boxes in which something is proved, shaded by what; curves, solid where a stable balance loses
/// its stability softly, dashed where abruptly, thin where it was unstable before; those of locked states in colour;
/// special points; letters of regions.
DrawingRow chart_drawing(const BifurcationChart& chart);

/// Regions that are listed and drawn, the largest first: no part below half a percent, and at most one per letter.
inline std::size_t told_regions(const BifurcationChart& chart) {
  constexpr std::size_t letters = 26;
  std::size_t count = 0;
  while (count < letters && count < chart.regions.size() && chart.regions[count].part >= 0.005) ++count;
  return count;
}
/// "A" of the largest.
inline std::string region_letter(std::size_t number) { return std::string(1, static_cast<char>('A' + number)); }

}  // namespace equipoise
