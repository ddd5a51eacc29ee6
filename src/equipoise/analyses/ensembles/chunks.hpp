// Starts computed in chunks on all threads, and passed on in index order.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/core/base/error.hpp"

namespace equipoise {

struct Chunk : Decided {
  std::uint64_t first = 0;
  std::size_t count = 0;
  bool complete = false;

  const TransientRow* row(std::size_t place) const { return transients.empty() ? nullptr : &transients[place]; }
};

/// How many starts a thread takes at a time: large enough that lanes seldom wait for a chunk's last trajectory, small
/// enough that every thread gets many chunks and none takes much over a second, so that finished starts soon reach the
/// file. Results do not depend on it.
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

class ChunkQueue;

/// Ensembles at work in this process, whose starts idle threads help to decide. Callable from any thread.
class OpenEnsembles {
 public:
  /// They may work off the queue's chunks until close() returns, which waits for those being decided.
  void open(ChunkQueue& queue);
  void close(ChunkQueue& queue);
  /// Decides a chunk of one of them. False if none is available now.
  bool help();

 private:
  std::mutex mutex_;
  std::condition_variable left_;
  std::vector<ChunkQueue*> open_;
  std::map<ChunkQueue*, int> inside_;  // helpers at work
  std::size_t turn_ = 0;               // they are helped in turn
};

struct ChunkWork {
  std::function<bool(Chunk&)> decide;  ///< fills a chunk in; thread-safe; false if stopped early
  int threads = 1;
  const StopFlag* stop = nullptr;
  OpenEnsembles* help = nullptr;  ///< its idle threads; or null
};

/// Gets complete chunks in index order; false if no more are wanted.
using TakeChunk = std::function<bool(Chunk&)>;

/// The chunks of an ensemble: threads take, decide and hand them in; they are passed on in index order. Thread-safe.
class ChunkQueue {
 public:
  /// Starts first .. limit - 1.
  ChunkQueue(const ChunkWork& work, std::uint64_t first, std::uint64_t limit, const TakeChunk& take);

  /// Takes a chunk, decides it and hands it in. False if there is no chunk now or, with `wait`, if no more will come.
  /// An exception from deciding ends the work of all threads.
  bool work_off(bool wait);

  /// Whether all were passed on, or as many as were wanted.
  bool done() const { return finished_ || (whole_ && passed_ >= limit_); }

 private:
  std::shared_ptr<Chunk> take(bool wait);
  std::shared_ptr<Chunk> there();
  void hand_in(const std::shared_ptr<Chunk>& chunk);
  void pass_on(std::unique_lock<std::mutex>& lock);

  const ChunkWork& work_;
  const std::uint64_t limit_;
  const TakeChunk& take_;
  ChunkSize size_;
  const std::size_t most_open_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t next_, passed_;                              // index of the next start to hand out; starts passed on
  std::size_t out_ = 0;                                      // chunks handed out
  std::map<std::uint64_t, std::shared_ptr<Chunk>> decided_;  // waiting for earlier chunks
  bool passing_ = false, whole_ = true;                      // whole: all chunks so far were complete
  std::atomic<bool> finished_{false}, lost_{false};          // no more wanted; no more to be had
};

/// Decides starts first .. limit - 1 and passes their chunks on. A stop ends that at the first one that is not
/// complete: false.
bool take_chunks(const ChunkWork& work, std::uint64_t first, std::uint64_t limit, const TakeChunk& take);

}  // namespace equipoise
