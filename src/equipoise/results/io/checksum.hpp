// A checksum that detects damaged files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace equipoise::io {

/// A 64-bit sum over bytes. Every step is one to one in the sum so far: texts of one length that differ in a single
/// 8-byte word never share a sum. Others do so by chance, once in 2^64.
class Checksum {
 public:
  void add(const void* data, std::size_t size) {
    const char* bytes = static_cast<const char*>(data);
    length_ += size;
    while (size > 0) {
      const std::size_t part = size < 8 - filled_ ? size : 8 - filled_;
      std::memcpy(word_ + filled_, bytes, part);
      bytes += part;
      size -= part;
      filled_ += part;
      if (filled_ < 8) return;
      mix();
      for (; size >= 8; bytes += 8, size -= 8) {
        std::memcpy(word_, bytes, 8);
        mix();
      }
    }
  }

  /// Of all bytes so far.
  std::uint64_t value() const {
    Checksum rest = *this;
    std::memset(rest.word_ + rest.filled_, 0, 8 - rest.filled_);
    rest.mix();
    std::memcpy(rest.word_, &length_, 8);
    rest.mix();
    return rest.sum_;
  }

 private:
  // Multiplication by an odd number and the shifted exclusive or are both invertible.
  void mix() {
    std::uint64_t word = 0;
    std::memcpy(&word, word_, 8);
    sum_ = (sum_ ^ word) * 0x9E3779B97F4A7C15u;
    sum_ ^= sum_ >> 32;
    filled_ = 0;
  }

  std::uint64_t sum_ = 0x243F6A8885A308D3u, length_ = 0;
  char word_[8] = {};
  std::size_t filled_ = 0;
};

}  // namespace equipoise::io
