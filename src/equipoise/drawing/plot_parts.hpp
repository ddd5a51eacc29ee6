// What all pictures share: colours, labels, canvas.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "equipoise/study/study.hpp"

namespace equipoise {

/// "#rrggbb" of an attractor by identifier, or of undecided_code and its like: the same in all pictures.
const char* colour_of(int code);

/// A text for gnuplot, which reads nothing into it.
std::string quoted(const std::string& text);

/// "eccentricity λ / race radius" and its like; the key itself for quantities without a name here.
std::string axis_label(const std::string& key);

/// "2 balls, μ = 0.05, ..., Ω = 2.4" without the quantities that `varied` names.
std::string parameters_text(const Study& study, const std::vector<std::string>& varied);

/// Encoding, terminal and output of a script that draws into `path` (.png or .svg). Sizes in pixels.
std::string canvas(const std::string& path, int width, int height);

/// Thin borders left and below, quiet grid.
extern const char* const quiet_frame;

/// Viridis (S. van der Walt, N. Smith, 2015), from none to all, in even steps: by it any kind of colour vision, and a
/// greyscale print, tells more from less.
inline constexpr std::array viridis{"#440154", "#472c7a", "#3b518b", "#2c718e", "#21908d",
                                    "#27ad81", "#5cc863", "#aadc32", "#fde725"};
/// Of a share from 0 to 1 on that scale, "#rrggbb".
std::string heat_colour(double share);

/// Two colours that any kind of colour vision, and a greyscale print, tells apart.
inline constexpr const char* dark_colour = "#0072B2";
inline constexpr const char* light_colour = "#E69F00";

}  // namespace equipoise
