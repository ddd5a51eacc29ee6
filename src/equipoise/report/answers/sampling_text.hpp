// How the starts of an ensemble were sampled, in words and as JSON.
#pragma once

#include <string>

#include "equipoise/report/text/json.hpp"
#include "equipoise/results/commands/basin_result.hpp"

namespace equipoise {

/// Sentences for the terminal, one per line; empty if starts are random by default.
std::string sampling_text(const BasinResult& result);
/// Equivalent number of random starts, for "as good as", with two digits: "850 000".
std::string as_good_as(const Share& share);
/// Method, replicates, points per replicate; a grid's cells; what was chosen, and why.
void to_json(Json& json, const PartOf<Sampling, BasinResult>& sampling);

}  // namespace equipoise
