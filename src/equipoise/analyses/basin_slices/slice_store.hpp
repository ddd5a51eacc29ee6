// Where the pixels of a slice are kept while it is computed: in memory, or in a file from which a run can be resumed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "equipoise/results/commands/basin_slice.hpp"
#include "equipoise/results/io/row_store.hpp"
#include "equipoise/results/result_files/slice_file.hpp"

namespace equipoise {

/// Pixels are numbered row by row from 0.
class PixelStore {
 public:
  virtual ~PixelStore() = default;
  virtual void append(const std::vector<std::uint32_t>& positions, const std::vector<SlicePixel>& pixels) = 0;
  /// Whole rows; not_computed_code where nothing was appended.
  virtual void read_rows(int first, int rows, SlicePixel* pixels) const = 0;
};

/// For slices that fit into memory.
class PixelMemory : public PixelStore {
 public:
  PixelMemory(int columns, int rows)
      : columns_(static_cast<std::size_t>(columns)), pixels_(columns_ * static_cast<std::size_t>(rows)) {}

  void append(const std::vector<std::uint32_t>& positions, const std::vector<SlicePixel>& pixels) override {
    for (std::size_t k = 0; k < positions.size(); ++k) pixels_[positions[k]] = pixels[k];
  }
  void read_rows(int first, int rows, SlicePixel* pixels) const override {
    std::copy_n(&pixels_[static_cast<std::size_t>(first) * columns_], static_cast<std::size_t>(rows) * columns_,
                pixels);
  }

 private:
  std::size_t columns_;
  std::vector<SlicePixel> pixels_;
};

/// The pixels of a slice, as a store. The finished results have room for all of them.
class SliceStore : public PixelStore, public io::RowStore {
 public:
  /// Opens what there is of the same study, axes, version and arithmetic, or begins again. Throws like io::Store.
  SliceStore(const std::string& path, const io::SliceFileHeader& header);

  /// Whether something is not in the finished results yet.
  bool unfinished() const { return !new_rows().empty(); }
  /// Computed pixels.
  void for_each_known(const std::function<void(std::uint32_t position, short code)>& visit) const;
  /// The codes of motions; some may appear twice.
  const std::vector<OutcomeShare>& codes() const { return codes_; }

  void append(const std::vector<std::uint32_t>& positions, const std::vector<SlicePixel>& pixels) override;
  /// Adds a code before pixels use it.
  void append_code(const OutcomeShare& code);
  void read_rows(int first, int rows, SlicePixel* pixels) const override;

  /// Writes the slice with its final codes: `codes`, those of `seen` by the codes so far.
  void finish(const std::vector<OutcomeShare>& codes, const std::map<short, OutcomeShare>& seen, bool complete);

 private:
  void read_pixels(std::size_t column, std::uint64_t first, std::size_t count, double* values) const;

  const io::SliceFileHeader header_;
  std::vector<OutcomeShare> codes_;
};

}  // namespace equipoise
