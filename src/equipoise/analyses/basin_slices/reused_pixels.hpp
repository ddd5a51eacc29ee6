// Pixels available in another slice's file.
#pragma once

#include <string>
#include <vector>

#include "equipoise/analyses/basin_slices/pixel_plan.hpp"
#include "equipoise/analyses/basin_slices/slice_pixel.hpp"
#include "equipoise/results/result_files/slice_netcdf.hpp"

namespace equipoise {

/// For each pixel along an axis, the pixel of another axis with the same centre, up to rounding; -1 if there is none.
std::vector<int> same_centres(const SliceAxis& axis, const SliceAxis& other);

/// Passes on what was computed in the slice of file `from` at centres of a slice with this header, unless `plan` knows
/// it. Throws InputError if it is no slice of the same study, keys and links.
void reused_pixels(const std::string& from, const io::SliceFileHeader& header, const PixelPlan& plan,
                   const TakePixels& take);

}  // namespace equipoise
