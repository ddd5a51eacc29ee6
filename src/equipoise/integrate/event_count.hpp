// Events that do not come to an end.
#pragma once

#include <algorithm>
#include <cmath>

namespace equipoise {

class EventCount {
 public:
  /// An event at `time`. False if there were so many at once that what the balls do then has no solution of this kind:
  /// the trajectory is given up.
  bool add(double time) {
    at_once_ = time - last_ > 1e-12 * std::max(1.0, time) ? 0 : at_once_ + 1;
    last_ = time;
    return at_once_ <= most_at_once;
  }

  /// Of friction that holds and lets go by turns at one time the share with which it still holds: all, but for
  /// rounding.
  double hold() const { return at_once_ == 0 ? 1.0 : 1.0 - std::ldexp(1e-14, std::min(at_once_, 20)); }

 private:
  static constexpr int most_at_once = 200;
  double last_ = -1.0;
  int at_once_ = 0;
};

}  // namespace equipoise
