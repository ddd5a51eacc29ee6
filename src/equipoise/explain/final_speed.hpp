// The speed that a study comes to in the end.
#pragma once

#include <optional>
#include <string>

#include "equipoise/study/study.hpp"

namespace equipoise {

struct FinalSpeed {
  std::optional<double> speed;  ///< none: nothing holds one
  std::string words;            ///< of a motor: why it is that; without `speed`, why there is none
  bool speeds_up = false;       ///< for ever, in balance
};

/// Of a motor: where a balanced rotor needs what the motor gives; of one that lets go of its rotor the speed that the
/// rotor has then if nothing has braked it.
FinalSpeed final_speed(const Study& study);

/// When a ramp function comes to its last speed; none: it does not change.
std::optional<double> last_time(const RampSetting& s);

}  // namespace equipoise
