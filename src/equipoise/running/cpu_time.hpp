// How much this process has computed.
#pragma once

#include <ctime>

namespace equipoise {

/// Processor time of this process on all of its threads, in seconds from some moment before its first.
inline double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace equipoise
