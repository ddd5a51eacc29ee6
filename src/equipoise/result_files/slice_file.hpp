// A map as NetCDF.
#pragma once

#include <string>

#include "equipoise/results/basin_slice.hpp"

namespace equipoise {

/// Writes `path` anew: dimensions y and x with their coordinates; variables outcome, decision_time, r_max(y, x), of a
/// map with blocks computed(y, x), and balance_margin, balance_growth(y, x) or of one rotor as numbers, with units and
/// long_name; the codes as flag_values and flag_meanings of outcome and as code, name, alias, share(outcome_kind); the
/// study as an attribute. Readable by xarray, ncdump, ncview. Behind it all stands a checksum. Throws RunError if it
/// cannot be written.
void write_map_file(const std::string& path, const BasinSlice& map);

}  // namespace equipoise
