// Where curves begin to be followed: between neighbours of a grid that differ.
#pragma once

#include <vector>

#include "equipoise/base/stop_flag.hpp"
#include "equipoise/curves/balance_plane.hpp"
#include "equipoise/planes/bifurcation_chart.hpp"

namespace equipoise {

/// All curves of the chart's plane, with their special points.
void add_curves(const BalancePlane& plane, const StopFlag* stop, BifurcationChart& chart);

}  // namespace equipoise
