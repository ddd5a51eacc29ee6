// Checks signs, units and sums of an ensemble's printed figures.
#pragma once

#include <string>
#include <vector>

#include "equipoise/results/commands/basin_result.hpp"

namespace equipoise::audit {

/// One line for each impossible figure.
std::vector<std::string> impossible_figures(const BasinResult& result);

/// One line for each figure of a machine in SI units that does not equal its dimensionless figure times its unit.
std::vector<std::string> wrong_units(const BasinResult& dimensionless, const BasinResult& physical);

}  // namespace equipoise::audit
