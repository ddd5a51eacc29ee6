// Checks before any work: whether a study can be answered at all, at what cost, and whether given starts belong to it.
#pragma once

#include <span>
#include <string>

#include "equipoise/machine/mechanics/capability.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Throws InputError for an invalid study, or one whose starts cannot be decided at the medians and ends of uncertain
/// values, if there are any. With `transients`, also throws for a study whose transients cannot be watched.
void check_runnable(const Study& study, bool transients);
/// The same for a study that is as it was read, and therefore valid; half the work.
void check_decidable_as_read(const Study& study, bool transients);
/// Throws InputError for a rotor without balls.
void check_has_balls(const Study& study);
/// Throws InputError for a system that lacks what the result needs, named by its key.
void reject_if_lacking(const Study& study, model::ResultKind answer);
/// Throws InputError for an invalid study or one without balls, or a system that lacks what the result needs
/// (machine/mechanics/capability.hpp).
void check_offers(const Study& study, model::ResultKind answer);

/// Throws InputError for a study with uncertain values.
void check_takes_starts(const Study& study);

/// Throws InputError, naming the start, for overlapping balls and for numbers that are not finite. Also for values of
/// balls that the study lacks, and values that all starts share (BasinOptions::initial). `study` has passed check().
void check_given_starts(const Study& study, std::span<const InitialState> given);

/// Bitwise checksum of the initial states.
std::string checksum_of(const Study& study, std::span<const InitialState> given);

/// The work for one start that becomes balanced.
struct StartCost {
  double time = 0.0;     ///< until it is decided: about one e-folding of the slow approach to balance (drag 20: 0.8)
  double fastest = 0.0;  ///< decay rate that limits the step of an explicit method
  bool by_drag = false;  ///< whether that is of balls in their race, else of the supports
  double cause = 0.0;    ///< the ball drag or support damping behind it
  double steps = 0.0;    ///< integration steps
  /// The largest such drag (or damping) with which a start takes at most most_steps, all else being equal.
  double allowed = 0.0;

  bool bearable() const;
};

/// Studies with more steps per start are refused: at this limit pilots and trials, 10^4 starts and more, take a minute.
inline constexpr double most_steps = 3e4;

StartCost start_cost(const Study& study);

/// Throws InputError for a study whose starts would take more than most_steps each because it is stiff.
void check_cost(const Study& study);

}  // namespace equipoise
