// Progress on standard error: a bar on a terminal, plain lines elsewhere, nothing when quiet.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "equipoise/core/running/run_options.hpp"

namespace equipoise::app {

/// "26 s", "3 min 05 s", "2 h 10 min".
std::string duration_text(double seconds);

/// How far a command came, and the remaining time at the current rate; empty: unknown.
struct WorkLeft {
  std::uint64_t done = 0, total = 0;  ///< total 0: `what` is a preparing stage
  std::string what;
  std::optional<double> seconds = {};
};

/// Time between two lines if standard error is not a terminal: it may be a log that somebody reads. Ten seconds, or the
/// number in the variable EQUIPOISE_PROGRESS; InputError if that is not a number from 0.1 to 86400.
std::chrono::duration<double> lines_apart();

class ProgressLine {
 public:
  enum class Style { none, bar, lines };
  /// A bar if standard error is a terminal, else lines; none if `quiet`. Receives progress and notices of calls of the
  /// library on this thread with these options, which must not outlive this object.
  ProgressLine(bool quiet, RunOptions& options);
  ~ProgressLine();

  /// Clears the bar, so that further output starts on a clean line.
  void finish();
  /// From the last report; empty without any.
  std::optional<WorkLeft> left() const;

 private:
  using Clock = std::chrono::steady_clock;
  Style style_;
  void update(const Progress& progress);
  double rate() const;

  bool shown_ = false;
  std::optional<Progress> before_;
  std::uint64_t first_ = 0;
  Clock::time_point begin_, last_, told_;
  std::chrono::duration<double> apart_;  // two bars or lines
};

}  // namespace equipoise::app
