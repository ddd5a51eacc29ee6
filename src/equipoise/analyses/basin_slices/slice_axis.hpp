// Reads axes and links of a slice as people write them.
#pragma once

#include <cstddef>
#include <string>

#include "equipoise/core/base/error.hpp"
#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

inline constexpr char set_by_other_axis[] = "varies nothing: {}, the other axis, sets the same quantity";

/// `range`: LOW:HIGH in numbers, also parts of pi ("0:2pi", "-pi/2:pi/2"), or as quantities ("900 rpm:4000 rpm") in a
/// study with scales; empty: a whole turn for ball angles. `option` names it in errors. Throws InputError.
SliceAxis slice_axis(const Study& study, const std::string& key, const std::string& range, int pixels,
                     const std::string& option);

inline std::size_t pixels_of(const SliceAxis& x, const SliceAxis& y) {
  return static_cast<std::size_t>(x.pixels) * static_cast<std::size_t>(y.pixels);
}

/// Throws InputError about `made` ("map", "stability") if an axis has no range or a wrong number of `points`, as its
/// parts are called, or if both axes have one key.
void check_axes(const SliceAxis& x, const SliceAxis& y, const char* made, const char* points);

/// "WIDTHxHEIGHT", each 1 to 20000.
struct SliceSize {
  int width = 512, height = 512;
};
SliceSize map_size(const std::string& text, const std::string& option);

/// What a caller names the two axes and the size of a plane, and what is made of it.
struct PlaneNames {
  const char *x, *y, *size, *made;
};
/// An error of stability(), bifurcation_chart() or basin_slice() under the name that the caller gave what is wrong.
InputError under_names(const InputError& e, const SliceAxis& x, const SliceAxis& y, const PlaneNames& names);

/// "phi_2=phi_1+pi", "phi_3=phi_1".
AngleLink angle_link(const std::string& text, const std::string& option);

}  // namespace equipoise
