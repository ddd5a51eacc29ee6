// Tables and sentences of an ensemble's document.
#pragma once

#include <string>

#include "equipoise/report/drawing/document.hpp"
#include "equipoise/results/commands/basin_result.hpp"

namespace equipoise {

/// The figures that matter most, each with its limit if there is one, without balls, and with them in the median and in
/// nine runs of ten.
DocumentTable short_table(const BasinResult& result);
/// A row per outcome that occurred; `brief`: the likeliest motions, without what few readers need.
DocumentTable outcome_table(const BasinResult& result, bool brief);
/// What a row calls an outcome that is not an attractor: "stalled below 300 rpm".
std::string end_name(const BasinResult& result, const OutcomeShare& outcome);
/// What balance depends on most.
void add_sensitivity(Document& document, const SensitivityResult& result);

/// How starts were sampled: sentences, one per line; empty if starts are random by default.
std::string sampling_text(const BasinResult& result);
/// Equivalent number of random starts, for "as good as", with two digits: "850 000".
std::string as_good_as(const Share& share);

}  // namespace equipoise
