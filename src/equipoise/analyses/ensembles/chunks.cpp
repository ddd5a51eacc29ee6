// The queue: hands chunks out; they are decided side by side and passed on in order by the thread that has the next
// one.
#include "equipoise/analyses/ensembles/chunks.hpp"

#include <algorithm>
#include <chrono>

#include "equipoise/core/running/parallel.hpp"

namespace equipoise {

namespace {

// How many chunks may be ahead of the first one not passed on: two a thread, and room for helpers.
std::size_t most_open(const ChunkWork& work) {
  constexpr std::size_t of_others = 64;
  return 2 * static_cast<std::size_t>(work.threads) + (work.help ? of_others : 0);
}

}  // namespace

ChunkQueue::ChunkQueue(const ChunkWork& work, std::uint64_t first, std::uint64_t limit, const TakeChunk& take)
    : work_(work),
      limit_(limit),
      take_(take),
      size_(limit - first, work.threads),
      most_open_(most_open(work)),
      next_(first),
      passed_(first) {}

// With the lock held: the next chunk, if one can be had now.
std::shared_ptr<Chunk> ChunkQueue::there() {
  if (next_ >= limit_ || decided_.size() + out_ >= most_open_) return nullptr;
  auto chunk = std::make_shared<Chunk>();
  chunk->first = next_;
  chunk->count = static_cast<std::size_t>(std::min<std::uint64_t>(size_.next(), limit_ - next_));
  next_ += chunk->count;
  ++out_;
  return chunk;
}

std::shared_ptr<Chunk> ChunkQueue::take(bool wait) {
  constexpr std::chrono::milliseconds until_a_look{20};  // between checks for a stop, which wakes no thread
  std::unique_lock lock(mutex_);
  for (;;) {
    if (finished_ || lost_) return nullptr;
    if (is_set(work_.stop)) {
      lost_ = passed_ < limit_;
      return nullptr;
    }
    if (auto chunk = there()) return chunk;
    if (!wait || (next_ >= limit_ && out_ == 0)) return nullptr;
    changed_.wait_for(lock, until_a_look);
  }
}

bool ChunkQueue::work_off(bool wait) {
  const auto chunk = take(wait);
  if (!chunk) return false;
  try {
    const auto begin = std::chrono::steady_clock::now();
    chunk->complete = !finished_ && work_.decide(*chunk);
    size_.took(chunk->count, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    hand_in(chunk);
  } catch (...) {
    lost_ = true;
    throw;
  }
  return true;
}

void ChunkQueue::hand_in(const std::shared_ptr<Chunk>& chunk) {
  std::unique_lock lock(mutex_);
  --out_;
  decided_.emplace(chunk->first, chunk);
  if (!passing_) pass_on(lock);
  changed_.notify_all();
}

// One thread at a time passes chunks on, including those that other threads hand in meanwhile.
void ChunkQueue::pass_on(std::unique_lock<std::mutex>& lock) {
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
  }
  passing_ = false;
}

void OpenEnsembles::open(ChunkQueue& queue) {
  const std::lock_guard guard(mutex_);
  open_.push_back(&queue);
}

void OpenEnsembles::close(ChunkQueue& queue) {
  std::unique_lock lock(mutex_);
  std::erase(open_, &queue);
  left_.wait(lock, [&] { return inside_[&queue] == 0; });
  inside_.erase(&queue);
}

bool OpenEnsembles::help() {
  struct Inside {
    OpenEnsembles& all;
    ChunkQueue& queue;
    std::unique_lock<std::mutex>& lock;
    ~Inside() {
      lock.lock();
      --all.inside_[&queue];
      all.left_.notify_all();
    }
  };
  std::unique_lock lock(mutex_);
  for (std::size_t tries = open_.size(); tries > 0 && !open_.empty(); --tries) {
    ChunkQueue& queue = *open_[turn_++ % open_.size()];
    ++inside_[&queue];
    lock.unlock();
    const Inside leaving{*this, queue, lock};
    if (queue.work_off(false)) return true;
  }
  return false;
}

namespace {

// Makes helpers leave before the queue is destroyed.
class Opened {
 public:
  Opened(OpenEnsembles* help, ChunkQueue& queue) : help_(help), queue_(queue) {
    if (help_) help_->open(queue_);
  }
  ~Opened() {
    if (help_) help_->close(queue_);
  }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

 private:
  OpenEnsembles* help_;
  ChunkQueue& queue_;
};

}  // namespace

bool take_chunks(const ChunkWork& work, std::uint64_t first, std::uint64_t limit, const TakeChunk& take) {
  ChunkQueue queue(work, first, limit, take);
  {
    const Opened opened(work.help, queue);
    in_parallel(work.threads, static_cast<std::size_t>(work.threads), [&](std::size_t) {
      while (queue.work_off(true)) {
      }
    });
  }
  return queue.done();
}

}  // namespace equipoise
