// Threads by oneTBB.
#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "equipoise/running/parallel.hpp"

namespace equipoise {

namespace {

using Arena = std::unique_ptr<tbb::task_arena>;

// Idle arenas by number of threads. oneTBB 2021.8 leaks kilobytes with every destroyed arena (its issue 967), so arenas
// are reused. This object is never destroyed, since threads may still work while the process ends.
class IdleArenas {
 public:
  static IdleArenas& all() {
    static IdleArenas& idle = *new IdleArenas;
    return idle;
  }

  Arena take(int threads) {
    const std::lock_guard guard(mutex_);
    std::vector<Arena>& idle = by_threads_[threads];
    if (idle.empty()) return std::make_unique<tbb::task_arena>(threads);
    Arena arena = std::move(idle.back());
    idle.pop_back();
    return arena;
  }
  void give_back(int threads, Arena arena) {
    const std::lock_guard guard(mutex_);
    by_threads_[threads].push_back(std::move(arena));
  }

 private:
  std::mutex mutex_;
  std::map<int, std::vector<Arena>> by_threads_;
};

}  // namespace

int core_count() { return tbb::info::default_concurrency(); }

void in_parallel(int asked, std::size_t count, const std::function<void(std::size_t)>& body) {
  const int threads =
      static_cast<int>(std::clamp<std::size_t>(count, 1, static_cast<std::size_t>(thread_count(asked))));
  Arena arena = IdleArenas::all().take(threads);  // an exception abandons it
  arena->execute([&] { tbb::parallel_for(std::size_t{0}, count, body, tbb::simple_partitioner()); });
  IdleArenas::all().give_back(threads, std::move(arena));
}

}  // namespace equipoise
