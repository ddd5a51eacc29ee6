// Eigenvalues of the equations' Jacobian at a balanced state.
#include "equipoise/explain/balanced_motion.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/base/angles.hpp"
#include "equipoise/math/dense.hpp"
#include "equipoise/model/linearisation.hpp"

namespace equipoise {

namespace {

// Rounding moves an eigenvalue by about 1e-15; that of a double zero by its square root.
constexpr double zero_rate = 1e-7;

Eigen::MatrixXd balanced_jacobian(const model::Parameters& p, double speed, const double* phi) {
  return model::jacobian(p, speed, model::centred_state(p, phi).data());
}

// Slowest first; of a continuum without its own zeros.
std::vector<std::complex<double>> balanced_eigenvalues(const Eigen::MatrixXd& jacobian, bool family) {
  const Eigen::VectorXcd all = dense::eigenvalues(jacobian);
  std::vector<std::complex<double>> rates(all.begin(), all.end());
  if (family) {
    // n - 2 directions along the continuum (one more where nothing is to be balanced), n at most.
    std::sort(rates.begin(), rates.end(), [](auto a, auto b) { return std::abs(a) < std::abs(b); });
    const auto own = std::find_if(rates.begin(), rates.end(), [](auto v) { return std::abs(v) > zero_rate; });
    rates.erase(rates.begin(), own);
  }
  std::sort(rates.begin(), rates.end(),
            [](auto a, auto b) { return a.real() != b.real() ? a.real() > b.real() : a.imag() > b.imag(); });
  return rates;
}

model::Parameters with_drag(model::Parameters p, double factor) {
  for (double& beta : p.drag) beta *= factor;
  return p;
}

}  // namespace

std::optional<std::array<double, model::max_balls>> balanced_angles(const model::BalancedStates& states,
                                                                    const model::Parameters& p) {
  using Kind = model::BalancedStates::Kind;
  if (states.kind == Kind::none) return std::nullopt;
  if (states.kind == Kind::isolated) return states.angles.front();
  std::array<double, model::max_balls> phi{};
  for (const double reach : {0.5, 0.9, 0.2}) {  // spread evenly on the light side, then moved into balance
    for (int i = 0; i < p.balls; ++i)
      phi[static_cast<std::size_t>(i)] = pi + reach * pi * (2.0 * (i + 0.5) / p.balls - 1.0);
    if (model::project_to_balanced(p, phi.data())) return phi;
  }
  return std::nullopt;
}

void linearise(Explanation& e) {
  const model::Parameters& p = e.study.parameters;
  const auto skip = [&](const char* why) { e.no_motion = why; };
  if (!e.speed) return skip("the motor, not the study, sets the final speed");
  if (*e.speed == 0.0) return skip("the rotor does not turn");
  if (p.gravity > 0.0) return skip("with gravity the balls do not rest in the turning frame");
  if (!p.race_is_centred()) return skip("in a race off the shaft the balls find no rest where the rotor is centred");
  if (!p.isotropic()) return skip("with supports that differ in x and y the linear system changes with the angle");
  if (e.balanced.kind == model::BalancedStates::Kind::none) return skip("there is no balanced state");
  const auto angles = balanced_angles(e.balanced, p);
  if (!angles) return skip("no balanced state was found among the continuum of them");
  const bool family = e.balanced.kind == model::BalancedStates::Kind::family;
  BalancedMotion motion;
  motion.angles = *angles;
  motion.eigenvalues = balanced_eigenvalues(balanced_jacobian(p, *e.speed, angles->data()), family);
  motion.slowest_rate = motion.eigenvalues.front().real();
  motion.stable = motion.slowest_rate < -least_rate;
  constexpr double part = 1e-3;  // of the drag: a difference far above rounding, far below what bends the curve
  const DragScan scan(p, *e.speed, *angles, family);
  motion.drag_sensitivity = (scan.slowest(1.0 + part) - scan.slowest(1.0 - part)) / (2.0 * part * motion.slowest_rate);
  if (p.rolls) {
    model::Parameters sliding = p;
    sliding.rolls = false;
    motion.slowest_if_sliding = DragScan(sliding, *e.speed, *angles, family).slowest(1.0);
  }
  e.motion = motion;
}

DragScan::DragScan(const model::Parameters& p, double speed, const std::array<double, model::max_balls>& angles,
                   bool family)
    : without_(balanced_jacobian(with_drag(p, 0.0), speed, angles.data())),
      drag_(balanced_jacobian(p, speed, angles.data()) - without_),
      family_(family) {}

double DragScan::slowest(double factor) const {
  return balanced_eigenvalues(without_ + factor * drag_, family_).front().real();
}

std::optional<DragScan::Range> DragScan::range(double share, double low, double high) const {
  // Twenty a decade: the fastest drag is a kink of the curve, which has few others and none so near.
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
