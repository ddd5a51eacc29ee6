// The kernel: one template binds equations, integrator, lane block and observers for all kinds of system. Included once
// per CPU target by each source that compiles a kind.
#if defined(EQUIPOISE_KERNELS_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_KERNELS_KERNEL_INL
#undef EQUIPOISE_KERNELS_KERNEL_INL
#else
#define EQUIPOISE_KERNELS_KERNEL_INL
#endif

#include <algorithm>
#include <memory>
#include <vector>

#include "equipoise/simulation/batch/batch_block-inl.hpp"
#include "equipoise/simulation/batch/batch_watch-inl.hpp"
#include "equipoise/simulation/rule/classify-inl.hpp"
#include "equipoise/simulation/kernels/batch_job.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/flow-inl.hpp"
#include "equipoise/machine/model/hybrid_flow-inl.hpp"
#include "equipoise/machine/model/smooth_flow-inl.hpp"
#include "equipoise/results/types/outcome.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// Groups of lanes taken in turn. Eight lanes and 32 registers (AVX-512) profit from three for up to two balls; narrower
// registers, more balls or the longer equations of smooth systems keep the processor busy with one.
template <int room, BatchKind kind = BatchKind::plain>
inline constexpr int batch_groups = room <= 2 && pack_lanes == 8 && kind < BatchKind::smooth ? most_batch_groups : 1;

// Records trajectories lost on the way.
class WatchForLoss : public NoObserver {
 public:
  explicit WatchForLoss(std::vector<Outcome>& outcomes) : outcomes_(outcomes) {}
  void end(int, std::size_t start, BatchEnd how, double t, const double*) {
    if (how == BatchEnd::diverged) outcomes_[start] = {OutcomeKind::diverged, DecidedBy::nothing, 0, t};
    if (how == BatchEnd::failed) outcomes_[start] = {OutcomeKind::failed, DecidedBy::nothing, 0, t};
  }

 private:
  std::vector<Outcome>& outcomes_;
};

// An observer of lanes that combines one that decides outcomes with an optional watch. A decided trajectory goes on
// until the watch has seen its final motion.
//
// `Outcomes` says by attractor_of(slot) what it has just decided; without that function it never decides. It sees
// nothing of a lane after its decision, so a watch changes no outcome. `watch` may be null, as for most tasks;
// HWY_UNLIKELY keeps registers for those.
template <class Outcomes, int groups>
class FollowOn {
 public:
  static_assert(groups <= most_batch_groups);

  FollowOn(Outcomes& outcomes, BatchWatch* watch, int size) : outcomes_(outcomes), watch_(watch), size_(size) {}

  void begin(int slot, std::size_t start, double t, const double* z) {
    outcomes_.begin(slot, start, t, z);
    decided_[slot / lanes] &= ~bit(slot);
    if (watch_) watch_->begin(slot, start, t, z);
  }

  HWY_INLINE void stage(int row, int g, const Pack* z) {
    outcomes_.stage(row, g, z);
    if (row == first_sampled_stage && HWY_UNLIKELY(watch_)) sample(first_[g], z);
    if (row == second_sampled_stage && HWY_UNLIKELY(watch_)) sample(second_[g], z);
  }

  HWY_INLINE unsigned step(int g, unsigned active, Mask accepted, Pack t, Pack h, const Pack* z) {
    unsigned full = 0;
    if (HWY_UNLIKELY(watch_)) full = watch_->step({g, active, accepted, t, h, z, first_[g], second_[g]});
    const unsigned fresh = outcomes_.step(g, active & ~decided_[g], accepted, t, h, z);
    return HWY_UNLIKELY(watch_) ? leaving(g, full & decided_[g], fresh, t) : fresh;
  }

  void corner(int slot, double t, const double* z) {
    if (watch_) watch_->corner(slot, t, z);
  }

  void end(int slot, std::size_t start, BatchEnd how, double t, const double* z) {
    if (watch_) watch_->end(slot, start, how, t);
    if (decided_[slot / lanes] & bit(slot))
      outcomes_.end(slot, start, BatchEnd::decided, decided_at_[slot], z);
    else
      outcomes_.end(slot, start, how, t, z);
  }

