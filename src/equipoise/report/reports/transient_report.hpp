// The transients of an ensemble in tables and as JSON.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/report/drawing/document.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/results/commands/basin_result.hpp"
#include "equipoise/results/commands/transient_result.hpp"

namespace equipoise {

/// Every figure of every outcome, in the units of the study's scales: mm, N, mm/s, s; else dimensionless.
void add_transients(Document& document, const TransientResult& result, const Study& study);

/// e omega in mm/s of the mean residual unbalance at the end, at the speed that the starts of `group` came to. Empty
/// unless is_graded() (results/commands/left_grade.hpp), and if a driven rotor's speed was never measured.
std::optional<double> left_grade(const TransientGroup& group, const Study& study);

/// When peaks occur and when the motion at the end does: "during start-up" and "at full speed", or words that fit a
/// study without a run-up, or whose speed may not be kept.
std::array<const char*, 2> phase_words(const Study& study);
/// A figure's title without when it is measured: "RMS velocity".
std::string figure_name(float TransientRow::*figure);
/// Whether the rotor without balls meets the limits, and if not, when; empty if none is stated.
std::string bare_limit_words(const OneBodyRuns& bare, const Study& study);

/// Whether the result has the rotor without balls next to that with them.
bool tells_without_balls(const BasinResult& result);
/// A row per figure: without balls and with balls held if tells_without_balls(), with balls, and limits. For a result
/// with transients.
DocumentTable way_table(const BasinResult& result);
/// The same for a rotor that has no balls at all.
DocumentTable bare_table(const BasinResult& result);
/// If so, how many runs it is from.
std::string bare_words(const BasinResult& result);
/// That these runs stalled, reached no steady motion or were lost, each if some did. `how`: "Without balls".
std::vector<std::string> not_steady_words(const OneBodyRuns& body, const char* how, const Study& study);
/// What to read from either, a sentence each.
std::vector<std::string> without_balls_words(const BasinResult& result);

/// Starts within all limits, and how many hit the housing; none if no limit is stated.
std::vector<Block> limits_blocks(const TransientGroup& group, const Study& study);
/// For a study with limits.clearance: how many starts hit the housing. Otherwise empty.
std::string clearance_words(const TransientGroup& group, const Study& study);

/// The objects "transients" and "without_balls" of json_text(), in the same units, which they name.
void to_json(Json& json, const PartOf<TransientResult, Study>& transients);
void to_json(Json& json, const PartOf<WithoutBalls, Study>& without);

/// Shares of starts by the name of the limit that they exceed, or of the limits that they are within, each as `told`
/// has it; without those that are not known.
template <std::size_t n, class Named, class Told>
Json by_name(const std::array<std::optional<Share>, n>& shares, const std::array<Named, n>& names, const Told& told) {
  Json json = Json::object();
  for (std::size_t k = 0; k < n; ++k) {
    if (!shares[k]) continue;
    if constexpr (requires { names[k].name; })
      json[names[k].name] = told(*shares[k]);
    else
      json[names[k]] = told(*shares[k]);
  }
  return json;
}

}  // namespace equipoise
