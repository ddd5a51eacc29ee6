// Designs as plots.
#pragma once

#include <string>
#include <vector>

#include "equipoise/report/drawing/plot.hpp"
#include "equipoise/results/commands/design_result.hpp"

namespace equipoise {

/// The plots of a design; those without data are left out.
/// The front: every further objective against the first.
std::vector<Plot> front_plots(const DesignResult& result);
/// The chosen spin-up beside the study's own.
std::vector<Plot> spin_up_plots(const DesignResult& result);
/// The first objective as each of the most influential numbers is changed.
std::vector<Plot> margin_plots(const DesignResult& result, std::size_t most);
/// The best value so far against trajectories followed.
std::vector<Plot> history_plots(const DesignResult& result);

/// At most four plots, for one picture.
std::vector<Plot> design_plots(const DesignResult& result);
/// A one-line title for the plots.
std::string design_title(const DesignResult& result);

}  // namespace equipoise
