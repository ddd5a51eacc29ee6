// Whether a study can be answered at all.
#pragma once

#include "equipoise/mechanics/capability.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// Throws InputError for invalid studies and those whose starts cannot be decided.
void check_decidable(const Study& study);
/// The same with uncertain values or without, at the medians and at the ends of those; if `transients` are gathered,
/// also for those that cannot be watched.
void check_runnable(const Study& study, bool transients);
/// Throws InputError for a study that asks for decisions by proof where there are none.
void check_proof(const Study& study);

/// Throws InputError for a spin-up with the balls held that is too long to look for peaks in.
void check_watchable(const Study& study);
/// Throws InputError for invalid studies, and those whose system lacks what the answer needs
/// (mechanics/capability.hpp).
void check_offers(const Study& study, model::ResultKind answer);

}  // namespace equipoise
