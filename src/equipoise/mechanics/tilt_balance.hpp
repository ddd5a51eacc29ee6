// Balance of a rotor that tilts: its balls cancel the static and the couple unbalance together.
#pragma once

#include <vector>

#include "equipoise/mechanics/balanced_state.hpp"
#include "equipoise/model/parameters.hpp"

namespace equipoise::model {

/// Solutions of lambda e^{i beta_0} + sum mu_i e^{i phi_i} = 0 and chi (Jt - Jp) + sum mu_i z_i e^{i phi_i} = 0. With
/// balls in two planes each plane closes a polygon of its own; with more, angles are searched for.
BalancedStates tilt_balanced_states(const Parameters& p);

/// The balls of one plane, and a plane rotor with these balls and the unbalance that they have to cancel.
struct BallPlane {
  double at;  ///< along the shaft
  std::vector<int> balls;
  Parameters rotor;
};
/// Of a rotor whose balls run in one plane or two. Empty for more planes, which have no share of their own, and where
/// balls in one plane leave a couple.
std::vector<BallPlane> planes_of_balls(const Parameters& p);

/// As project_to_balanced().
bool project_to_tilt_balanced(const Parameters& p, double* phi);

/// As cancelling_freedom().
int tilt_cancelling_freedom(const Parameters& p);

}  // namespace equipoise::model
