// Detects series of events at one time that never end.
#pragma once

#include <algorithm>
#include <cmath>

namespace equipoise {

class EventCount {
 public:
  /// Counts an event at `time`. False after too many at one time: no sequence of events then describes the balls, and
  /// the trajectory is given up.
  bool add(double time) {
    at_once_ = time - last_ > 1e-12 * std::max(1.0, time) ? 0 : at_once_ + 1;
    last_ = time;
    return at_once_ <= most_at_once;
  }

  /// Factor on friction's limit: 1, but less by rounding where friction holds and lets go by turns at one time.
  double hold() const { return at_once_ == 0 ? 1.0 : 1.0 - std::ldexp(1e-14, std::min(at_once_, 20)); }

 private:
  static constexpr int most_at_once = 200;
  double last_ = -1.0;
  int at_once_ = 0;
};

}  // namespace equipoise
