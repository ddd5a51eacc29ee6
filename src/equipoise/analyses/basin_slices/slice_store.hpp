// The file in which the pixels of a slice are kept while it is computed, and from which a run can be resumed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/results/commands/basin_slice.hpp"
#include "equipoise/results/io/row_store.hpp"
#include "equipoise/results/result_files/slice_file.hpp"

namespace equipoise {

/// Pixels are numbered row by row from 0. The finished results have room for all of them.
class SliceStore : public io::RowStore {
 public:
  /// Opens results of the same study, axes, version and arithmetic, or begins new ones. Throws like io::Store.
  SliceStore(const std::string& path, const io::SliceFileHeader& header);

  /// Whether something is not in the finished results yet.
  bool unfinished() const { return !new_rows().empty(); }
  /// Computed pixels.
  void for_each_known(const std::function<void(std::uint32_t position, short code)>& visit) const;
  /// Of finished results: SliceFigures::flipped.
  const std::optional<Share>& flipped() const { return header_.flipped; }
  /// The codes of motions; some may appear twice.
  const std::vector<OutcomeShare>& codes() const { return codes_; }

  void append(const std::vector<std::uint32_t>& positions, const std::vector<SlicePixel>& pixels);
  /// Adds a code before pixels use it.
  void append_code(const OutcomeShare& code);
  /// Whole rows; not_computed_code where nothing was appended.
  void read_rows(int first, int rows, SlicePixel* pixels) const;

  /// Writes the slice with its final codes: `codes`, those of `seen` by the codes so far.
  void finish(const std::vector<OutcomeShare>& codes, const std::map<short, OutcomeShare>& seen, bool complete,
              const std::optional<Share>& flipped);

 private:
  void read_pixels(std::size_t column, std::uint64_t first, std::size_t count, double* values) const;

  io::SliceFileHeader header_;
  std::vector<OutcomeShare> codes_;
};

}  // namespace equipoise
