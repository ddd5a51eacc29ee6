// Follows starts of an ensemble again, and the rotor without balls, to show them over time.
#pragma once

#include <cstdint>
#include <vector>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/results/commands/machine_page.hpp"
#include "equipoise/results/commands/start_arrays.hpp"
#include "equipoise/results/commands/trajectory.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Of the starts that were not lost: the one with the median peak displacement, then the one with the peak that one in
/// a hundred exceeds, both as TransientGroup::figures has them. One entry if they are the same, none without starts.
/// Needs the columns of transients.
std::vector<std::uint64_t> median_and_worst(const StartArrays& starts);

/// Start `index` at times `step` apart until `until`.
Trajectory start_run(const Study& study, std::uint64_t index, double until, double step, const StopFlag* stop);

/// The same rotor, with what that start draws, and no balls; from as far off its place of rest. The study may have
/// none.
Trajectory bare_run(const Study& study, std::uint64_t index, double until, double step, const StopFlag* stop);

/// The rotor of the first of these starts without balls, then the starts, all over one stretch of time: until the last
/// of them has come to its steady motion, as far as it was followed; the rotor without balls at most half as long
/// again. Outcomes are left unnamed; runs that `stop` cut short are left out.
std::vector<ShownRun> shown_runs(const Study& study, const StartArrays& starts,
                                 const std::vector<std::uint64_t>& indices, const StopFlag* stop);

}  // namespace equipoise
