// How a result was computed: threads, instruction set, time.
#pragma once

#include <chrono>
#include <ctime>
#include <string>

namespace equipoise {

/// Processor time of this process, over all of its threads, in seconds from some moment before it began.
inline double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct RunTime {
  double seconds = 0.0, cpu_seconds = 0.0;
};

/// Results of long calls have this as a base. Times are of one call, without those of earlier runs whose results it
/// found in a file.
struct RunInfo : RunTime {
  int threads = 1;
  std::string cpu_target;

  void took(const RunTime& time) { static_cast<RunTime&>(*this) = time; }
};

/// Measures the time since it was made.
class RunClock {
 public:
  RunTime time() const {
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(),
            cpu_seconds() - cpu_begin_};
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double cpu_begin_ = cpu_seconds();
};

}  // namespace equipoise
