// Cycles that are born on a chart's Hopf curves, and curves on which they change.
#pragma once

#include "equipoise/base/stop_flag.hpp"
#include "equipoise/curves/balance_plane.hpp"
#include "equipoise/planes/bifurcation_chart.hpp"
#include "equipoise/stability/plane_studies.hpp"

namespace equipoise {

/// From places on every Hopf curve cycles are followed across it; where they fold, double their period or become tori a
/// curve begins, unless it is known. For a chart that has all other curves.
void add_cycles(const PlaneStudies& studies, const BalancePlane& plane, int threads, const StopFlag* stop,
                BifurcationChart& chart);

}  // namespace equipoise
