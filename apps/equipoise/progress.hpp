// Progress on standard error: a bar on a terminal, plain lines elsewhere, nothing when quiet.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "equipoise/running/run_options.hpp"

namespace equipoise::app {

/// "26 s", "3 min 05 s", "2 h 10 min".
std::string duration_text(double seconds);

/// How far a command came, and how long the rest takes at the rate of late; none: not known.
struct WorkLeft {
  std::uint64_t done = 0, total = 0;  ///< total 0: `what` is a stage of what comes first
  std::string what;
  std::optional<double> seconds = {};
};

/// Between lines where standard error is no terminal: it may be a log that somebody reads.
inline constexpr std::chrono::seconds lines_apart{10};

class ProgressLine {
 public:
  enum class Style { none, bar, lines };
  /// Bar if standard error is a terminal, else lines; none if `quiet`.
  explicit ProgressLine(bool quiet);
  ~ProgressLine();

  /// What a call of the library is given to report to, on this thread; not to outlive this.
  std::function<void(const Progress&)> listener();
  /// Clears the bar, so that what follows starts on a clean line.
  void finish();
  /// By the last report; none without any.
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
};

}  // namespace equipoise::app
