// Progress on standard error: a bar on a terminal, plain lines elsewhere, nothing when quiet.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>

#include "equipoise/base/run_options.hpp"

namespace equipoise::app {

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

 private:
  using Clock = std::chrono::steady_clock;
  Style style_;
  void update(const Progress& progress);

  bool shown_ = false;
  std::optional<Progress> before_;
  std::uint64_t first_ = 0;
  Clock::time_point begin_, last_;
};

}  // namespace equipoise::app
