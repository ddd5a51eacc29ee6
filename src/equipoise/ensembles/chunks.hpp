// Starts computed a chunk at a time, on all threads, and handed on in the order of their numbers.
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

#include "equipoise/base/error.hpp"
#include "equipoise/ensembles/chunk_size.hpp"
#include "equipoise/start_runs/start_runner.hpp"

namespace equipoise {

struct Chunk : Decided {
  std::uint64_t first = 0;
  std::size_t count = 0;
  bool complete = false;
  /// Decided by another process: of unlisted starts place and state are all there is, and there are no angles.
  bool from_elsewhere = false;

  const TransientRow* row(std::size_t place) const { return transients.empty() ? nullptr : &transients[place]; }
};

class ChunkQueue;

/// Others who decide chunks of an ensemble while it is at work.
class ChunkHelp {
 public:
  virtual ~ChunkHelp() = default;
  /// The queue may be asked for chunks until close() returns, which waits for those who are at one.
  virtual void open(ChunkQueue& queue) = 0;
  virtual void close() = 0;
};

/// What chunks are computed with.
struct ChunkWork {
  std::function<bool(Chunk&)> decide;  ///< fills a chunk in; thread-safe; false if stopped early
  int threads = 1;
  const StopFlag* stop = nullptr;
  ChunkHelp* help = nullptr;
};

using ChunkSink = std::function<void(const std::shared_ptr<Chunk>&)>;

/// The chunks of an ensemble: who takes one decides it and hands it in; they are passed on in order. From any thread.
class ChunkQueue {
 public:
  /// Starts first .. limit - 1, or fewer once `finished` or `lost` is set.
  ChunkQueue(const ChunkWork& work, std::uint64_t first, std::uint64_t limit, const std::atomic<bool>& finished,
             std::atomic<bool>& lost, const ChunkSink& sink);

  /// Takes a chunk, decides it and hands it in. False if there is none to be had: with `wait`, none any more. What
  /// deciding throws ends the work of all.
  bool work_off(bool wait);

  /// For those who decide it elsewhere: a chunk that nobody has, or null.
  std::shared_ptr<Chunk> lend();
  /// Back from there: decided, or else (no fates) for somebody else to decide.
  void give_back(const std::shared_ptr<Chunk>& chunk);

  bool passed_all() const { return passed_ >= limit_; }

 private:
  enum class Taker { waiting, passing_by, lending };
  std::shared_ptr<Chunk> take(Taker taker);
  std::shared_ptr<Chunk> there(Taker taker);
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
  std::uint64_t next_, passed_;                              // starts given out; starts passed on
  std::size_t out_ = 0;                                      // chunks that somebody has
  std::vector<std::shared_ptr<Chunk>> back_;                 // given back, and not handed in yet
  std::map<std::uint64_t, std::shared_ptr<Chunk>> decided_;  // waiting for those before
  bool passing_ = false;
};

/// Decides starts first .. limit - 1, or fewer once `finished` or `lost` is set; `sink` gets the chunks in order. Sets
/// `lost` where it ends before the limit without having finished.
void compute_chunks(const ChunkWork& work, std::uint64_t first, std::uint64_t limit, const std::atomic<bool>& finished,
                    std::atomic<bool>& lost, const ChunkSink& sink);

}  // namespace equipoise
