// Starts computed a chunk at a time, on all threads, and handed on in the order of their numbers.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "equipoise/base/error.hpp"
#include "equipoise/fates/runner.hpp"

namespace equipoise {

struct Chunk {
  std::uint64_t first = 0;
  std::size_t count = 0;
  bool complete = false;
  std::vector<double> phi;
  std::vector<Fate> fates;
  std::vector<UnlistedStart> unlisted;
  std::vector<TransientRow> transients;  // none unless asked for

  const TransientRow* row(std::size_t place) const { return transients.empty() ? nullptr : &transients[place]; }
};

/// What chunks are computed with.
struct ChunkWork {
  std::function<bool(Chunk&)> decide;  ///< fills a chunk in; thread-safe; false if stopped early
  int threads = 1;
  bool machine = false;  ///< starts ride in no lanes
  const StopFlag* stop = nullptr;
};

using ChunkSink = std::function<void(const std::shared_ptr<Chunk>&)>;

/// Decides starts first .. limit - 1, or fewer once `finished` or `lost` is set; `sink` gets the chunks in order. Sets
/// `lost` where it ends before the limit without having finished.
void compute_chunks(const ChunkWork& work, std::uint64_t first, std::uint64_t limit, const std::atomic<bool>& finished,
                    std::atomic<bool>& lost, const ChunkSink& sink);

}  // namespace equipoise
