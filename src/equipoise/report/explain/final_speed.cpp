// Prescribed speeds, and where a motor's torque and what balance takes are equal.
#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/machine/mechanics/sustained_speed.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/report/explain/parts.hpp"

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
    e.speed_words = "which the rotor has when its motor lets go if nothing has braked it; then nothing holds it";
  } else if (!system.prescribed()) {
    const bool centred = system.parameters().race_is_centred(), loaded = !e.study.speed.load.is_none();
    e.speed_words = loaded && centred ? "where the motor gives what the load takes: a balanced rotor needs no more"
                    : loaded          ? "where the motor gives what load and supports' dampers take in balance"
                    : centred         ? "where the motor's torque vanishes: a balanced rotor needs none"
                                      : "where the motor gives what the supports' dampers take in balance";
  }
}

}  // namespace equipoise
