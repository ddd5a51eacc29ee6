// A time limit that sets a call's stop flag.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "equipoise/core/base/stop_flag.hpp"

namespace equipoise {

/// "90", "60s", "10 min", "1.5h" in seconds. Throws InputError, naming `option`, for anything else.
double read_time_limit(const std::string& option, const std::string& text);

/// Sets the flag after `seconds`, unless it is destroyed before.
class Deadline {
 public:
  Deadline(StopFlag& stop, double seconds);
  ~Deadline();
  Deadline(const Deadline&) = delete;
  Deadline& operator=(const Deadline&) = delete;

  /// Ends the time now, unless something else has set the flag.
  void end();
  /// The time ended before anything else set the flag.
  bool over() const { return over_; }
  /// For the first of two pieces of work that only count together.
  bool half_over() const;

 private:
  using Clock = std::chrono::steady_clock;

  StopFlag& stop_;
  const Clock::time_point begin_;
  const std::chrono::duration<double> length_;
  std::atomic<bool> over_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  bool cancelled_ = false;
  std::thread clock_;
};

}  // namespace equipoise
