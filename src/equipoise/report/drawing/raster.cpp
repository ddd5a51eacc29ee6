// PNG with a palette, written by libpng.
#include "equipoise/report/drawing/raster.hpp"

#include <algorithm>
#include <stdexcept>

#include <png.h>

#include "equipoise/core/base/error.hpp"

namespace equipoise {

void Raster::add(const std::string& colour) {
  if (!squares.empty() && palette[squares.back()] == colour) return squares.push_back(squares.back());
  const auto at = std::find(palette.begin(), palette.end(), colour);
  squares.push_back(static_cast<std::uint8_t>(at - palette.begin()));
  if (at == palette.end()) palette.push_back(colour);
}

std::string png_bytes(const Raster& r) {
  constexpr std::size_t most_colours = 256;
  const bool fits = !r.palette.empty() && r.palette.size() <= most_colours && r.width * r.height == r.squares.size() &&
                    !r.squares.empty() && *std::max_element(r.squares.begin(), r.squares.end()) < r.palette.size();
  if (!fits) throw std::invalid_argument("a picture's squares, size and palette do not agree");
  std::vector<png_byte> colours;
  for (const std::string& colour : r.palette)
    for (const std::size_t at : {1, 3, 5})
      colours.push_back(static_cast<png_byte>(std::stoi(colour.substr(at, 2), nullptr, 16)));
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(r.width);
  image.height = static_cast<png_uint_32>(r.height);
  image.format = PNG_FORMAT_RGB_COLORMAP;
  image.colormap_entries = static_cast<png_uint_32>(r.palette.size());
  std::string out;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  out.resize(size);
  if (!png_image_write_to_memory(&image, out.data(), &size, 0, r.squares.data(), 0, colours.data()))
    throw RunError(image.message);
  out.resize(size);
  return out;
}

}  // namespace equipoise
