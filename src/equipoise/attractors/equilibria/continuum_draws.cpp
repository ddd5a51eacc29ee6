// Draws ball angles, and keeps those that nearly balance.
#include "equipoise/attractors/equilibria/continuum_draws.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/balance/cancelling.hpp"
#include "equipoise/machine/balance/room_in_race.hpp"
#include "equipoise/machine/model/unbalance.hpp"

namespace equipoise {

bool ContinuumDraws::balance(std::array<double, model::max_balls>& phi) const {
  return model::project_to_balanced(p_, phi.data()) && model::has_room(p_, phi.data());
}

bool ContinuumDraws::next(std::array<double, model::max_balls>& phi) {
  // Fewer if balls collide, as the walk can take over.
  const int most = p_.balls_collide() ? 10000 : 200000;
  const double near = 0.05 * p_.all_unbalances();
  for (int k = 0; k < most && !walking_; ++k) {
    for (int i = 0; i < p_.balls; ++i) phi[i] = two_pi * random_.uniform();
    if (p_.balls_collide()) model::make_room(p_, phi.data());
    const bool nearly = p_.tilts() || std::abs(model::unbalance(p_, phi.data())) < near;
    if (nearly && balance(phi)) return true;
  }
  if (!walking_) {
    if (!p_.balls_collide()) return false;
    place_ = model::fan(p_, std::vector<double>(static_cast<std::size_t>(p_.balls), p_.contact_angle));
    if (!balance(place_)) return false;
    walking_ = true;
  }
  // Strides adapt to the room between balls, so that half of them are accepted.
  constexpr int strides = 16;
  for (int k = 0; k < strides; ++k) {
    phi = place_;
    const bool taken = beside(phi, stride_);
    if (taken) place_ = phi;
    stride_ = std::clamp(taken ? 1.4 * stride_ : 0.7 * stride_, 1e-7, 1.0);
  }
  phi = place_;
  return true;
}

bool ContinuumDraws::beside(std::array<double, model::max_balls>& phi, double distance) {
  for (int i = 0; i < p_.balls; ++i) phi[i] += distance * random_.normal();
  return balance(phi);
}

}  // namespace equipoise