 private:
  static constexpr int lanes = static_cast<int>(pack_lanes);
  static unsigned bit(int slot) { return 1u << (slot % lanes); }

  HWY_INLINE void sample(Pack* kept, const Pack* z) const {
    for (int i = 0; i < size_; ++i) kept[i] = z[i];
  }

  // Notes the `fresh` decisions. Returns the earlier decided lanes that may leave, of those whose window has just ended
  // (`full`).
  HWY_INLINE unsigned leaving(int g, unsigned full, unsigned fresh, Pack t) {
    if constexpr (requires(Outcomes f) { f.attractor_of(0); }) {
      if (fresh) note(g, fresh, t);
      if (full) return seen(g, full);
    }
    return 0;
  }

  HWY_NOINLINE void note(int g, unsigned fresh, Pack t) {
    alignas(64) double times[8];
    t.store(times);
    for (int lane = 0; lane < lanes; ++lane) {
      if (!(fresh & (1u << lane))) continue;
      const int slot = g * lanes + lane;
      decided_at_[slot] = times[lane];
      attractor_[slot] = outcomes_.attractor_of(slot);
      watch_->restart(slot, times[lane]);
    }
    decided_[g] |= fresh;
  }

  HWY_NOINLINE unsigned seen(int g, unsigned full) const {
    unsigned result = 0;
    for (int lane = 0; lane < lanes; ++lane) {
      const int slot = g * lanes + lane;
      if ((full & (1u << lane)) && watch_->seen_enough(slot, attractor_[slot])) result |= 1u << lane;
    }
    return result;
  }

  Outcomes& outcomes_;
  BatchWatch* const watch_;
  const int size_;                 // of a state
  unsigned decided_[groups] = {};  // bits of lanes followed on
  double decided_at_[groups * lanes] = {};
  int attractor_[groups * lanes] = {};
  Pack first_[groups][watched_state], second_[groups][watched_state];
};

template <class Flow, int groups, class Observer, class Rotors>
bool run_block(const BatchTask& task, const Flow& flow, Observer& observer, const Rotors& rotors) {
  const auto block = std::make_unique<BatchBlock<Flow, Observer, groups, Rotors>>(task, flow, observer, rotors);
  return block->run();
}

template <class Flow, int groups, class Outcomes, class Rotors>
bool run_watched(const BatchTask& task, const Flow& flow, Outcomes& outcomes, const Rotors& rotors) {
  const auto watch = watch_of(task);
  const auto observer = std::make_unique<FollowOn<Outcomes, groups>>(outcomes, watch.get(), flow.size());
  return run_block<Flow, groups>(task, flow, *observer, rotors);
}

// The terms of a rotor at a prescribed speed whose race is centred.
constexpr Terms terms_of(BatchKind kind, bool acceleration) {
  return kind == BatchKind::plain ? paper_terms(acceleration) : Terms{.acceleration = acceleration};
}

template <int room, BatchKind kind, bool acceleration>
auto flow_of(const model::Parameters& parameters, const model::System* system, const model::Segment& segment) {
  if constexpr (kind == BatchKind::smooth)
    return SmoothFlow<Pack, room>(*system, segment);
  else if constexpr (kind == BatchKind::tilting)
    return SmoothFlow<Pack, room, true>(*system, segment);
  else if constexpr (kind == BatchKind::hybrid)
    return HybridFlow<Pack, room>(*system, segment);
  else
    return FreeFlow<Pack, room, terms_of(kind, acceleration)>(parameters, segment);
}

template <int room, BatchKind kind, bool acceleration>
auto flow_of(const BatchTask& task) {
  return flow_of<room, kind, acceleration>(*task.parameters, task.system, task.segment);
}

template <int room, BatchKind kind, bool acceleration>
auto own_rotors() {
  const auto make = [](const OwnRotor& own) {
    return flow_of<room, kind, acceleration>(own.system.parameters(), &own.system, own.segment);
  };
  return OwnRotors<decltype(make)>{make};
}

