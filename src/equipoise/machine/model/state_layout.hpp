// The place of each variable in a state, and what it is: one description of every state that is integrated, stored or
// shown. A new variable of the rotor is a member here, and a line in state_layout.cpp.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::model {

/// x, y, u, v, phi_1..phi_n, q_1..q_n of parameters.hpp, then those of psi, psi' and the integral of a speed control's
/// error that belong to the state, in this order. A tilting rotor has four more at the end: its shaft's slopes sx,
/// sy along the rotating axes, and their INERTIAL rates in rotating components, us = sx' - psi' sy, vs = sy' + psi' sx.
/// The section at z along the shaft has its centre at (x + z sx, y + z sy).
///
/// Three layouts are in use: that of a System; machine_layout(), which has them all; and held_layout()
/// (held_state.hpp), in which one pair of numbers stands for all balls, as if there were one.
struct StateLayout {
  int balls = 0;
  int psi = -1, speed = -1, error = -1;  ///< places; -1: not part of the state
  int tilt = -1;                         ///< also; of sx, which sy, us and vs follow
  int size = model::dimension(0);

  static constexpr StateLayout of(int balls, bool psi, bool speed, bool error, bool tilt = false) {
    StateLayout layout{balls};
    layout.size = model::dimension(balls);
    if (psi) layout.psi = layout.size++;
    if (speed) layout.speed = layout.size++;
    if (error) layout.error = layout.size++;
    if (tilt) layout.tilt = layout.size;
    if (tilt) layout.size += 4;
    return layout;
  }
  /// The same with room for another number of balls.
  constexpr StateLayout with_balls(int n) const { return of(n, psi >= 0, speed >= 0, error >= 0, tilt >= 0); }
};

/// Of a rotor with a ball balancer however it is driven.
constexpr StateLayout machine_layout(int balls, bool tilt = false) {
  return StateLayout::of(balls, true, true, true, tilt);
}
inline StateLayout machine_layout(const Parameters& p) { return machine_layout(p.balls, p.tilts()); }
inline constexpr int largest_state = machine_layout(max_balls, true).size;

/// Copies the rotor's variables that both layouts have, the centre's and the balls' excepted.
template <class From, class To>
constexpr void copy_drive(const StateLayout& from, const From* y, const StateLayout& to, To* z) {
  for (int StateLayout::*place : {&StateLayout::psi, &StateLayout::speed, &StateLayout::error})
    if (from.*place >= 0 && to.*place >= 0) z[to.*place] = y[from.*place];
  if (from.tilt >= 0 && to.tilt >= 0) std::copy_n(y + from.tilt, 4, z + to.tilt);
}
/// Copies all variables that both layouts have; they have as many balls.
template <class From, class To>
constexpr void copy_state(const StateLayout& from, const From* y, const StateLayout& to, To* z) {
  std::copy_n(y, dimension(from.balls), z);
  copy_drive(from, y, to, z);
}

struct StateVariable {
  std::string name;       ///< "x", "phi_1", "phi_dot_1", "psi_dot"
  std::string unit;       ///< what a dimensionless 1 is: "R", "R omega_c", "rad", "omega_c"
  std::string long_name;  ///< with the frame it is measured in
  bool angle = false;     ///< 2 pi more is the same
};
/// In the order of the state.
std::vector<StateVariable> state_variables(const StateLayout& layout);

}  // namespace equipoise::model
