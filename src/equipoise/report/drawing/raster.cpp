// PNG with a palette: header, colours, rows compressed by repetition of the square before and of the row before.
#include "equipoise/report/drawing/raster.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <utility>

#include "equipoise/report/words/plots.hpp"

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

// One block of deflate with its fixed codes (RFC 1951, 3.2.6).
class Deflate {
 public:
  Deflate() { add_bits(3, 3); }  // the last block; fixed codes

  void literal(unsigned char byte) {
    if (byte < 144)
      add_code(0x30u + byte, 8);
    else
      add_code(0x190u + byte - 144u, 9);
  }
  void repeat(std::size_t length, std::size_t distance) {
    constexpr std::uint32_t longest = 258 - 3;
    const auto more = static_cast<std::uint32_t>(length - 3), back = static_cast<std::uint32_t>(distance - 1);
    const int of_length = more == longest ? 0 : extra_bits(more, 3);
    const std::uint32_t step = more == longest ? 28 : 4u * static_cast<std::uint32_t>(of_length) + (more >> of_length);
    if (step < 23)
      add_code(step + 1, 7);
    else
      add_code(0xC0u + step - 23u, 8);
    add_bits(more & ((1u << of_length) - 1u), of_length);
    const int of_distance = extra_bits(back, 2);
    add_code(2u * static_cast<std::uint32_t>(of_distance) + (back >> of_distance), 5);
    add_bits(back & ((1u << of_distance) - 1u), of_distance);
  }
  std::string end() {
    add_code(0, 7);
    add_bits(0, 7);  // the last byte is filled up
    return std::move(out_);
  }

 private:
  // Of a length or distance whose first bits are in its code.
  static int extra_bits(std::uint32_t value, int first) {
    return std::max(static_cast<int>(std::bit_width(value)) - first, 0);
  }
  void add_bits(std::uint32_t bits, int count) {
    held_ |= bits << filled_;
    for (filled_ += count; filled_ >= 8; filled_ -= 8, held_ >>= 8) out_ += static_cast<char>(held_ & 255u);
  }
  void add_code(std::uint32_t code, int length) {  // from its first bit
    for (int k = length - 1; k >= 0; --k) add_bits(code >> k & 1u, 1);
  }

  std::string out_;
  std::uint32_t held_ = 0;
  int filled_ = 0;
};

// zlib's format (RFC 1950). `row`: bytes of one.
std::string compressed(const std::string& bytes, std::size_t row) {
  constexpr std::size_t least = 3, most = 258, farthest = 32768;
  Deflate deflate;
  const auto alike = [&](std::size_t at, std::size_t distance) {
    std::size_t length = 0;
    if (distance <= std::min(at, farthest))
      while (length < most && at + length < bytes.size() && bytes[at + length] == bytes[at + length - distance])
        ++length;
    return length;
  };
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t before = alike(at, 1), above = alike(at, row), length = std::max(before, above);
    if (length < least) {
      deflate.literal(static_cast<unsigned char>(bytes[at++]));
    } else {
      deflate.repeat(length, before >= above ? 1 : row);
      at += length;
    }
  }
  std::string out = "\x78\x01" + deflate.end();
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
  const std::string rows = packed_rows(r, halves);
  add_chunk(out, "IDAT", compressed(rows, rows.size() / r.height));
  add_chunk(out, "IEND", "");
  return out;
}

}  // namespace equipoise
