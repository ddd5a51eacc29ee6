// Pixels that another map's file has already.
#pragma once

#include <string>
#include <vector>

#include "equipoise/basin_slices/pixel_plan.hpp"
#include "equipoise/basin_slices/slice_pixel.hpp"
#include "equipoise/result_files/slice_netcdf.hpp"

namespace equipoise {

/// For each pixel along an axis the one of another axis with the same centre, to rounding; -1 where there is none.
std::vector<int> same_centres(const SliceAxis& axis, const SliceAxis& other);

/// Hands on what was computed in the map of file `from` at centres of a map with this header, unless `plan` knows it.
/// Throws InputError if it is no map of the same study, keys and ties.
void reused_pixels(const std::string& from, const io::SliceFileHeader& header, const PixelPlan& plan,
                   const TakePixels& take);

}  // namespace equipoise
