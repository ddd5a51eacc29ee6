// Where the pixels of a slice are kept while it is computed: in memory, or in a file.
#pragma once

#include <array>
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
  /// `one_rotor`: numbers that belong to the rotor are not kept.
  PixelMemory(int columns, int rows, bool one_rotor)
      : columns_(static_cast<std::size_t>(columns)),
        one_rotor_(one_rotor),
        code_(columns_ * static_cast<std::size_t>(rows), not_computed_code) {
    visit_pixel_numbers(one_rotor, [&](std::size_t k, float SlicePixel::*value) {
      numbers_[k].assign(code_.size(), SlicePixel{}.*value);
    });
  }

  void append(const std::vector<std::uint32_t>& positions, const std::vector<SlicePixel>& pixels) override {
    for (std::size_t k = 0; k < positions.size(); ++k) {
      code_[positions[k]] = pixels[k].code;
      visit_pixel_numbers(
          one_rotor_, [&](std::size_t n, float SlicePixel::*value) { numbers_[n][positions[k]] = pixels[k].*value; });
    }
  }

  void read_rows(int first, int rows, SlicePixel* pixels) const override {
    std::size_t at = static_cast<std::size_t>(first) * columns_;
    for (std::size_t k = 0; k < static_cast<std::size_t>(rows) * columns_; ++k, ++at) {
      pixels[k] = {code_[at]};
      visit_pixel_numbers(one_rotor_,
                          [&](std::size_t n, float SlicePixel::*value) { pixels[k].*value = numbers_[n][at]; });
    }
  }

 private:
  std::size_t columns_;
  bool one_rotor_;
  std::vector<short> code_;
  std::array<std::vector<float>, pixel_numbers.size()> numbers_;
};

}  // namespace equipoise
