// Speeds are told if every start has them.
#include "equipoise/report/decision/below_resonance.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "equipoise/machine/mechanics/forced_vibration.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/study/contents/below_resonance.hpp"

namespace equipoise {

std::string below_resonance_words(const Study& study) {
  if (!runs_below_resonance(study)) return "";
  const auto critical = model::critical_speeds(study.parameters);
  // Balls that hang below the shaft gather nowhere.
  const char* there = study.parameters.gravity == 0.0 ? "balls gather on the heavy side and add to the unbalance"
                                                      : "balls cancel no unbalance";
  if (!study.uncertain.empty())
    return fmt::format("the rotor runs below its critical speed with balls, whatever is drawn: there {}", there);
  return fmt::format("the rotor runs at {}, below its critical speed of {} with balls: there {}",
                     rotor_speed_text(study, std::fabs(study.speed_profile().final_speed())),
                     rotor_speed_text(study, std::min(critical[0], critical[1])), there);
}

}  // namespace equipoise
