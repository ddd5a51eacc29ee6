// Compares the final speed with the critical one, also at the ends of uncertain values.
#include "equipoise/study/contents/below_resonance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "equipoise/core/base/error.hpp"
#include "equipoise/machine/mechanics/forced_vibration.hpp"

namespace equipoise {

namespace {

// The final speed over the lowest critical speed; infinite if the rule does not hold for such a rotor.
double over_critical(const Study& study) {
  const model::Parameters& p = study.parameters;
  const double speed = study.speed.driven() ? 0.0 : std::fabs(study.speed_profile().final_speed());
  if (p.balls == 0 || p.tilts() || p.balls_stick() || !p.race_is_centred() || speed == 0.0) return INFINITY;
  const auto critical = model::critical_speeds(p);
  return speed / std::min(critical[0], critical[1]);
}

// The largest that draws may have: speed, stiffness and masses enter as factors, so what each value adds by itself
// multiplies.
double most_over_critical(const Study& study) {
  std::vector<double> medians;
  for (const UncertainValue& value : study.uncertain.values) medians.push_back(value.taken());
  const double here = over_critical(study);
  double most = here;
  for (std::size_t k = 0; k < medians.size() && std::isfinite(most); ++k) {
    double worst = here;
    for (const double end : study.uncertain.values[k].ends()) {
      std::vector<double> values = medians;
      values[k] = end;
      worst = std::max(worst, over_critical(drawn_study(study, values)));
    }
    most *= worst / here;
  }
  return most;
}

}  // namespace

bool runs_below_resonance(const Study& study) try {
  return most_over_critical(study) < 1.0;
} catch (const InputError&) {  // an end that makes no study: nothing is claimed
  return false;
}

}  // namespace equipoise
