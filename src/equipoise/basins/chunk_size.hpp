// How many starts a thread takes at a time.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace equipoise {

/// Large enough that lanes seldom wait for a chunk's last trajectory, small enough that every thread gets many and that
/// none takes much longer than a second: what is complete is in the file soon. A machine's starts ride in no lanes and
/// take milliseconds each. Results depend on none of this.
class ChunkSize {
 public:
  ChunkSize(std::uint64_t starts, int threads, bool machine)
      : least_(machine ? 4 : 256),
        most_(std::clamp<std::uint64_t>(starts / (16 * static_cast<std::uint64_t>(threads)), least_,
                                        machine ? 128 : 8192)) {}

  std::uint64_t next() const {
    const double pace = pace_.load(std::memory_order_relaxed);
    return pace > 0.0 ? std::clamp(static_cast<std::uint64_t>(1.0 / pace), least_, most_) : least_;
  }
  void took(std::size_t starts, double seconds) { pace_ = seconds / static_cast<double>(starts); }

 private:
  std::uint64_t least_, most_;
  std::atomic<double> pace_{0.0};  // seconds a start, of the chunk that ended last
};

}  // namespace equipoise
