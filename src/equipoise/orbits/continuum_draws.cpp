// Angles without pattern, those kept that nearly balance.
#include "equipoise/orbits/continuum_draws.hpp"

#include <complex>

#include "equipoise/base/angles.hpp"
#include "equipoise/model/balanced_state.hpp"
#include "equipoise/model/unbalance.hpp"

namespace equipoise {

bool ContinuumDraws::next(std::array<double, model::max_balls>& phi) {
  constexpr int most = 200000;
  const double near = 0.05 * p_.all_unbalances();
  for (int k = 0; k < most; ++k) {
    for (int i = 0; i < p_.balls; ++i) phi[i] = two_pi * random_.uniform();
    if (std::abs(model::unbalance(p_, phi.data())) < near && model::project_to_balanced(p_, phi.data())) return true;
  }
  return false;
}

bool ContinuumDraws::beside(std::array<double, model::max_balls>& phi, double distance) {
  for (int i = 0; i < p_.balls; ++i) phi[i] += distance * random_.normal();
  return model::project_to_balanced(p_, phi.data());
}

}  // namespace equipoise
