// What standards make of an ensemble: balance quality, severity zones, hand-arm exposure, whether the machine slides.
// Its verdict as JSON, not in verdict.hpp: installed headers need no JSON library.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "equipoise/report/decision/verdict.hpp"
#include "equipoise/report/drawing/document.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/results/commands/basin_result.hpp"

namespace equipoise {

/// A table for each, or a sentence if that says it all: for a study with scales whose result has the rotor without
/// balls; otherwise empty.
std::vector<Block> standards_blocks(const BasinResult& result);
/// In groups: the rotor without balls next to that with them; which limits are kept; what standards make of it. A group
/// that has nothing to report is left out.
std::vector<std::vector<Block>> balancer_blocks(const BasinResult& result);

/// What is judged: the ensemble, next to the rotor without balls; of a study without balls that rotor alone.
struct JudgedByStandards {
  const BasinResult& result;
  const TransientGroup& all;
  const TransientGroup* beside;
  bool one;  ///< run is enough
};
/// Empty where standards_blocks() is.
std::optional<JudgedByStandards> judged_by_standards(const BasinResult& result);
/// The object "standards" of json_text().
void to_json(Json& json, const JudgedByStandards& judged);

/// The verdict's lines, and every change that was tried, in the study's shown units.
void to_json(Json& json, const PartOf<BalancerVerdict, std::span<const TriedChange>>& verdict);

}  // namespace equipoise
