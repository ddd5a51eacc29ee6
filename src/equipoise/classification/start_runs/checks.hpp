// Checks whether a study can be answered at all.
#pragma once

#include "equipoise/machine/mechanics/capability.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Throws InputError for an invalid study, or one whose starts cannot be decided.
void check_decidable(const Study& study);
/// The same at the medians and ends of uncertain values, if there are any. With `transients`, also throws for a study
/// whose transients cannot be watched.
void check_runnable(const Study& study, bool transients);
/// Throws InputError for a rotor without balls.
void check_has_balls(const Study& study);
/// Throws InputError if a study asks for decisions by proof but proofs are not possible.
void check_proof(const Study& study);

/// Throws InputError if the spin-up with clamped balls is too long to look for peaks in it.
void check_watchable(const Study& study);
/// Throws InputError for a system that lacks what the result needs, named by its key.
void reject_if_lacking(const Study& study, model::ResultKind answer);
/// Throws InputError for an invalid study or one without balls, or a system that lacks what the result needs
/// (machine/mechanics/capability.hpp).
void check_offers(const Study& study, model::ResultKind answer);

}  // namespace equipoise
