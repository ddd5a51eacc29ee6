// Colours, labels and canvas that all pictures share.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "equipoise/study/study.hpp"

namespace equipoise {

/// "#rrggbb" of an attractor by its identifier, or of a code such as undecided_code: the same in all pictures.
const char* colour_of(int code);

/// Text quoted for gnuplot, which then does not interpret it.
std::string quoted(const std::string& text);

/// "eccentricity λ / race radius" and so on; the key itself if it has no name here.
std::string axis_label(const std::string& key);

/// "2 balls, μ = 0.05, ..., Ω = 2.4", without the quantities named in `varied`.
std::string parameters_text(const Study& study, const std::vector<std::string>& varied);

/// Encoding, terminal and output of a script that draws into `path` (.png or .svg). Sizes in pixels.
std::string canvas(const std::string& path, int width, int height);

/// Thin borders left and below, quiet grid.
extern const char* const quiet_frame;

/// Viridis (S. van der Walt, N. Smith, 2015) in even steps from none to all: any kind of colour vision, and a greyscale
/// print, shows which is more.
inline constexpr std::array viridis{"#440154", "#472c7a", "#3b518b", "#2c718e", "#21908d",
                                    "#27ad81", "#5cc863", "#aadc32", "#fde725"};
/// Colour "#rrggbb" of a share from 0 to 1 on that scale.
std::string heat_colour(double share);

/// Two colours that are distinct for any kind of colour vision and in a greyscale print.
inline constexpr const char* dark_colour = "#0072B2";
inline constexpr const char* light_colour = "#E69F00";

}  // namespace equipoise
