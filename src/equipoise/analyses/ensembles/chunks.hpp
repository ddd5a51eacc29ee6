// Starts computed in chunks on all threads, and passed on in index order.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "equipoise/analyses/ensembles/chunk_size.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/core/base/error.hpp"

namespace equipoise {

struct Chunk : Decided {
  std::uint64_t first = 0;
  std::size_t count = 0;
  bool complete = false;

  const TransientRow* row(std::size_t place) const { return transients.empty() ? nullptr : &transients[place]; }
};

class ChunkQueue;

/// Threads of other work that decide chunks of running ensembles. Thread-safe.
class ChunkHelp {
 public:
  virtual ~ChunkHelp() = default;
  /// They may work off the queue's chunks until close() returns, which waits for those being decided.
  virtual void open(ChunkQueue& queue) = 0;
  virtual void close(ChunkQueue& queue) = 0;
};

struct ChunkWork {
  std::function<bool(Chunk&)> decide;  ///< fills a chunk in; thread-safe; false if stopped early
  int threads = 1;
  const StopFlag* stop = nullptr;
  ChunkHelp* help = nullptr;
};

using ChunkSink = std::function<void(const std::shared_ptr<Chunk>&)>;

/// The chunks of an ensemble: threads take, decide and hand them in; they are passed on in index order. Thread-safe.
class ChunkQueue {
 public:
  /// Starts first .. limit - 1, or fewer once `finished` or `lost` is set.
  ChunkQueue(const ChunkWork& work, std::uint64_t first, std::uint64_t limit, const std::atomic<bool>& finished,
             std::atomic<bool>& lost, const ChunkSink& sink);

  /// Takes a chunk, decides it and hands it in. False if there is no chunk now or, with `wait`, if no more will come.
  /// An exception from deciding ends the work of all threads.
  bool work_off(bool wait);

  bool passed_all() const { return passed_ >= limit_; }

 private:
  std::shared_ptr<Chunk> take(bool wait);
  std::shared_ptr<Chunk> there();
  void hand_in(const std::shared_ptr<Chunk>& chunk);
  void pass_on(std::unique_lock<std::mutex>& lock);

  const ChunkWork& work_;
  const std::uint64_t limit_;
  const std::atomic<bool>& finished_;
  std::atomic<bool>& lost_;
  const ChunkSink& sink_;
  ChunkSize size_;
  const std::size_t most_open_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t next_, passed_;                              // index of the next start to hand out; starts passed on
  std::size_t out_ = 0;                                      // chunks handed out
  std::map<std::uint64_t, std::shared_ptr<Chunk>> decided_;  // waiting for earlier chunks
  bool passing_ = false;
};

/// Decides starts first .. limit - 1, or fewer once `finished` or `lost` is set. `sink` gets the chunks in order. Sets
/// `lost` if it ends before the limit without `finished`.
void compute_chunks(const ChunkWork& work, std::uint64_t first, std::uint64_t limit, const std::atomic<bool>& finished,
                    std::atomic<bool>& lost, const ChunkSink& sink);

/// Decides starts 0 .. count - 1 and hands the chunks over in order. A stop ends that at the first one that is not
/// complete. False if not all were handed over.
bool take_chunks(const ChunkWork& work, std::uint64_t count, const std::function<void(Chunk&)>& take);

}  // namespace equipoise
