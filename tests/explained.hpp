// Studies explained, and what tests look for in that.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "equipoise/explain/explain.hpp"
#include "equipoise/study/study.hpp"
#include "machine_study.hpp"

namespace equipoise {

inline Explanation explained(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return explain(parse_study(text, "m.toml", overrides), parse_ball_details(text, "m.toml", overrides));
}

inline bool warned(const Explanation& e, const std::string& words) {
  return std::any_of(e.warnings.begin(), e.warnings.end(), [&](const std::string& w) { return holds(w, words); });
}

inline const RuleOfThumb& rule(const Explanation& e, const std::string& id) {
  const auto found = std::find_if(e.advice.begin(), e.advice.end(), [&](const auto& r) { return r.id == id; });
  if (found == e.advice.end()) throw std::logic_error("no rule " + id);
  return *found;
}

}  // namespace equipoise
