// The NetCDF file of a basin slice.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/results/columns/dataset.hpp"
#include "equipoise/results/commands/basin_slice.hpp"
#include "equipoise/results/io/netcdf.hpp"

namespace equipoise {

/// Writes `path` again: dimensions y and x with their coordinates; variables outcome, decision_time, r_max(y, x), and
/// balance_margin, balance_growth(y, x), or single numbers for one rotor, with units and long_name; the codes as
/// flag_values and flag_meanings of outcome and as code, name, alias, share(outcome_kind); the study as an attribute.
/// Readable by xarray, ncdump, ncview. A checksum ends the file. Throws RunError if it cannot be written.
void write_map_file(const std::string& path, const BasinSlice& map);

namespace io {

/// What a slice's file states in addition to its pixels.
struct SliceFileHeader {
  std::string study;  ///< resolved, as TOML
  SliceAxis x, y;
  std::vector<AngleLink> links;
  std::string arithmetic;  ///< BasinFileHeader::arithmetic
  bool one_rotor = true;
  SlicePixel rotor{};              ///< for one rotor: its numbers
  std::optional<Share> flipped{};  ///< SliceFigures::flipped
  std::size_t components = 0;      ///< of a state
};

/// Everything that determines the pixels; one key per line, as in a study.
std::string identity_of(const SliceFileHeader& header);

/// SliceFigures::flipped of a file. Throws RunError if it contradicts itself.
std::optional<Share> read_flipped(const NetcdfFile& file);

/// The outcome, then the pixel_numbers. For one rotor, those that belong to it are not kept.
std::vector<StoredColumn> pixel_columns(bool one_rotor);

/// The content of such a file; refers to the arguments. `codes`: all codes that pixels may have except
/// not_computed_code. `values`: of a column of pixels, row by row.
Dataset slice_dataset(const SliceFileHeader& header, const std::vector<OutcomeShare>& codes,
                      const std::vector<std::vector<double>>& discoveries, bool complete,
                      const std::function<DataValues(std::size_t column)>& values);

}  // namespace io
}  // namespace equipoise
