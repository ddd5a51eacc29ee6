// Processor time of this process.
#pragma once

#include <ctime>

namespace equipoise {

/// Over all of its threads, in seconds from some moment before the process began.
inline double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace equipoise
