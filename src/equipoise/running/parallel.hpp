// Work done side by side: the one face of threads that the library's rooms see.
#pragma once

#include <cstddef>
#include <functional>

namespace equipoise {

/// Cores that work may use: 1 where a build has no threads.
int core_count();
/// Threads as asked for; all cores for 0.
inline int thread_count(int asked) { return asked > 0 ? asked : core_count(); }

/// body(i) for every i in [0, count), each once, on at most `threads` threads and in no particular order; returns when
/// all are done. What a body throws ends the work, and the call throws it. May be called from within itself.
void in_parallel(int threads, std::size_t count, const std::function<void(std::size_t)>& body);

}  // namespace equipoise