template <int room, BatchKind kind>
bool classify_balls(const BatchJob& job) {
  using Outcomes = ClassifyOutcome<room, batch_groups<room, kind>, kind>;
  const auto outcomes = std::make_unique<Outcomes>(job.task, *job.rule, job.outcomes, job.pilot);
  const auto flow = flow_of<room, kind, false>(job.task);
  const auto run = [&](const auto& rotors) {
    return run_watched<std::remove_const_t<decltype(flow)>, batch_groups<room, kind>>(job.task, flow, *outcomes,
                                                                                      rotors);
  };
  if constexpr (kind < BatchKind::smooth)
    if (!job.task.own) return run(OneRotor{});
  return run(own_rotors<room, kind, false>());
}

// Unwatched runs of plain rotors are compiled apart, without acceleration where there is none and without the test for
// a watch. That test would cost 3 % here; deciding does not slow down by it.
template <int room, BatchKind kind>
bool advance_balls(const BatchJob& job) {
  constexpr int groups = batch_groups<room, kind>;
  const auto run = [&]<bool acceleration, bool watched>(const auto& rotors) {
    WatchForLoss outcomes(job.outcomes);
    const auto flow = flow_of<room, kind, acceleration>(job.task);
    using Flow = std::remove_const_t<decltype(flow)>;
    if constexpr (watched)
      return run_watched<Flow, groups>(job.task, flow, outcomes, rotors);
    else
      return run_block<Flow, groups>(job.task, flow, outcomes, rotors);
  };
  if constexpr (kind == BatchKind::plain) {
    if (!job.task.own && !job.task.watched())
      return job.task.segment.acceleration == 0.0 ? run.template operator()<false, false>(OneRotor{})
                                                  : run.template operator()<true, false>(OneRotor{});
  }
  if constexpr (kind < BatchKind::smooth)
    if (!job.task.own) return run.template operator()<true, true>(OneRotor{});
  return run.template operator()<true, true>(own_rotors<room, kind, true>());
}

template <BatchKind kind>
bool run_job(const BatchJob& job) {
  const int balls = job.task.parameters->balls;
  // Deciding takes most of the time. Unrolling it for five and six balls too makes evaluations 22 and 9 % cheaper.
  constexpr int most = seldom_run || kind >= BatchKind::hybrid ? 0 : kind == BatchKind::smooth ? 4 : 6;
  // Two planes of two balls, which most tilting rotors have, unrolled: a sixth faster.
  if constexpr (kind == BatchKind::tilting && !seldom_run)
    if (balls == 4) return job.rule ? classify_balls<4, kind>(job) : advance_balls<4, kind>(job);
  if (job.rule) return model::with_ball_count<most>(balls, [&](auto room) { return classify_balls<room, kind>(job); });
  constexpr int most_advanced = std::min(most, 4);
  return model::with_ball_count<most_advanced>(balls, [&](auto room) { return advance_balls<room, kind>(job); });
}

// Portable code of all kinds is compiled in portable_kernels.cpp, and only declared elsewhere.
#if HWY_TARGET == HWY_SCALAR && HWY_TARGETS != HWY_SCALAR
#ifndef EQUIPOISE_PORTABLE_KERNELS
#define EQUIPOISE_PORTABLE_KERNELS extern
#endif
EQUIPOISE_PORTABLE_KERNELS template bool run_job<BatchKind::plain>(const BatchJob& job);
EQUIPOISE_PORTABLE_KERNELS template bool run_job<BatchKind::turning>(const BatchJob& job);
EQUIPOISE_PORTABLE_KERNELS template bool run_job<BatchKind::smooth>(const BatchJob& job);
EQUIPOISE_PORTABLE_KERNELS template bool run_job<BatchKind::hybrid>(const BatchJob& job);
EQUIPOISE_PORTABLE_KERNELS template bool run_job<BatchKind::tilting>(const BatchJob& job);
#endif

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
