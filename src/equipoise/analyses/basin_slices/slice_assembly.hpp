// Assembles a slice from its pixels: counts them, and keeps what fits into memory.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "equipoise/analyses/basin_slices/invariant_pixels.hpp"
#include "equipoise/analyses/basin_slices/pixel_store.hpp"
#include "equipoise/analyses/basin_slices/slice_figures.hpp"
#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

/// A slice's codes, without shares yet: the attractors seen, with final codes, then outcomes without attractor.
std::vector<OutcomeShare> map_codes(const std::map<short, OutcomeShare>& seen, const Study& study);

/// Reads all rows of `store` in order, renames codes by `seen`, and counts. Adds to `map`, whose axes are those of the
/// whole slice: pixels (of a large slice, only some), shares, figures.
class SliceAssembly {
 public:
  SliceAssembly(BasinSlice& map, const PixelStore& store, const std::map<short, OutcomeShare>& seen);
  void run();

 private:
  short id_of(short code) const;
  void give_codes(std::vector<SlicePixel>& pixels) const;
  void add_row(int row, const SlicePixel* pixels);
  void hold(const SlicePixel* pixels);
  void finish();

  BasinSlice& map_;
  const PixelStore& store_;
  const std::map<short, OutcomeShare>& seen_;
  SliceFigureCount figures_;
  const InvariantPixels invariant_;
  std::map<short, std::uint64_t> counts_;
  bool one_rotor_;
  int every_ = 1;
};

}  // namespace equipoise
