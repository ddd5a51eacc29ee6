// How many starts a thread takes at a time.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace equipoise {

/// Large enough that lanes seldom wait for a chunk's last trajectory. Small enough that every thread gets many chunks
/// and none takes much over a second, so that finished starts soon reach the file. Results do not depend on it.
class ChunkSize {
 public:
  ChunkSize(std::uint64_t starts, int threads)
      : most_(std::clamp<std::uint64_t>(starts / (16 * static_cast<std::uint64_t>(threads)), least, 8192)) {}

  std::uint64_t next() const {
    const double pace = pace_.load(std::memory_order_relaxed);
    return pace > 0.0 ? std::clamp(static_cast<std::uint64_t>(1.0 / pace), least, most_) : least;
  }
  void took(std::size_t starts, double seconds) { pace_ = seconds / static_cast<double>(starts); }

 private:
  static constexpr std::uint64_t least = 256;
  std::uint64_t most_;
  std::atomic<double> pace_{0.0};  // seconds a start, in the last finished chunk
};

}  // namespace equipoise
