// Locked states at every point of a chart's grid: where their curves begin, and regions by what exists and is stable.
#pragma once

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/extras/curves/balance_plane.hpp"
#include "equipoise/extras/planes/bifurcation_chart.hpp"
#include "equipoise/extras/stability/plane_studies.hpp"

namespace equipoise {

/// Curves of locked states and the chart's regions. Of a rotor whose locked states are not known regions tell of
/// balance alone, and chart.no_locked says why. The result does not depend on the number of threads.
void add_locked_states(const PlaneStudies& studies, const BalancePlane& plane, int threads, const StopFlag* stop,
                       BifurcationChart& chart);

}  // namespace equipoise
