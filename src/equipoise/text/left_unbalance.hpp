// What unbalance balls leave that dry friction holds, as text and as JSON.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "equipoise/results/basin_result.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// A line for every attractor that is a continuum which friction leaves; empty without any.
std::string left_unbalance_text(const std::vector<OutcomeShare>& attractors, const Study& study);
/// Null if the attractor is none.
nlohmann::ordered_json left_unbalance_json(const OutcomeShare& attractor, const Study& study);

}  // namespace equipoise
