// Eigenvalues of the equations' Jacobian at a balanced state, over drag.
#include "equipoise/report/explain/parts.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/results/commands/explanation.hpp"

namespace equipoise {

namespace {

model::Parameters with_drag(model::Parameters p, double factor) {
  for (double& beta : p.drag) beta *= factor;
  return p;
}

Eigen::MatrixXd balanced_jacobian(const model::Parameters& p, double speed, const double* phi) {
  const model::System system(p, speed);
  return model::jacobian(system, model::balanced_state(system, speed, phi));
}

}  // namespace

DragScan::DragScan(const model::Parameters& p, double speed, const std::array<double, model::max_balls>& angles,
                   bool family)
    : without_(balanced_jacobian(with_drag(p, 0.0), speed, angles.data())),
      drag_(balanced_jacobian(p, speed, angles.data()) - without_),
      freedom_(family ? model::balanced_freedom({p, speed}) : 0) {}

double DragScan::slowest(double factor) const {
  return without_continuum(dense::eigenvalues(without_ + factor * drag_), freedom_, zero_rate).front().real();
}

std::optional<DragScan::Range> DragScan::range(double share, double low, double high) const {
  // Twenty a decade, finer than the distance of the curve's kinks, one of which is the fastest drag.
  constexpr double grid = 1.122018454301963;
  double best = low, rate = slowest(low);
  for (double factor = low * grid; factor <= high; factor *= grid) {
    const double here = slowest(factor);
    if (here < rate) {
      rate = here;
      best = factor;
    }
  }
  if (rate > -least_rate) return std::nullopt;
  best = fastest_within(best / grid, best * grid);
  rate = slowest(best);
  return Range{end_of(best, low, share * rate), best, end_of(best, high, share * rate)};
}

// By golden sections of the logarithm, to three digits of the factor.
double DragScan::fastest_within(double low, double high) const {
  constexpr double golden = 0.6180339887498949;
  double a = std::log(low), b = std::log(high);
  for (int k = 0; k < 10; ++k) {
    const double left = b - golden * (b - a), right = a + golden * (b - a);
    if (slowest(std::exp(left)) < slowest(std::exp(right)))
      b = right;
    else
      a = left;
  }
  return std::exp(0.5 * (a + b));
}

// From `best` towards `end`, where the slowest rate first exceeds `rate`.
double DragScan::end_of(double best, double end, double rate) const {
  const double step = end > best ? 1.2 : 1.0 / 1.2;
  double inside = best, outside = best;
  while (slowest(outside) <= rate) {
    inside = outside;
    if (step > 1.0 ? outside >= end : outside <= end) return end;
    outside = step > 1.0 ? std::min(outside * step, end) : std::max(outside * step, end);
  }
  for (int k = 0; k < 12; ++k) {  // a factor of 1.2 to five digits
    const double middle = std::sqrt(inside * outside);
    (slowest(middle) <= rate ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace equipoise
