// A thread that waits for the end of the time limit.
#include "equipoise/core/running/deadline.hpp"

#include <string_view>
#include <utility>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/read_number.hpp"

namespace equipoise {

namespace {

constexpr double longest = 3.6e7;  // seconds; a clock in nanoseconds counts further
constexpr std::pair<std::string_view, double> time_units[] = {{"", 1.0}, {"s", 1.0}, {"min", 60.0}, {"h", 3600.0}};

}  // namespace

double read_time_limit(const std::string& option, const std::string& text) {
  double value = 0.0;
  const NumberRead read = read_number(text.data(), text.data() + text.size(), value);
  std::string_view unit(read.end, static_cast<std::size_t>(text.data() + text.size() - read.end));
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  for (const auto& [name, seconds] : time_units)
    if (read.error == std::errc() && unit == name && value > 0.0 && value * seconds <= longest) return value * seconds;
  throw InputError(option, "", display_text(text),
                   "must be a time greater than 0, at most 10000 h, in seconds or with a unit: 90, 60s, 10min, 1.5h");
}

Deadline::Deadline(StopFlag& stop, double seconds) : stop_(stop), begin_(Clock::now()), length_(seconds) {
  const auto last = begin_ + std::chrono::duration_cast<Clock::duration>(length_);
  clock_ = std::thread([this, last] {
    std::unique_lock lock(mutex_);
    if (changed_.wait_until(lock, last, [this] { return cancelled_; })) return;
    end();
  });
}

void Deadline::end() {
  // Before the flag: its reader may ask at once why it is set.
  if (!is_set(&stop_)) over_ = true;
  stop_ = true;
}

Deadline::~Deadline() {
  {
    const std::lock_guard guard(mutex_);
    cancelled_ = true;
  }
  changed_.notify_one();
  clock_.join();
}

bool Deadline::half_over() const { return Clock::now() - begin_ >= 0.5 * length_; }

}  // namespace equipoise
