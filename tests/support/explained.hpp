// Studies explained, and what tests look for in the text.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "equipoise/report/explain/explain.hpp"
#include "equipoise/study/contents/study.hpp"
#include "studies.hpp"

namespace equipoise {

/// Six balls of 20 mm in a race of 40 mm: points would cancel 7.84 kg mm, these cancel 5.22.
inline const std::string crowded_machine = R"([rotor]
mass = "10 kg"
stiffness = "20 kN/m"
damping_ratio = 0.1
unbalance = "4000 g mm"
[balancer]
balls = 6
ball_diameter = "20 mm"
race_radius = "40 mm"
ball_density = "7800 kg/m3"
drag = "2e-3 N m s"
[speed]
profile = "constant"
speed = "3000 rpm"
)";

inline Explanation explained(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return explain(parse_study(text, "m.toml", overrides));
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
