// Writes a basin slice as NetCDF.
#pragma once

#include <string>

#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

/// Writes `path` anew: dimensions y and x with their coordinates; variables outcome, decision_time, r_max(y, x), and
/// balance_margin, balance_growth(y, x), or single numbers for one rotor, with units and long_name; the codes as
/// flag_values and flag_meanings of outcome and as code, name, alias, share(outcome_kind); the study as an attribute.
/// Readable by xarray, ncdump, ncview. A checksum ends the file. Throws RunError if it cannot be written.
void write_map_file(const std::string& path, const BasinSlice& map);

}  // namespace equipoise
