// Gaps between balls on level sets.
#include "equipoise/classification/balanced_regions/touching.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <Eigen/Core>

#include "equipoise/classification/balanced_regions/balanced_region.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/dense.hpp"

namespace equipoise {

namespace {
// Of balls i and k, beyond touching.
double gap(const model::Parameters& p, const std::array<double, model::max_balls>& phi, int i, int k) {
  return std::fabs(wrapped(phi[i] - phi[k])) - p.contact_angle;
}
}  // namespace

double touching_level(const model::System& system, const BalancedRegion& region) {
  const model::Parameters& p = system.parameters();
  double level = std::numeric_limits<double>::infinity();
  if (!p.balls_collide()) return level;
  const Eigen::MatrixXd inverse = dense::inverse(form_of(region));
  for (int i = 0; i < p.balls; ++i)
    for (int k = 0; k < i; ++k) {
      const double room = std::max(gap(p, region.phi, i, k), 0.0);
      const int a = model::index::phi(i), b = model::index::phi(k);
      level = std::min(level, room * room / (inverse(a, a) + inverse(b, b) - 2.0 * inverse(a, b)));
    }
  return level;
}

}  // namespace equipoise
