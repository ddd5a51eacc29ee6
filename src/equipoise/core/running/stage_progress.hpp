// Progress through the stages of a preparation, reported in order from any thread.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <utility>

#include "equipoise/core/running/run_options.hpp"

namespace equipoise {

class StageProgress {
 public:
  /// `work`: what the stages belong to. `tell` may be empty.
  StageProgress(std::string work, std::function<void(const Progress&)> tell)
      : work_(std::move(work)), tell_(std::move(tell)) {}

  /// Begins a stage that counts up to `total` (0: unknown). A stage with the same name continues its count.
  void begin(const std::string& stage, std::uint64_t total = 0) {
    if (!tell_) return;
    const std::lock_guard lock(mutex_);
    const std::string what = work_ + ": " + stage;
    const bool goes_on = what == now_.what;
    now_ = {goes_on ? now_.done : 0, total > 0 && goes_on ? now_.done + total : total, what, {}, true};
    tell_(now_);
  }
  void add(std::uint64_t done) {
    if (!tell_) return;
    const std::lock_guard lock(mutex_);
    now_.done += done;
    tell_(now_);
  }

 private:
  const std::string work_;
  const std::function<void(const Progress&)> tell_;
  std::mutex mutex_;
  Progress now_;
};

}  // namespace equipoise
