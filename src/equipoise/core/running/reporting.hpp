// Work on its own thread, with reports on the thread that requested it.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>

#include "equipoise/core/running/run_options.hpp"

namespace equipoise {

/// One call's callbacks.
class Reporting {
 public:
  explicit Reporting(const RunOptions& asked) : asked_(asked) {}

  /// Runs `work` on another thread and serves its reports on this one until it is done. Rethrows exceptions of both.
  void run(const std::function<void()>& work);

  // For the work, from any of its threads.
  const StopFlag* stop() const { return &stop_; }
  void call(const std::function<void()>& callback);  ///< on the thread that asked; returns when it has

 private:
  void work_along(const std::function<void()>& work);
  void answer(std::unique_lock<std::mutex>& lock);
  void heed_stop();
  template <class Call>
  void guarded(const Call& call);

  const RunOptions& asked_;
  StopFlag stop_{false};
  std::mutex telling_, mutex_;
  std::condition_variable changed_, answered_;
  const std::function<void()>* told_ = nullptr;
  bool done_ = false;
  std::exception_ptr failure_, refusal_;  // of the work; of a callback
};

/// Runs work(options) with its callbacks called on this thread. `Options` is RunOptions or derives from it. The work
/// gets a copy whose callbacks may be called from any thread, one at a time.
template <class Options, class Work>
auto reported(const Options& options, const Work& work) {
  if (!options.progress && !options.stop_asked && !options.notice) return work(options);
  Reporting reporting(options);
  Options inner = options;
  inner.stop = reporting.stop();
  inner.stop_asked = nullptr;
  if (options.progress) inner.progress = [&](const Progress& p) { reporting.call([&] { options.progress(p); }); };
  if (options.notice) inner.notice = [&](const std::string& s) { reporting.call([&] { options.notice(s); }); };
  std::optional<decltype(work(inner))> result;
  reporting.run([&] { result.emplace(work(inner)); });
  return std::move(*result);
}

}  // namespace equipoise
