// Helpers come in while a queue is open, and its owner waits for them before it goes.
#include "equipoise/analyses/sweeps/open_ensembles.hpp"

namespace equipoise {

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

}  // namespace equipoise
