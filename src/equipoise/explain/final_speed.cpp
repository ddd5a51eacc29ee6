// Prescribed speeds, and where a motor's torque and what balance takes are equal.
#include "equipoise/explain/final_speed.hpp"

#include "equipoise/model/held_speed.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/spin_up/run_up.hpp"

namespace equipoise {

std::optional<double> last_time(const RampSetting& s) {
  if (s.profile == Profile::ramp) return s.duration;
  if (s.profile == Profile::trapezoid) return s.fall_until;
  if (s.profile == Profile::points) return s.times.back();
  return std::nullopt;
}

FinalSpeed final_speed(const Study& study) {
  const model::System system = study.system();
  if (system.prescribed()) return {.speed = system.speed(), .words = ""};
  if (system.coasts())
    return {.speed = rotor_alone(study, 0.0, std::nullopt).speed,
            .words = "which the rotor has when its motor lets go if nothing has braked it; then nothing holds it"};
  if (const auto speed = model::held_speed(system))
    return {.speed = *speed,
            .words = system.parameters().race_is_centred()
                         ? "where the motor's torque vanishes: a balanced rotor needs none"
                         : "where the motor gives what the supports' dampers take in balance"};
  return {.speed = std::nullopt,
          .words = std::string("the motor's ") + model::holds_no_speed,
          .speeds_up = true};
}

}  // namespace equipoise
