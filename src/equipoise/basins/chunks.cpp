// The pipeline: numbers in, chunks decided side by side, chunks out in order.
#include "equipoise/basins/chunks.hpp"

#include <algorithm>
#include <chrono>

#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include "equipoise/basins/chunk_size.hpp"

namespace equipoise {

void compute_chunks(const ChunkWork& work, std::uint64_t first, std::uint64_t limit, const std::atomic<bool>& finished,
                    std::atomic<bool>& lost, const ChunkSink& sink) {
  ChunkSize size(limit - first, work.threads, work.machine);
  std::uint64_t next = first;
  const auto make = [&](tbb::flow_control& control) -> std::shared_ptr<Chunk> {
    const bool stop_asked = is_set(work.stop);
    if (finished || lost || stop_asked || next >= limit) {
      if (!finished && next < limit) lost = true;
      control.stop();
      return nullptr;
    }
    auto chunk = std::make_shared<Chunk>();
    chunk->first = next;
    chunk->count = static_cast<std::size_t>(std::min<std::uint64_t>(size.next(), limit - next));
    next += chunk->count;
    return chunk;
  };
  const auto decide = [&](std::shared_ptr<Chunk> chunk) {
    const auto begin = std::chrono::steady_clock::now();
    chunk->complete = !finished && work.decide(*chunk);
    size.took(chunk->count, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    return chunk;
  };
  tbb::task_arena arena(work.threads);
  arena.execute([&] {
    tbb::parallel_pipeline(
        2 * static_cast<std::size_t>(work.threads),
        tbb::make_filter<void, std::shared_ptr<Chunk>>(tbb::filter_mode::serial_in_order, make) &
            tbb::make_filter<std::shared_ptr<Chunk>, std::shared_ptr<Chunk>>(tbb::filter_mode::parallel, decide) &
            tbb::make_filter<std::shared_ptr<Chunk>, void>(tbb::filter_mode::serial_in_order, sink));
  });
}

}  // namespace equipoise
