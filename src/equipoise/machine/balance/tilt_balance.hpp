// Balance of a tilting rotor: its balls cancel the static and the couple unbalance together.
#pragma once

#include <vector>

#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::model {

/// Solutions of lambda e^{i beta_0} + sum mu_i e^{i phi_i} = 0 and chi (Jt - Jp) + sum mu_i z_i e^{i phi_i} = 0. With
/// balls in two planes each plane closes a polygon of its own; with more, angles are searched for.
BalancedStates tilt_balanced_states(const Parameters& p);

/// The places along the shaft at which balls run, rising.
std::vector<double> planes_of(const Parameters& p);

/// The balls of one plane, and a plane rotor with these balls and the unbalance that they have to cancel.
struct BallPlane {
  double at;  ///< along the shaft
  std::vector<int> balls;
  Parameters rotor;
  double turn = 0.0;  ///< from the rotor's angles to those of the plane rotor
};
/// Of a rotor whose balls run in one plane or two. Empty for more planes, which have no share of their own, and where
/// balls in one plane leave a couple.
std::vector<BallPlane> planes_of_balls(const Parameters& p);

/// As project_to_balanced().
bool project_to_tilt_balanced(const Parameters& p, double* phi);

/// How far the balls are from too light or too unlike to balance the rotor: 0 or more where a balanced state exists.
/// The least over the planes of U + sum mu_i - 2 max(U, mu_i), with the plane's share U of the unbalance. For balls in
/// one plane that leave a couple, what is left of it, negative; with more than two planes not a number.
double tilt_balance_margin(const Parameters& p);

/// As cancelling_freedom().
int tilt_cancelling_freedom(const Parameters& p);

}  // namespace equipoise::model
