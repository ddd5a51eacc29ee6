// Colours and labels that all pictures share.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// "#rrggbb" of an attractor by its identifier, or of a code such as undecided_code: the same in all pictures.
const char* colour_of(int code);

/// "eccentricity λ / race radius" and so on; the key itself if it has no name here.
std::string axis_label(const std::string& key);
/// "rotor.unbalance (g mm)"; without a unit as above.
std::string label_with_unit(const std::string& key, const std::string& unit);

/// "2 balls, μ = 0.05, ..., Ω = 2.4", without the quantities named in `varied`.
std::string parameters_text(const Study& study, const std::vector<std::string>& varied);

/// Colour "#rrggbb" of a share from 0 to 1: any kind of colour vision, and a greyscale print, shows which is more.
std::string heat_colour(double share);
/// A colour on the way from one to another, both "#rrggbb": 0 the first, 1 the second.
std::string mixed_colour(const char* from, const char* to, double part);

/// Colours of series, distinct for any kind of colour vision; the first two, dark and light, also in a greyscale print.
inline constexpr std::array series_colours{"#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9", "#666666"};
inline constexpr const char* dark_colour = series_colours[0];
inline constexpr const char* light_colour = series_colours[1];
inline constexpr const char* chosen_colour = series_colours[3];
inline constexpr const char* grey_colour = series_colours[6];

}  // namespace equipoise
