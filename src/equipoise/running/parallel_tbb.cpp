// Threads by oneTBB.
#include <algorithm>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "equipoise/base/error.hpp"
#include "equipoise/running/parallel.hpp"
#include "equipoise/words/runs.hpp"

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

// oneTBB ends the process if the system cannot make a thread, so as many are made once before.
void require_threads(int count) {
  static std::mutex mutex;
  static int made = 1;
  const std::lock_guard guard(mutex);
  if (count <= made) return;
  std::promise<void> all_made;
  const std::shared_future<void> done = all_made.get_future().share();
  std::vector<std::thread> tried;
  std::string problem;
  try {
    while (static_cast<int>(tried.size()) + 1 < count) tried.emplace_back([done] { done.wait(); });
  } catch (const std::system_error& e) {
    problem = fmt::format(words::runs::no_thread, count, tried.size() + 1, e.code().message());
  }
  all_made.set_value();
  for (std::thread& thread : tried) thread.join();
  if (!problem.empty()) throw RunError(problem);
  made = count;
}

}  // namespace

int core_count() { return tbb::info::default_concurrency(); }

void in_parallel(int asked, std::size_t count, const std::function<void(std::size_t)>& body) {
  const int threads =
      static_cast<int>(std::clamp<std::size_t>(count, 1, static_cast<std::size_t>(thread_count(asked))));
  require_threads(threads);
  Arena arena = IdleArenas::all().take(threads);  // an exception abandons it
  arena->execute([&] { tbb::parallel_for(std::size_t{0}, count, body, tbb::simple_partitioner()); });
  IdleArenas::all().give_back(threads, std::move(arena));
}

}  // namespace equipoise
