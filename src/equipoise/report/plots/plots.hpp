// Results as pictures, for their documents.
// This room: results as pictures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "equipoise/report/drawing/document.hpp"
#include "equipoise/report/drawing/plot_svg.hpp"
#include "equipoise/results/commands/basin_slice.hpp"
#include "equipoise/results/commands/branch.hpp"
#include "equipoise/results/commands/capacity_result.hpp"
#include "equipoise/results/commands/design_result.hpp"
#include "equipoise/results/commands/machine_page.hpp"
#include "equipoise/results/commands/sweep_result.hpp"

namespace equipoise {

/// The balls in their race, in the rotating frame, next to the path of the rotor's centre in fixed axes, to one scale
/// for all motions of the page; what they do, in words.
Drawing motion_drawing(const MachinePage& page, const DrawnMotion& motion);

/// The page's main picture: the displacement of every shown run against time, with the limit if there is one and a
/// legend in words; above it the speed, where that is the same in all runs and never falls.
std::string run_up_svg(const MachinePage& page);
/// Whether run_up_svg() says how fast the rotor turns when: it need not at a constant speed.
bool run_up_tells_speed(const MachinePage& page);

/// "typical start, half peak lower: peak 26.5 mm; balanced at the end", "without balls: peak 10.6 mm; 2.58 mm at the
/// end".
std::string run_words(const MachinePage& page, const ShownRun& run);

/// The main picture with its caption; shares, motions and peaks of all starts, side by side.
DrawingRow run_up_drawing(const MachinePage& page);
DrawingRow ends_drawing(const MachinePage& page);

/// One outcome of a sweep, stacked on those before it.
struct SweepLayer {
  std::string name;           ///< after its alias
  std::string colour;         ///< the same in all pictures
  std::vector<double> share;  ///< by cell; 0 where it is missing
};
/// From the bottom: balanced, the other attractors met, by identifier, and outcomes without attractor.
std::vector<SweepLayer> sweep_layers(const SweepResult& result);

/// Along one axis: stacked shares, with the interval of balance; a single value becomes a column. Over two axes: the
/// balanced share of every cell as a colour, and as a number where there is room, values in order and evenly spaced;
/// over three one such table for each value of the first. An identifier has the same colour in all pictures.
DrawingRow sweep_drawing(const SweepResult& result);

/// Along one axis: median and 90 % quantile of the peak displacement, against the limit. Empty without transients.
std::optional<Plot> peak_plot(const SweepResult& result);

/// Outcomes by colour, the darker, the later they were decided, listed below with their shares; lines where balance
/// ends (dashed) or changes stability. For a large slice some rows and columns are left out, which the caption says.
DrawingRow map_drawing(const BasinSlice& map);

/// r_min to r_max of every branch against the parameter: a band where the motion attracts, dashed lines where it is
/// unstable. An identifier has the same colour in all pictures.
DrawingRow branch_drawing(const BranchesResult& result);

/// Along the first parameter, one line per value of the second and one plot per value of the third. Without
/// parameters: the balanced share over the values tried.
std::vector<Plot> capacity_plots(const CapacityResult& result);

/// The plots of a design; those without data are left out.
/// The front: every further objective against the first.
std::vector<Plot> front_plots(const DesignResult& result);
/// The chosen spin-up next to the study's own.
std::vector<Plot> spin_up_plots(const DesignResult& result);
/// The first objective as each of the most influential numbers is changed.
std::vector<Plot> margin_plots(const DesignResult& result, std::size_t most);
/// The best value so far against trajectories followed.
std::vector<Plot> history_plots(const DesignResult& result);

/// A one-line title for the plots.
std::string design_title(const DesignResult& result);

}  // namespace equipoise
