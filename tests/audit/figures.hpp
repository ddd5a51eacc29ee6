// Whether what is printed of an ensemble has the sign, the unit and the sums it should.
#pragma once

#include <string>
#include <vector>

#include "equipoise/results/basin_result.hpp"

namespace equipoise::audit {

/// One line for each figure that cannot be.
std::vector<std::string> impossible_figures(const BasinResult& result);

/// One line for each figure of a machine in SI units that is not its dimensionless one times its unit.
std::vector<std::string> wrong_units(const BasinResult& dimensionless, const BasinResult& physical);

}  // namespace equipoise::audit
