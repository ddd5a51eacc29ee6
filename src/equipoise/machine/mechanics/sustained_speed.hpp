// The speed that a motor sustains.
#pragma once

#include <optional>

#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise::model {

/// balanced_speed() if a motor sustains it. Empty at a prescribed speed, for a coasting rotor, and for a motor whose
/// last torque speeds the rotor up for ever.
inline std::optional<double> sustained_speed(const System& system) {
  if (system.prescribed() || system.coasts()) return std::nullopt;
  const DriveSegment& m = system.drive().motor;
  const std::optional<double> speed = balanced_speed(system);
  const bool holds = m.integral != 0.0 || !m.is_linear() || m.slope < 0.0 || (speed && *speed * m.constant > 0.0);
  return holds ? speed : std::nullopt;
}

/// Message about a motor that holds no speed, to follow "the" or "the motor's".
inline constexpr const char* holds_no_speed =
    "last torque never ends, and a balanced rotor needs none: no speed is held";

/// Whether the motor's last torque acts for good and holds no speed: a balanced rotor then speeds up without end.
inline bool speeds_up_for_ever(const System& system) {
  return !system.prescribed() && !system.coasts() && !sustained_speed(system);
}

}  // namespace equipoise::model
