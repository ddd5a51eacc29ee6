// Where the pixels of a map are kept while it is computed: in memory, or in a file.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "equipoise/results/plane_map.hpp"

namespace equipoise {

/// Pixels count row by row from 0.
class PixelStore {
 public:
  virtual ~PixelStore() = default;
  virtual void append(const std::vector<std::uint32_t>& positions, const std::vector<MapPixel>& pixels) = 0;
  /// Whole rows; not_computed_code where nothing was appended.
  virtual void read_rows(int first, int rows, MapPixel* pixels) const = 0;
};

/// For maps that fit.
class PixelMemory : public PixelStore {
 public:
  /// `one_rotor`: balance_margin and balance_growth are not kept.
  PixelMemory(int columns, int rows, bool one_rotor) : columns_(static_cast<std::size_t>(columns)) {
    const std::size_t size = columns_ * static_cast<std::size_t>(rows);
    const MapPixel none;
    code_.assign(size, none.code);
    time_.assign(size, none.time);
    r_max_.assign(size, none.r_max);
    if (one_rotor) return;
    margin_.assign(size, none.balance_margin);
    growth_.assign(size, none.balance_growth);
  }

  void append(const std::vector<std::uint32_t>& positions, const std::vector<MapPixel>& pixels) override {
    for (std::size_t k = 0; k < positions.size(); ++k) {
      const std::size_t at = positions[k];
      code_[at] = pixels[k].code;
      time_[at] = pixels[k].time;
      r_max_[at] = pixels[k].r_max;
      if (margin_.empty()) continue;
      margin_[at] = pixels[k].balance_margin;
      growth_[at] = pixels[k].balance_growth;
    }
  }

  void read_rows(int first, int rows, MapPixel* pixels) const override {
    const std::size_t begin = static_cast<std::size_t>(first) * columns_;
    const std::size_t count = static_cast<std::size_t>(rows) * columns_;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t at = begin + k;
      pixels[k] = {code_[at], code_[at] != not_computed_code, time_[at], r_max_[at]};
      if (margin_.empty()) continue;
      pixels[k].balance_margin = margin_[at];
      pixels[k].balance_growth = growth_[at];
    }
  }

 private:
  std::size_t columns_;
  std::vector<short> code_;
  std::vector<float> time_, r_max_, margin_, growth_;
};

}  // namespace equipoise
