// The word by which a caller asks running work to stop.
#pragma once

#include <atomic>

namespace equipoise {

/// Set it (from a signal handler, another thread) and running work ends soon, keeping what is done.
using StopFlag = std::atomic<bool>;

/// Whether work with this flag, or with none, is to stop.
inline bool is_set(const StopFlag* stop) { return stop && stop->load(std::memory_order_relaxed); }

}  // namespace equipoise
