// Designs as charts.
#pragma once

#include <string>
#include <vector>

#include "equipoise/report/drawing/chart.hpp"
#include "equipoise/results/commands/design_result.hpp"

namespace equipoise {

/// The charts of a design; those without data are left out.
/// The front: every further objective against the first.
std::vector<Chart> front_charts(const DesignResult& result);
/// The chosen spin-up beside the study's own.
std::vector<Chart> spin_up_charts(const DesignResult& result);
/// The first objective as each of the most influential numbers is changed.
std::vector<Chart> margin_charts(const DesignResult& result, std::size_t most);
/// The best value so far against trajectories followed.
std::vector<Chart> history_charts(const DesignResult& result);

/// At most four charts, for one picture.
std::vector<Chart> design_charts(const DesignResult& result);
/// A one-line title for the charts.
std::string design_title(const DesignResult& result);

}  // namespace equipoise
