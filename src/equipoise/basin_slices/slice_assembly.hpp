// A map put together from its pixels: filled in, counted, held in memory as far as it fits.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "equipoise/basin_slices/pixel_plan.hpp"
#include "equipoise/basin_slices/pixel_store.hpp"
#include "equipoise/basin_slices/slice_figures.hpp"
#include "equipoise/results/basin_slice.hpp"

namespace equipoise {

/// All of a map's codes and no shares yet: attractors seen, under the codes that they have in the whole map, then
/// undecided and its like.
std::vector<OutcomeShare> map_codes(const std::map<short, OutcomeShare>& seen, const Study& study);

/// Reads all rows of `store` in order, fills in what `plan` (if any) says, gives codes by `seen`, counts, and adds to
/// `map`, whose axes are those of the whole map: pixels (every so many-th, if it is large), shares, figures. `write`,
/// if any, is handed the rows as they are in the end.
class SliceAssembly {
 public:
  using Write = std::function<void(int first, int rows, const SlicePixel* pixels)>;

  SliceAssembly(BasinSlice& map, const PixelStore& store, const PixelPlan* plan,
                const std::map<short, OutcomeShare>& seen);
  void run(const Write& write);

 private:
  int band_rows() const;
  void give_codes(std::vector<SlicePixel>& pixels) const;
  void add_row(int row, const SlicePixel* pixels);
  void hold(const SlicePixel* pixels);
  void finish();

  BasinSlice& map_;
  const PixelStore& store_;
  const PixelPlan* plan_;
  const std::map<short, OutcomeShare>& seen_;
  SliceFigureCount figures_;
  std::map<short, std::uint64_t> counts_;
  bool one_rotor_;
  int every_ = 1;
};

}  // namespace equipoise
