// Designs as charts.
#pragma once

#include <string>
#include <vector>

#include "equipoise/drawing/chart.hpp"
#include "equipoise/results/design_result.hpp"

namespace equipoise {

/// What each of a design's charts shows. Those that it has nothing for are left out.
/// The front: every further objective over the first one.
std::vector<Chart> front_charts(const DesignResult& result);
/// The spin-up chosen, beside the study's own.
std::vector<Chart> spin_up_charts(const DesignResult& result);
/// The first objective as each of the numbers that matter most is moved.
std::vector<Chart> margin_charts(const DesignResult& result, std::size_t most);
/// The best found by then over trajectories followed.
std::vector<Chart> history_charts(const DesignResult& result);

/// For one picture: at most four of them.
std::vector<Chart> design_charts(const DesignResult& result);
/// What they show, in a line.
std::string design_title(const DesignResult& result);

}  // namespace equipoise
