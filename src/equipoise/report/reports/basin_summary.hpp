// The answer of an ensemble on one screen, and what it shares with the document that has everything.
#pragma once

#include <span>
#include <string>

#include "equipoise/report/decision/verdict.hpp"
#include "equipoise/report/drawing/document.hpp"
#include "equipoise/results/commands/basin_result.hpp"

namespace equipoise {

/// The verdict or, without one, the answer; what matters most of vibration; the outcomes; what was computed. A machine
/// that lacks any of these has a shorter one.
Document basin_summary(const BasinResult& result, std::span<const TriedChange> tried);

/// A row per outcome that occurred; `brief`: the likeliest motions, without what few readers need.
DocumentTable outcome_table(const BasinResult& result, bool brief);
/// What a row calls an outcome that is not an attractor: "stalled below 300 rpm".
std::string end_name(const BasinResult& result, const OutcomeShare& outcome);
/// That the result was stopped early, if so.
void add_stopped(Document& document, const BasinResult& result);
/// What was found out about balance.
void add_note(Document& document, const BasinResult& result);
/// A warning if balls may hang at the final speed.
void add_hanging(Document& document, const Study& study);

}  // namespace equipoise
