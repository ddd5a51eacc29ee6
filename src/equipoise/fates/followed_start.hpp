// One start followed by itself until it is seen to approach a motion, without a list of what it may come to.
#pragma once

#include <vector>

#include "equipoise/base/stop_flag.hpp"
#include "equipoise/deciding/fate.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/motions/settling.hpp"
#include "equipoise/spin_up/spin_up.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/transients/transient_table.hpp"

namespace equipoise {

struct FollowedStart {
  /// Attracted, to settling.motion, which has no identifier yet; or what else became of it. A rotor that a motor does
  /// not bring up to speed is stalled, whatever its motion.
  Fate fate;
  Settling settling;
};

/// `start`: the one start that `source`, make_spin_up(study), has spun up; `system`: study.system(). It is followed
/// until it approaches a motion that exists and is linearly stable, at most for the study's horizon, which is filled
/// in. `known`: orbits of this system. Once `stop` is set the answer is worth nothing.
FollowedStart follow_start(const Study& study, const model::System& system, const SpinUp& source, const SpunUp& start,
                           const std::vector<KnownOrbit>& known, const StopFlag* stop);

/// The transients of such a start, from its sums up to the end of its spin-up (`table` has one row, which is filled on,
/// and the settings of source.watch()): followed on lanes, over as long as its fate took, and then until its end is
/// seen. Where a start's way is chaotic this is another such way than the one that told its fate, for steps differ; it
/// ends with the figures of the same motion.
TransientRow followed_transients(const Study& study, const SpinUp& source, SpunUp& start, const FollowedStart& followed,
                                 TransientTable& table, const StopFlag* stop);

}  // namespace equipoise
