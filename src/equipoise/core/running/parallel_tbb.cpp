// Threads by oneTBB.
#include <algorithm>
#include <cstdlib>
#include <future>
#include <latch>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/running/parallel.hpp"

namespace equipoise {

namespace {

constexpr char no_memory_for_threads[] = "{} threads cannot run: the process is not allowed as much memory; use fewer";

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

void* allocated(std::size_t bytes) {
  void* volatile memory = std::malloc(bytes);  // volatile: no compiler leaves it out
  return memory;
}

// oneTBB ends the process if the system cannot make a thread, so as many are made once before, each with the heap that
// glibc reserves at a thread's first allocation and keeps for the next thread. If memory for two more is then left, all
// have got theirs: none takes the room of another's stack later.
void require_threads(int count) {
  static std::mutex mutex;
  static int made = 1;
  constexpr std::size_t two_heaps = std::size_t{128} << 20;
  const std::lock_guard guard(mutex);
  if (count <= made) return;
  std::promise<void> all_tried;
  const std::shared_future<void> done = all_tried.get_future().share();
  std::latch heaps(count - 1);
  std::vector<std::thread> tried;
  tried.reserve(static_cast<std::size_t>(count));
  std::string problem;
  try {
    while (static_cast<int>(tried.size()) + 1 < count)
      tried.emplace_back([done, &heaps] {
        std::free(allocated(1));
        heaps.count_down();
        done.wait();
      });
    heaps.wait();
    void* const left = allocated(two_heaps);
    if (!left) problem = fmt::format(no_memory_for_threads, count);
    std::free(left);
  } catch (const std::system_error& e) {
    problem = fmt::format("{} threads cannot run: the system makes only {} ({}); use fewer", count, tried.size() + 1,
                          e.code().message());
  } catch (const std::bad_alloc&) {
    problem = fmt::format(no_memory_for_threads, count);
  }
  all_tried.set_value();
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
