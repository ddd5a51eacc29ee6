// Boxes that cover a plane of two parameters, each with what interval arithmetic proves of it.
#pragma once

#include <cstdint>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/extras/planes/bifurcation_chart.hpp"
#include "equipoise/extras/stability/plane_studies.hpp"

namespace equipoise {

/// Halves boxes, the largest first, until at most `undecided` of the plane is open or `most` boxes were judged. Leaves
/// chart.not_proved where nothing can be proved of this rotor or of these keys.
void add_proof_boxes(const PlaneStudies& studies, std::uint64_t most, double undecided, const StopFlag* stop,
                     BifurcationChart& chart);

}  // namespace equipoise
