// The figures of Wright and Peng (2019): r against t on the vibrating attractors and through spin-ups.
#pragma once

#include <string>
#include <vector>

#include "equipoise/base/error.hpp"
#include "equipoise/literature/paper_figure.hpp"

namespace equipoise {

/// "figure-attractors", "figure-transients", "figure-ball-lag", "figure-release".
const std::vector<std::string>& paper_figure_ids();

/// Computes a figure's curves, each by simulate(). Empty panels if stopped early. `id`: one of paper_figure_ids().
PaperFigure paper_figure(const std::string& id, const StopFlag* stop = nullptr);

}  // namespace equipoise
