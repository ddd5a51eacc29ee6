// Parallel work: the only interface to threads for the library's rooms.
// This room: threads, deadlines, progress, the log of an interrupted search.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

namespace equipoise {

/// Cores available for work; 1 in a build without threads.
int core_count();
/// The number requested, but at most 16 or four per core, since more are of no use; all cores for 0.
inline int thread_count(int asked) {
  constexpr int often_enough = 16, per_core = 4;
  return asked > 0 ? std::min(asked, std::max(often_enough, per_core * core_count())) : core_count();
}

/// Calls body(i) once for every i in [0, count), on at most `threads` threads in no particular order, and returns when
/// all are done. An exception in a body ends the work and leaves this call. Calls may be nested. Throws RunError if the
/// system cannot make the threads.
void in_parallel(int threads, std::size_t count, const std::function<void(std::size_t)>& body);

}  // namespace equipoise
