// A map as NetCDF.
#pragma once

#include <string>

#include "equipoise/results/plane_map.hpp"

namespace equipoise {

/// Writes `path` anew: dimensions y and x with their coordinates; variables outcome, decision_time, r_max,
/// balance_margin, balance_growth(y, x) with units and long_name, the codes as flag_values and flag_meanings of outcome
/// and as code, name, alias, share(outcome_kind); the study as an attribute. Throws RunError if it cannot be written.
void write_map_file(const std::string& path, const PlaneMap& map);

}  // namespace equipoise
