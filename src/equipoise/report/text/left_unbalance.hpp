// The unbalance that balls held by dry friction leave, as text and as JSON.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "equipoise/results/commands/basin_result.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// One line for every attractor that is a continuum caused by friction; empty without any.
std::string left_unbalance_text(const std::vector<OutcomeShare>& attractors, const Study& study);
/// Null if the attractor is no such continuum.
nlohmann::ordered_json left_unbalance_json(const OutcomeShare& attractor, const Study& study);

}  // namespace equipoise
