// What all scripts for gnuplot share.
#pragma once

#include <string>

namespace equipoise::gnuplot {

/// Single quotes keep gnuplot from reading anything into a text; they are doubled inside.
inline std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

/// Terminal and output file by the ending of `path`: .svg, else PNG. Sizes in pixels.
inline std::string output(const std::string& path, int width, int height) {
  const std::string size = std::to_string(width) + "," + std::to_string(height);
  const std::string terminal =
      path.ends_with(".svg")
          ? "set terminal svg size " + size + " font 'Helvetica,22' linewidth 1.3 background '#ffffff' noenhanced\n"
          : "set terminal pngcairo size " + size + " font 'DejaVu Sans,17' linewidth 1.5 noenhanced\n";
  return "set encoding utf8\n" + terminal + "set output " + quoted(path) + "\n";
}

/// Thin borders left and below, quiet grid.
inline const char* const frame =
    "set border 3 linecolor rgb '#444444'\nset tics nomirror out textcolor rgb '#222222'\n"
    "set grid linecolor rgb '#dddddd' linewidth 0.6\n";

// Two colours that people with any kind of colour vision, and greyscale prints, tell apart (M. Okabe, K. Ito, Color
// Universal Design, 2008).
inline const char* const dark = "#0072B2";
inline const char* const light = "#E69F00";

}  // namespace equipoise::gnuplot
