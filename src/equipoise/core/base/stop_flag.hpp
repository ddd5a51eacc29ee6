// The flag by which a caller stops running work.
#pragma once

#include <atomic>

namespace equipoise {

/// Once set (by a signal handler or another thread), running work ends soon and keeps what is done.
using StopFlag = std::atomic<bool>;

/// Whether work with this flag should stop; never without one.
inline bool is_set(const StopFlag* stop) { return stop && stop->load(std::memory_order_relaxed); }

}  // namespace equipoise
