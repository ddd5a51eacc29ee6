// A map put together from its pixels: filled in, counted, held in memory as far as it fits.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "equipoise/maps/map_figures.hpp"
#include "equipoise/maps/pixel_plan.hpp"
#include "equipoise/results/plane_map.hpp"
#include "equipoise/maps/pixel_store.hpp"

namespace equipoise {

/// All of a map's codes and no shares yet: attractors seen, under the codes that they have in the whole map, then
/// undecided and its like.
std::vector<OutcomeShare> map_codes(const std::map<short, OutcomeShare>& seen, const Study& study);

/// Reads all rows of `store` in order, fills in what `plan` (if any) says, gives codes by `seen`, counts, and adds to
/// `map`, whose axes are those of the whole map: pixels (every so many-th, if it is large), shares, figures. `write`,
/// if any, is handed the rows as they are in the end.
class MapAssembly {
 public:
  using Write = std::function<void(int first, int rows, const MapPixel* pixels)>;

  MapAssembly(PlaneMap& map, const PixelStore& store, const PixelPlan* plan, const std::map<short, OutcomeShare>& seen);
  void run(const Write& write);

 private:
  int band_rows() const;
  void give_codes(std::vector<MapPixel>& pixels) const;
  void add_row(int row, const MapPixel* pixels);
  void hold(const MapPixel* pixels);
  void finish();

  PlaneMap& map_;
  const PixelStore& store_;
  const PixelPlan* plan_;
  const std::map<short, OutcomeShare>& seen_;
  MapFigureCount figures_;
  std::map<short, std::uint64_t> counts_;
  bool one_rotor_;
  int every_ = 1;
};

}  // namespace equipoise
