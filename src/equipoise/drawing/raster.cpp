// PNG with a palette: header, colours, rows in stored blocks of deflate (RFC 1950, RFC 1951).
#include "equipoise/drawing/raster.hpp"

#include <algorithm>
#include <stdexcept>

#include "equipoise/words/plots.hpp"

namespace equipoise {

namespace {

void add_big_endian(std::string& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift & 255u);
}

std::uint32_t crc32(const std::string& bytes) {
  std::uint32_t sum = ~0u;
  for (const char c : bytes) {
    sum ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (sum & 1u ? 0xEDB88320u : 0u);
  }
  return ~sum;
}

std::uint32_t adler32(const std::string& bytes) {
  constexpr std::uint32_t prime = 65521;
  std::uint32_t a = 1, b = 0;
  for (const char c : bytes) {
    a = (a + static_cast<unsigned char>(c)) % prime;
    b = (b + a) % prime;
  }
  return b << 16 | a;
}

void add_chunk(std::string& out, const std::string& name, const std::string& content) {
  add_big_endian(out, static_cast<std::uint32_t>(content.size()));
  out += name + content;
  add_big_endian(out, crc32(name + content));
}

std::string stored(const std::string& bytes) {
  constexpr std::size_t most = 65535;
  std::string out = "\x78\x01";
  for (std::size_t at = 0; at < bytes.size() || at == 0; at += most) {
    const std::size_t size = std::min(most, bytes.size() - at);
    out += at + size == bytes.size() ? '\1' : '\0';
    for (const std::size_t word : {size, most - size})
      for (const int shift : {0, 8}) out += static_cast<char>(word >> shift & 255u);
    out.append(bytes, at, size);
  }
  add_big_endian(out, adler32(bytes));
  return out;
}

// Each row follows the number of its filter, 0: none.
std::string packed_rows(const Raster& r, bool halves) {
  std::string rows;
  for (std::size_t row = 0; row < r.height; ++row) {
    rows += '\0';
    const std::uint8_t* squares = r.squares.data() + row * r.width;
    for (std::size_t k = 0; k < r.width; k += halves ? 2 : 1) {
      const unsigned second = halves && k + 1 < r.width ? squares[k + 1] : 0u;
      rows += static_cast<char>(halves ? squares[k] << 4 | second : squares[k]);
    }
  }
  return rows;
}

}  // namespace

std::string png_bytes(const Raster& r) {
  constexpr std::size_t most_colours = 256;
  const bool fits = !r.palette.empty() && r.palette.size() <= most_colours && r.width * r.height == r.squares.size() &&
                    !r.squares.empty() && *std::max_element(r.squares.begin(), r.squares.end()) < r.palette.size();
  if (!fits) throw std::invalid_argument(words::plots::squares_disagree);
  const bool halves = r.palette.size() <= 16;
  std::string header, colours;
  add_big_endian(header, static_cast<std::uint32_t>(r.width));
  add_big_endian(header, static_cast<std::uint32_t>(r.height));
  header += halves ? '\4' : '\10';
  header += '\3';  // with a palette
  header.append(3, '\0');
  for (const std::string& colour : r.palette)
    for (const std::size_t at : {1, 3, 5}) colours += static_cast<char>(std::stoi(colour.substr(at, 2), nullptr, 16));
  std::string out = "\x89PNG\r\n\x1a\n";
  add_chunk(out, "IHDR", header);
  add_chunk(out, "PLTE", colours);
  add_chunk(out, "IDAT", stored(packed_rows(r, halves)));
  add_chunk(out, "IEND", "");
  return out;
}

}  // namespace equipoise
