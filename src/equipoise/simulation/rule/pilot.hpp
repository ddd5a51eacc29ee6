// Takes a pilot's trajectories to groups of like motions, and to boxes that recognise them early.
#pragma once

#include <cstddef>
#include <vector>

#include "equipoise/core/base/bytes.hpp"
#include "equipoise/results/types/outcome.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

constexpr OutcomeKind last_of(OutcomeKind) { return OutcomeKind::stalled; }
constexpr DecidedBy last_of(DecidedBy) { return DecidedBy::followed; }

/// The members of an Outcome and of a record, for search logs and messages.
template <class Bytes, Like<Outcome> T>
void members(Bytes& b, T& f) {
  b(f.kind, f.by, f.attractor, f.time, f.mean_speed, f.unbalance, f.radius, f.met);
}
template <class Bytes, Like<PilotRecord> T>
void members(Bytes& b, T& r) {
  b(Trimmed{r.features}, Trimmed{r.range.low}, Trimmed{r.range.high}, r.range.attractor, r.range.hits_needed,
    r.range.trend, r.range.chaos, r.finished_window, Trimmed{r.longest_run}, r.least_value);
}

/// Trajectories whose long windows show the same motion.
struct MotionGroup {
  std::vector<std::size_t> members;  ///< indices of records
  Features features{};               ///< of the first member
  FeatureBox range;                  ///< of all members' short windows
};

/// Groups the records named in `which`: each joins the first group whose features it shares to `tolerance`
/// (same_motion()). Order decides, so the same records make the same groups.
std::vector<MotionGroup> group_records(const std::vector<PilotRecord>& records, const std::vector<std::size_t>& which,
                                       int balls, double tolerance);

/// Bounds that recognise a group's short windows: its range, widened on both sides by `widths` times its width, and by
/// 2 % of the largest r, rate or psi'. The attractor is 0 if they would admit a centred rotor with resting balls: such
/// a box decides nothing.
FeatureBox box_around(const FeatureBox& range, int balls, int attractor, double widths);

/// How many windows in a row inside box `b` decide: more than twice the longest run of any audited trajectory that went
/// elsewhere, and at least three. `outcomes` and `records` come from the audit, run with the rule's boxes and `blind`.
/// 0 if that is too many to be of use, or if fewer than a hundred trajectories stayed that long and ended in
/// `attractor`, which proves little.
int hits_from_audit(const std::vector<Outcome>& outcomes, const std::vector<PilotRecord>& records, std::size_t b,
                    int attractor, bool undecided_is_own);

}  // namespace equipoise
