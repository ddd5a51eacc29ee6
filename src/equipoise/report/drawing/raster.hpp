// A picture of coloured squares as a PNG file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace equipoise {

/// Rows from the top, each of `width` indices into the palette; colours "#rrggbb", 1 to 256 of them.
struct Raster {
  std::size_t width = 0, height = 0;
  std::vector<std::string> palette;
  std::vector<std::uint8_t> squares;

  /// The next square.
  void add(const std::string& colour);
};

/// The bytes of a PNG file (ISO/IEC 15948). Throws std::invalid_argument if the sizes disagree.
std::string png_bytes(const Raster& raster);

}  // namespace equipoise
