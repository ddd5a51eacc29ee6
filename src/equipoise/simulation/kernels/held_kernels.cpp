// Kernels for rotors whose balls are held: with the rotor they are one body, whatever their number. Highway's
// foreach_target compiles this file once per CPU target.
#include <cstddef>
#include <memory>
#include <vector>

#include "equipoise/simulation/kernels/batch_job.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "equipoise/simulation/kernels/held_kernels.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "equipoise/simulation/kernels/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// The observer of driven rotors with clamped balls. It ends trajectories just before they reach the release speed, and
// those that are steady without reaching it.
//
// Hooks: see NoObserver in simulation/batch/batch_block-inl.hpp; one group of lanes. A rotor counts as having reached
// the speed if it has at one of two stages of a step or at its end; dense output later locates the time. `watch` may be
// null; it does not see the step in which balls are released.
class ClampedBalls {
 public:
  static constexpr int lanes = static_cast<int>(pack_lanes);

  ClampedBalls(const BatchTask& task, const ReleaseRule& rule, BatchWatch* watch, std::vector<ClampedEnd>& ends)
      : task_(task),
        size_(task.dimension()),
        speed_place_(task.layout().speed),
        sign_(rule.rising ? 1.0 : -1.0),
        rule_(rule),
        release_(sign_ * rule.release_speed),
        outcomes_(task.count),
        windows_(task, rule.windows, outcomes_, nullptr),
        watch_(watch),
        ends_(ends) {}

  void begin(int slot, std::size_t start, double t, const double* z) {
    windows_.begin(slot, start, t, z);
    if (watch_) watch_->begin(slot, start, t, z);
    for (int i = 0; i < size_; ++i) element(before_[i], slot) = z[i];
    element(before_t_, slot) = t;
    if (!rule_.own_speeds.empty()) element(release_, slot) = sign_ * rule_.own_speeds[start];
    element(nearest_, slot) = sign_ * z[speed_place_];
    crossing_ &= ~(1u << slot);
  }

  HWY_INLINE void stage(int row, int g, const Pack* z) {
    windows_.stage(row, g, z);
    if (row == first_sampled_stage) sample(first_, z);
    if (row == second_sampled_stage) sample(second_, z);
  }

  HWY_INLINE unsigned step(int g, unsigned active, Mask accepted, Pack t, Pack h, const Pack* z) {
    const Pack sign(sign_);
    const Pack here = sign * z[speed_place_];
    const Pack fastest = maximum(maximum(sign * first_[speed_place_], sign * second_[speed_place_]), here);
    const Mask crossed = accepted & (release_ <= fastest), held = accepted & (fastest < release_);
    unsigned leaving = windows_.step(g, active, held, t, h, z);
    if (watch_) watch_->step({g, active, held, t, h, z, first_, second_});
    nearest_ = select(held, maximum(nearest_, here), nearest_);
    for (int i = 0; i < size_; ++i) before_[i] = select(held, z[i], before_[i]);
    before_t_ = select(held, t, before_t_);
    const unsigned now = lane_bits(crossed) & active;
    crossing_ |= now;
    return leaving | now;
  }

  void end(int slot, std::size_t start, BatchEnd how, double t, const double* z) {
    ClampedEnd& result = ends_[start];
    result = {};
    result.nearest = sign_ * element(nearest_, slot);
    if (watch_) watch_->end(slot, start, how, element(before_t_, slot));
    if (how != BatchEnd::decided || !(crossing_ & (1u << slot))) {
      windows_.end(slot, start, how, t, z);
      result.outcome = outcomes_[start];
      return;
    }
    result.crossing = true;
    result.crossed_by = t;
    result.outcome.time = element(before_t_, slot);
    double* row = task_.states + start * static_cast<std::size_t>(size_);
    for (int i = 0; i < size_; ++i) row[i] = element(before_[i], slot);
  }

 private:
  HWY_INLINE void sample(Pack* kept, const Pack* z) {
    for (int i = 0; i < size_; ++i) kept[i] = z[i];
  }

  const BatchTask& task_;
  const int size_, speed_place_;
  const double sign_;
  const ReleaseRule& rule_;
  Pack release_;
  std::vector<Outcome> outcomes_;
  ClassifyOutcome<1, 1, BatchKind::smooth> windows_;
  BatchWatch* const watch_;
  std::vector<ClampedEnd>& ends_;
  static constexpr int largest_held_state = model::dimension(1) + 3;
  Pack first_[largest_held_state], second_[largest_held_state];
  Pack before_[largest_held_state], before_t_, nearest_;
  unsigned crossing_ = 0;
};

const auto held_rotors = [] {
  const auto make = [](const OwnRotor& own) { return HeldFlow<Pack>(own.system); };
  return OwnRotors<decltype(make)>{make};
}();

bool follow_clamped(const BatchTask& task, const ReleaseRule& rule, std::vector<ClampedEnd>& ends) {
  const auto watch = watch_of(task);
  const auto observer = std::make_unique<ClampedBalls>(task, rule, watch.get(), ends);
  return run_block<HeldFlow<Pack>, 1>(task, HeldFlow<Pack>(*task.system), *observer, held_rotors);
}

bool advance_held(const BatchJob& job) {
  WatchForLoss outcomes(job.outcomes);
  return run_watched<HeldFlow<Pack>, 1>(job.task, HeldFlow<Pack>(*job.task.system), outcomes, held_rotors);
}

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace equipoise {

HWY_EXPORT(follow_clamped);
HWY_EXPORT(advance_held);

bool advance_held_batch(const BatchJob& job) { return HWY_DYNAMIC_DISPATCH(advance_held)(job); }

bool follow_clamped_batch(const BatchTask& task, const ReleaseRule& rule, std::vector<ClampedEnd>& ends) {
  return HWY_DYNAMIC_DISPATCH(follow_clamped)(task, rule, ends);
}

}  // namespace equipoise
#endif
