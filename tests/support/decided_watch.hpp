// A trajectory whose outcome becomes known, watched by the sums that lanes gather until it may leave.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>

#include "equipoise/simulation/transients/transient_watch.hpp"

namespace equipoise {

class DecidedWatch {
 public:
  explicit DecidedWatch(const TransientSettings& settings) : settings_(settings), limits_(settings) {
    gathered_.load(0, {});
  }

  void begin(const TransientSample& first) {
    t_ = first.t;
    gathered_.resume(0, {}, t_, first.places[0]);
    gathered_.stand(0, t_, std::span(first.places).first(1), first.unbalance);
    gathered_.restart(0, t_);
  }
  // A step from the last sample to time `to`, sampled by `sample(t)`.
  template <class Sampled>
  void step_to(double to, Sampled&& sample) {
    const double begin = t_;
    HWY_NAMESPACE::transient::Sample<double> at[3];
    Gather::Turning unbalance{};
    for (std::size_t k = 0; k < 3; ++k) {
      const TransientSample here = sample(k == 2 ? to : begin + TransientWatch::nodes[k] * (to - begin));
      at[k] = here.places[0];
      std::copy(here.unbalance.begin(), here.unbalance.end(), unbalance.part);
    }
    t_ = to;
    const unsigned full = gathered_.add(limits_, 1, true, begin, to, to - begin, at, unbalance);
    if (full && end_) may_leave_ = gathered_.seen_enough(0, settings_, *end_, gathered_.peak(0));
  }
  // The outcome is known at the end of the last step: windows count from here.
  void decided(const KnownEnd& end) {
    end_ = end;
    gathered_.end_work(0);
    gathered_.restart(0, t_);
  }
  bool may_leave() const { return may_leave_; }
  TransientSums sums() const {
    TransientSums sums;
    gathered_.store(0, t_, sums);
    return sums;
  }

 private:
  using Gather = HWY_NAMESPACE::transient::GatherPlaces<double>;

  TransientSettings settings_;
  HWY_NAMESPACE::transient::Limits<double> limits_;
  Gather gathered_;
  std::optional<KnownEnd> end_;
  double t_ = 0.0;
  bool may_leave_ = false;
};

}  // namespace equipoise
