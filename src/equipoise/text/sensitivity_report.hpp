// What is uncertain in a study, and what the outcome depends on, as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "equipoise/results/sensitivity_result.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// A line for every uncertain value: "drawn with each start: rotor.eccentricity uniform, 0.005 to 0.015", and one for
/// what the study states of starts and they draw all the same; empty without. Not for keys that are `set` otherwise.
std::string uncertain_text(const Study& study, const std::vector<std::string>& set = {});

std::string sensitivity_text(const SensitivityResult& result);
/// An array: key, first and total, each value, low and high.
nlohmann::ordered_json sensitivity_json(const SensitivityResult& result);
/// Rows, evaluations and their like.
nlohmann::ordered_json sensitivity_design_json(const SensitivityResult& result);

}  // namespace equipoise
