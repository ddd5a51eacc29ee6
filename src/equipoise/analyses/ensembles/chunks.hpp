// Starts computed in chunks on all threads, and passed on in index order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
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

class ChunkQueue;

/// Ensembles at work in this process, whose starts idle threads help to decide. Callable from any thread.
class OpenEnsembles {
 public:
  void open(const std::shared_ptr<ChunkQueue>& queue);
  /// Returns when no helper is at the queue's chunks.
  void close(const std::shared_ptr<ChunkQueue>& queue);
  /// Decides a chunk of one of them. False if none is available now.
  bool help();

 private:
  std::mutex mutex_;
  std::vector<std::shared_ptr<ChunkQueue>> open_;
  std::size_t turn_ = 0;  // they are helped in turn
};

struct ChunkWork {
  std::function<bool(Chunk&)> decide;  ///< fills a chunk in; thread-safe; false if stopped early
  int threads = 1;
  const StopFlag* stop = nullptr;
  OpenEnsembles* help = nullptr;  ///< its idle threads; or null
};

/// Gets complete chunks in index order; false if no more are wanted.
using TakeChunk = std::function<bool(Chunk&)>;

/// Decides starts first .. limit - 1 and passes their chunks on. A stop ends that at the first one that is not
/// complete: false.
bool take_chunks(const ChunkWork& work, std::uint64_t first, std::uint64_t limit, const TakeChunk& take);

}  // namespace equipoise
