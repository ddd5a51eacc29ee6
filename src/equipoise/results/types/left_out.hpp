// What linear theory leaves out of a rotor, as bits.
#pragma once

namespace equipoise {

enum LeftOut : unsigned char {
  dry_friction_left_out = 1,
  gravity_left_out = 2,
  unequal_supports_left_out = 4,  ///< supports have the mean of x and y
  motor_left_out = 8,             ///< the speed is held
};

}  // namespace equipoise
