// The word by which a caller asks running work to stop.
#pragma once

#include <atomic>

namespace equipoise {

/// Set it (from a signal handler, another thread) and running work ends soon, keeping what is done.
using StopFlag = std::atomic<bool>;

}  // namespace equipoise
