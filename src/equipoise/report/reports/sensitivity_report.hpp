// What is uncertain in a study, and how the outcome depends on it, as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include "equipoise/report/drawing/document.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/results/commands/sensitivity_result.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// One line for every uncertain value: "drawn with each start: rotor.eccentricity uniform, 0.005 to 0.015", and one for
/// what the study states of starts although they draw it. Empty if there are none. Omits keys that are `set` otherwise.
std::string uncertain_text(const Study& study, const std::vector<std::string>& set = {});

void add_sensitivity(Document& document, const SensitivityResult& result);
/// Key, first and total, each value, low and high.
void to_json(Json& json, const InputSensitivity& input);
/// Numbers of rows and evaluations, and so on.
void to_json(Json& json, const SensitivityResult& result);

}  // namespace equipoise
