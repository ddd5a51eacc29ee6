// The queue: hands chunks out; they are decided side by side and passed on in order by the thread that has the next
// one.
#include "equipoise/analyses/ensembles/chunks.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <map>

#include "equipoise/core/running/parallel.hpp"

namespace equipoise {

// How many starts a thread takes at a time: large enough that lanes seldom wait for a chunk's last trajectory, small
// enough that every thread gets many chunks and none takes much over a second, so that finished starts soon reach the
// file. Results do not depend on it.
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

namespace {

// How many chunks may be ahead of the first one not passed on: two a thread, and room for helpers.
std::size_t most_open(const ChunkWork& work) {
  constexpr std::size_t of_others = 64;
  return 2 * static_cast<std::size_t>(work.threads) + (work.help ? of_others : 0);
}

}  // namespace

// Threads take, decide and hand in chunks; they are passed on in index order. Thread-safe.
class ChunkQueue {
 public:
  // Starts first .. limit - 1.
  ChunkQueue(const ChunkWork& work, std::uint64_t first, std::uint64_t limit, const TakeChunk& take)
      : work_(work),
        limit_(limit),
        take_(take),
        size_(limit - first, work.threads),
        most_open_(most_open(work)),
        next_(first),
        passed_(first) {}

  // Takes a chunk, decides it and hands it in. False if there is no chunk now or, with `wait`, if no more will come.
  // An exception ends the work of all threads.
  bool work_off(bool wait) {
    const auto chunk = take(wait);
    if (!chunk) return false;
    const auto leave = [&](bool lost) {
      const std::lock_guard guard(mutex_);
      --out_;
      if (lost) lost_ = true;
      changed_.notify_all();
    };
    try {
      const auto begin = std::chrono::steady_clock::now();
      chunk->complete = !finished_ && work_.decide(*chunk);
      size_.took(chunk->count, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
      hand_in(chunk);
    } catch (...) {
      leave(true);
      throw;
    }
    leave(false);
    return true;
  }

  // Hands nothing more out, and waits for the chunks at work. What the queue refers to may end after that.
  void close() {
    std::unique_lock lock(mutex_);
    closed_ = true;
    changed_.wait(lock, [&] { return out_ == 0; });
  }

  // Whether all were passed on, or as many as were wanted.
  bool done() const { return finished_ || (whole_ && passed_ >= limit_); }

 private:
  std::shared_ptr<Chunk> take(bool wait) {
    constexpr std::chrono::milliseconds until_a_look{20};  // between checks for a stop, which wakes no thread
    std::unique_lock lock(mutex_);
    for (;;) {
      if (finished_ || lost_ || closed_) return nullptr;
      if (is_set(work_.stop)) {
        lost_ = passed_ < limit_;
        return nullptr;
      }
      if (next_ < limit_ && decided_.size() + out_ < most_open_) {
        auto chunk = std::make_shared<Chunk>();
        chunk->first = next_;
        chunk->count = static_cast<std::size_t>(std::min<std::uint64_t>(size_.next(), limit_ - next_));
        next_ += chunk->count;
        ++out_;
        return chunk;
      }
      if (!wait || (next_ >= limit_ && out_ == 0)) return nullptr;
      changed_.wait_for(lock, until_a_look);
    }
  }

  // One thread at a time passes chunks on, including those that other threads hand in meanwhile.
  void hand_in(const std::shared_ptr<Chunk>& decided) {
    std::unique_lock lock(mutex_);
    decided_.emplace(decided->first, decided);
    if (passing_) return;
    passing_ = true;
    while (!decided_.empty() && decided_.begin()->first == passed_) {
      const auto chunk = decided_.begin()->second;
      decided_.erase(decided_.begin());
      lock.unlock();
      if (!chunk->complete && !finished_) {
        whole_ = false;
        lost_ = true;
      }
      if (whole_ && !finished_) finished_ = !take_(*chunk);
      lock.lock();
      passed_ += chunk->count;
      changed_.notify_all();
    }
    passing_ = false;
  }

  const ChunkWork& work_;
  const std::uint64_t limit_;
  const TakeChunk& take_;
  ChunkSize size_;
  const std::size_t most_open_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t next_, passed_;                              // index of the next start to hand out; starts passed on
  std::size_t out_ = 0;                                      // chunks with threads
  std::map<std::uint64_t, std::shared_ptr<Chunk>> decided_;  // waiting for earlier chunks
  bool passing_ = false, whole_ = true;                      // whole: all chunks so far were complete
  bool closed_ = false;
  std::atomic<bool> finished_{false}, lost_{false};  // no more wanted; no more to be had
};

void OpenEnsembles::open(const std::shared_ptr<ChunkQueue>& queue) {
  const std::lock_guard guard(mutex_);
  open_.push_back(queue);
}

void OpenEnsembles::close(const std::shared_ptr<ChunkQueue>& queue) {
  {
    const std::lock_guard guard(mutex_);
    std::erase(open_, queue);
  }
  queue->close();
}

bool OpenEnsembles::help() {
  std::unique_lock lock(mutex_);
  const auto queues = open_;
  const std::size_t turn = turn_++;
  lock.unlock();
  for (std::size_t k = 0; k < queues.size(); ++k)
    if (queues[(turn + k) % queues.size()]->work_off(false)) return true;
  return false;
}

bool take_chunks(const ChunkWork& work, std::uint64_t first, std::uint64_t limit, const TakeChunk& take) {
  const auto queue = std::make_shared<ChunkQueue>(work, first, limit, take);
  {
    if (work.help) work.help->open(queue);
    const std::shared_ptr<void> closing(nullptr, [&](void*) {
      if (work.help) work.help->close(queue);
    });
    in_parallel(work.threads, static_cast<std::size_t>(work.threads), [&](std::size_t) {
      while (queue->work_off(true)) {
      }
    });
  }
  return queue->done();
}

}  // namespace equipoise
