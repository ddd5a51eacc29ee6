// Progress on standard error: a bar on a terminal, plain lines elsewhere, nothing when quiet.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace equipoise::app {

class ProgressLine {
 public:
  enum class Style { none, bar, lines };
  /// Bar if standard error is a terminal, else lines; none if `quiet`.
  explicit ProgressLine(bool quiet);
  ~ProgressLine();

  /// `total` 0: not known. `detail`: shown at the end of the line.
  void update(std::uint64_t done, std::uint64_t total, const std::string& detail);
  /// Clears the bar, so that what follows starts on a clean line.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  Style style_;
  bool shown_ = false, counting_ = false;
  std::uint64_t first_ = 0;
  Clock::time_point begin_, last_;
};

}  // namespace equipoise::app
