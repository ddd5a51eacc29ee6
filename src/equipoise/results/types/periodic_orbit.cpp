// Stability from Floquet multipliers.
#include "equipoise/results/types/periodic_orbit.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

namespace equipoise {

// Multipliers of a continuum are 1 to integration errors; the slowest others seen differ from it by 1e-4.
static constexpr double on_circle = 1e-7;

bool contracts(const Eigen::VectorXcd& multipliers, int units_allowed) {
  int units = 0;
  for (const std::complex<double>& m : multipliers) {
    if (units_allowed > 0 && std::abs(m - 1.0) < on_circle)
      ++units;
    else if (!(std::abs(m) < 1.0))
      return false;
  }
  return units <= units_allowed;
}

bool PeriodicOrbit::stable() const { return contracts(decays()); }

double PeriodicOrbit::slowest_rate() const {
  const Eigen::VectorXcd all = decays();
  return all.size() > 0 ? std::log(std::max(1e-300, std::abs(all[0]))) / period : -1.0;
}

}  // namespace equipoise
