// Kernels with statistics of transients for every CPU target: this file is compiled once per instruction set.
#include "equipoise/kernels/transient_kernels.hpp"

#include <memory>

#include "equipoise/model/ball_count.hpp"
#include "equipoise/transients/transient_table.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "equipoise/kernels/transient_kernels.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "equipoise/deciding/decision-inl.hpp"
#include "equipoise/deciding/follow_on-inl.hpp"
#include "equipoise/kernels/lane_group-inl.hpp"
#include "equipoise/lanes/lane_block-inl.hpp"
#include "equipoise/model/flow-inl.hpp"
#include "equipoise/transients/watch_transients-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

template <int room, Terms terms, bool windows, class Fates>
bool run_watched(const LaneTask& task, Fates& fates) {
  using Flow = FreeFlow<Pack, room, terms>;
  using Watch = WatchTransients<room, lane_groups<room>, terms, windows>;
  using Observer = FollowOn<Fates, Watch, lane_groups<room>>;
  const auto watch = std::make_unique<Watch>(task, *task.transients);
  const auto observer = std::make_unique<Observer>(fates, *watch);
  const auto block = std::make_unique<LaneBlock<Flow, Observer, lane_groups<room>>>(
      task, Flow(*task.parameters, task.segment), *observer);
  return block->run();
}

bool advance_transient_target(const LaneTask& task, std::vector<Fate>& fates) {
  return model::with_ball_count(task.parameters->balls, [&](auto room) {
    WatchForLoss loss(fates);
    return run_watched<room, Terms{true, true, true}, false>(task, loss);
  });
}

template <int room, bool strobed>
bool decide_watched(const LaneTask& task, const DecisionRule& rule, std::vector<Fate>& fates) {
  const auto decide = std::make_unique<DecideFate<room, lane_groups<room>, strobed>>(*task.parameters, task.segment,
                                                                                     rule, fates, nullptr);
  return run_watched<room, Terms{false, strobed, strobed}, true>(task, *decide);
}

bool decide_transient_target(const LaneTask& task, const DecisionRule& rule, std::vector<Fate>& fates) {
  return model::with_ball_count(task.parameters->balls, [&](auto room) {
    return task.general() ? decide_watched<room, true>(task, rule, fates)
                          : decide_watched<room, false>(task, rule, fates);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace equipoise {

HWY_EXPORT(advance_transient_target);
HWY_EXPORT(decide_transient_target);

bool advance_transient_lanes(const LaneTask& task, std::vector<Fate>& fates) {
  return HWY_DYNAMIC_DISPATCH(advance_transient_target)(task, fates);
}

bool decide_transient_lanes(const LaneTask& task, const DecisionRule& rule, std::vector<Fate>& fates) {
  return HWY_DYNAMIC_DISPATCH(decide_transient_target)(task, rule, fates);
}

}  // namespace equipoise
#endif
