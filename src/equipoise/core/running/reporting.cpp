// Two threads that hand each other a report and its answer.
#include "equipoise/core/running/reporting.hpp"

#include <chrono>
#include <thread>

namespace equipoise {

namespace {
// Interval between checks of the stop request.
constexpr std::chrono::milliseconds patience{50};
}  // namespace

// An exception from a callback ends the work; callbacks are not called again.
template <class Call>
void Reporting::guarded(const Call& call) {
  if (refusal_) return;
  try {
    call();
  } catch (...) {
    refusal_ = std::current_exception();
    stop_ = true;
  }
}

void Reporting::heed_stop() {
  if (is_set(asked_.stop)) stop_ = true;
}

void Reporting::answer(std::unique_lock<std::mutex>& lock) {
  lock.unlock();
  guarded(*told_);
  heed_stop();  // the callback may have set it
  lock.lock();
  told_ = nullptr;
  answered_.notify_one();
}

void Reporting::work_along(const std::function<void()>& work) {
  try {
    work();
  } catch (...) {
    failure_ = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  done_ = true;
  changed_.notify_one();
}

void Reporting::run(const std::function<void()>& work) {
  heed_stop();
  std::thread worker([&] { work_along(work); });
  auto last_asked = std::chrono::steady_clock::now();
  for (std::unique_lock lock(mutex_); !done_;) {
    changed_.wait_for(lock, patience, [&] { return done_ || told_; });
    if (told_) answer(lock);
    if (done_ || std::chrono::steady_clock::now() - last_asked < patience) continue;
    last_asked = std::chrono::steady_clock::now();
    lock.unlock();
    heed_stop();
    if (asked_.stop_asked) guarded([&] { stop_ = stop_ || asked_.stop_asked(); });
    lock.lock();
  }
  worker.join();
  if (refusal_) std::rethrow_exception(refusal_);
  if (failure_) std::rethrow_exception(failure_);
}

void Reporting::call(const std::function<void()>& callback) {
  const std::lock_guard one_at_a_time(telling_);
  std::unique_lock lock(mutex_);
  told_ = &callback;
  changed_.notify_one();
  answered_.wait(lock, [&] { return !told_; });
}

}  // namespace equipoise
