// The kernel: equations, integrator, lane block and observers bound together, once for all its kinds. Included once per
// CPU target by each of the sources that compile some kinds.
#if defined(EQUIPOISE_KERNELS_KERNEL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_KERNELS_KERNEL_INL
#undef EQUIPOISE_KERNELS_KERNEL_INL
#else
#define EQUIPOISE_KERNELS_KERNEL_INL
#endif

#include <memory>
#include <vector>

#include "equipoise/deciding/decision-inl.hpp"
#include "equipoise/deciding/fate.hpp"
#include "equipoise/deciding/follow_on-inl.hpp"
#include "equipoise/kernels/lane_job.hpp"
#include "equipoise/lanes/lane_block-inl.hpp"
#include "equipoise/lanes/watch_radius-inl.hpp"
#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/flow-inl.hpp"
#include "equipoise/transients/watch_transients-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// Groups of lanes taken in turn. Eight lanes and 32 registers (AVX-512) profit from three for up to two balls; narrower
// registers, or more balls, keep the processor busy with one.
template <int room>
inline constexpr int lane_groups = room <= 2 && pack_lanes == 8 ? most_lane_groups : 1;

// Records trajectories that are lost on the way; the others simply arrive.
class WatchForLoss : public NoObserver {
 public:
  explicit WatchForLoss(std::vector<Fate>& fates) : fates_(fates) {}
  void end(int, std::size_t start, LaneEnd how, double t, const double*) {
    if (how == LaneEnd::diverged) fates_[start] = {Outcome::diverged, DecidedBy::nothing, 0, t};
    if (how == LaneEnd::failed) fates_[start] = {Outcome::failed, DecidedBy::nothing, 0, t};
  }

 private:
  std::vector<Fate>& fates_;
};

// None for a task that asks for none.
inline std::unique_ptr<LaneWatch> watch_of(const LaneTask& task) {
  if (task.transients) return std::make_unique<WatchTransients>(task, *task.transients);
  if (task.radius) return std::make_unique<WatchRadius>(*task.radius);
  return nullptr;
}

// `turning`: of every rotor; else of one without preferred direction, whose balls slide.
constexpr Terms terms_of(bool acceleration, bool turning) {
  return turning ? Terms{.acceleration = acceleration} : paper_terms(acceleration);
}

template <int room, Terms terms, class Observer>
bool run_kernel(const LaneTask& task, Observer& observer) {
  using Flow = FreeFlow<Pack, room, terms>;
  const auto block = std::make_unique<LaneBlock<Flow, Observer, lane_groups<room>>>(
      task, Flow(*task.parameters, task.segment), observer);
  return block->run();
}

template <int room, Terms terms, class Fates>
bool run_watched(const LaneTask& task, Fates& fates) {
  const auto watch = watch_of(task);
  const auto observer = std::make_unique<FollowOn<Fates, lane_groups<room>>>(fates, watch.get());
  return run_kernel<room, terms>(task, *observer);
}

template <int room, bool turning>
bool decide_balls(const LaneJob& job) {
  using Fates = DecideFate<room, lane_groups<room>, turning>;
  const auto fates = std::make_unique<Fates>(*job.task.parameters, job.task.segment, *job.rule, job.fates, job.pilot);
  return run_watched<room, terms_of(false, turning)>(job.task, *fates);
}

// What plain rotors do unwatched is compiled without the question for a watch, which would cost 3 % here, and without
// acceleration where there is none; deciding does not feel that question.
template <int room, bool turning>
bool advance_balls(const LaneJob& job) {
  WatchForLoss fates(job.fates);
  if constexpr (!turning)
    if (!job.task.watched())
      return job.task.segment.acceleration == 0.0 ? run_kernel<room, terms_of(false, false)>(job.task, fates)
                                                  : run_kernel<room, terms_of(true, false)>(job.task, fates);
  return run_watched<room, terms_of(true, turning)>(job.task, fates);
}

template <bool turning>
bool run_job(const LaneJob& job) {
  const int balls = job.task.parameters->balls;
  // Deciding takes most of the time: unrolled for five and six balls too, evaluations take 22 and 9 % less.
  if (job.rule) return model::with_ball_count<6>(balls, [&](auto room) { return decide_balls<room, turning>(job); });
  return model::with_ball_count(balls, [&](auto room) { return advance_balls<room, turning>(job); });
}

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
