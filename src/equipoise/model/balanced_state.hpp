// Where the balls cancel the unbalance: existence and angles of the balanced states.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "equipoise/model/parameters.hpp"

namespace equipoise::model {

/// Solutions of lambda + sum mu_i e^{i phi_i} = 0, x = y = 0, all at rest in the rotating frame.
struct BalancedStates {
  enum class Kind {
    none,      ///< the balls cannot cancel the unbalance (`reason` says why)
    isolated,  ///< finitely many; `angles` lists them
    family,    ///< a continuum (three balls or more, or no unbalance at all)
  };
  Kind kind = Kind::none;
  std::vector<std::array<double, max_balls>> angles;
  std::string reason;
};

/// Exists if and only if 2 max(lambda, mu_1..mu_n) <= lambda + sum mu_i (polygon inequality) and there is no gravity.
BalancedStates balanced_states(const Parameters& p);

/// A member of the family near the ball angles `phi`: Newton's method with the least change of angles. False if it does
/// not converge, in which case `phi` is left somewhere on the way. Whole turns stay, however many.
bool project_to_balanced(const Parameters& p, double* phi);

}  // namespace equipoise::model
