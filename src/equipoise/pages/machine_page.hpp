// Everything that the page for one machine shows, computed.
#pragma once

#include <vector>

#include "equipoise/basins/basin.hpp"
#include "equipoise/results/machine_page.hpp"
#include "equipoise/study/ball_details.hpp"

namespace equipoise {

/// As for basin(). Transients are gathered, and starts kept (the first million: of all of a grid), whatever is said of
/// them.
struct MachinePageOptions : BasinOptions {
  BallDetails balls;              ///< for explain()
  std::vector<GivenTable> given;  ///< given_tables() of the study's text; empty: of the study
};

/// Runs the ensemble and follows what is to be shown of it. Throws as basin() does. Stopped, it holds what was done.
MachinePage machine_page(const Study& study, const MachinePageOptions& options = {});

}  // namespace equipoise
