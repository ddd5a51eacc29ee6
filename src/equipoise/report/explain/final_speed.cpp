// Prescribed speeds, and where a motor's torque and what balance takes are equal.
#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/machine/mechanics/sustained_speed.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/report/explain/parts.hpp"
#include "equipoise/report/words/explain.hpp"

namespace equipoise {

std::optional<double> last_time(const RampSetting& s) {
  if (s.profile == Profile::constant || s.profile == Profile::torque) return std::nullopt;
  return ramp_profile(s).settled_time();
}

void put_final_speed(Explanation& e) {
  const model::System system = e.study.system();
  e.speed = speed_in_balance(e.study, system);
  if (!e.speed) {
    e.speed_words = std::string("the motor's ") + model::holds_no_speed;
    e.speeds_up = true;
  } else if (system.coasts()) {
    e.speed_words = words::explain::coasting;
  } else if (!system.prescribed()) {
    const bool centred = system.parameters().race_is_centred(), loaded = !e.study.speed.load.is_none();
    e.speed_words = loaded && centred ? words::explain::where_torque_is_load
                    : loaded          ? words::explain::where_torque_is_load_and_dampers
                    : centred         ? words::explain::where_torque_vanishes
                                      : words::explain::where_torque_is_dampers;
  }
}

}  // namespace equipoise
