// The first rule: windows long enough for slow rotors, and to tell a slow way to balance.
#include "equipoise/classification/attractor_search/search.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/machine/model/stroboscopic_section.hpp"

namespace equipoise {

namespace {

// Makes half a window hold whole periods of the section, so that motions in step with the rotor look the same in all.
double whole_sections(double window, double section_period) {
  return 2.0 * section_period * std::ceil(0.5 * window / section_period - 1e-9);
}

}  // namespace

ClassificationRule first_rule(const Study& study, const BalancedAnalysis& balanced, const model::System& system) {
  ClassificationRule rule;
  rule.balls = study.parameters.balls;
  rule.interchangeable = study.parameters.equal_balls();
  rule.balanced = balanced.regions;
  // Slow rotors move slowly. A window holds several revolutions of every motion met between 1.4 and 6.5 critical
  // speeds.
  const double pace = system.coasts() ? study.stall_speed() : std::fabs(system.pace());
  rule.window = std::max(16.0, 32.0 / std::max(pace, 0.1));
  rule.sag = model::static_sag(study.parameters);
  if (system.section() == model::Section::stroboscopic)
    rule.window = whole_sections(rule.window, system.section_period());
  if (system.runs_away(rule.fastest)) rule.fastest = model::out_of_reach;
  rule.first_long_window = std::max(100.0, 6.0 * rule.window);
  if (balanced.slowest_rate < 0.0) {
    // Long enough that a slow way to balance shrinks visibly from one window to the next.
    rule.first_long_window = std::max(rule.first_long_window, 1.0 / -balanced.slowest_rate);
    rule.first_long_window = std::min(rule.first_long_window, *study.numerics.horizon / 8.0);
    rule.sameness = std::min(rule.sameness, 0.2 * -balanced.slowest_rate * rule.first_long_window);
  }
  return rule;
}

}  // namespace equipoise
