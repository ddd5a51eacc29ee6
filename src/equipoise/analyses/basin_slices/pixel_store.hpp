// Where the pixels of a slice are kept while it is computed: in memory, or in a file.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "equipoise/results/commands/basin_slice.hpp"

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

}  // namespace equipoise
