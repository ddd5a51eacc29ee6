// The standard acceleration of gravity, where a machine's own is not stated.
#pragma once

namespace equipoise {

inline constexpr double standard_gravity = 9.80665;  ///< m/s^2

}  // namespace equipoise
