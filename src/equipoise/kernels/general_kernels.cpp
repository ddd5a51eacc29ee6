// Kernels of the general rotor for every CPU target: this file is compiled once per instruction set.
#include "equipoise/kernels/general_kernels.hpp"

#include <memory>

#include "equipoise/model/ball_count.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "equipoise/kernels/general_kernels.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "equipoise/deciding/decision-inl.hpp"
#include "equipoise/kernels/lane_group-inl.hpp"
#include "equipoise/lanes/lane_block-inl.hpp"
#include "equipoise/model/flow-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

template <int room>
bool advance_general_balls(const LaneTask& task, std::vector<Fate>& fates) {
  using Flow = FreeFlow<Pack, room, Terms{true, true, true}>;
  WatchForLoss observer(fates);
  const auto block = std::make_unique<LaneBlock<Flow, WatchForLoss, lane_groups<room>>>(
      task, Flow(*task.parameters, task.segment), observer);
  return block->run();
}

template <int room>
bool decide_general_balls(const LaneTask& task, const DecisionRule& rule, std::vector<Fate>& fates,
                          std::vector<PilotRecord>* pilot) {
  using Flow = FreeFlow<Pack, room, Terms{false, true, true}>;
  using Observer = DecideFate<room, lane_groups<room>, true>;
  const auto observer = std::make_unique<Observer>(*task.parameters, task.segment, rule, fates, pilot);
  const auto block = std::make_unique<LaneBlock<Flow, Observer, lane_groups<room>>>(
      task, Flow(*task.parameters, task.segment), *observer);
  return block->run();
}

bool advance_general_target(const LaneTask& task, std::vector<Fate>& fates) {
  return model::with_ball_count(task.parameters->balls,
                                [&](auto room) { return advance_general_balls<room>(task, fates); });
}

bool decide_general_target(const LaneTask& task, const DecisionRule& rule, std::vector<Fate>& fates,
                           std::vector<PilotRecord>* pilot) {
  return model::with_ball_count(task.parameters->balls,
                                [&](auto room) { return decide_general_balls<room>(task, rule, fates, pilot); });
}

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace equipoise {

HWY_EXPORT(advance_general_target);
HWY_EXPORT(decide_general_target);

bool advance_general_lanes(const LaneTask& task, std::vector<Fate>& fates) {
  return HWY_DYNAMIC_DISPATCH(advance_general_target)(task, fates);
}

bool decide_general_lanes(const LaneTask& task, const DecisionRule& rule, std::vector<Fate>& fates,
                          std::vector<PilotRecord>* pilot) {
  return HWY_DYNAMIC_DISPATCH(decide_general_target)(task, rule, fates, pilot);
}

}  // namespace equipoise
#endif
