// Steps that an explicit method needs to be stable, times how long slow balls take.
#include "equipoise/classification/start_runs/checks.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/core/base/error.hpp"

namespace equipoise {

namespace {

// DOP853 is stable on the negative real axis to about -6. Its accuracy at 1e-6 needs one or two steps a radian.
constexpr double stable_to = 6.0, steps_a_radian = 1.5;
StartCost cost_of(const Study& study) {
  const model::Parameters& p = study.parameters;
  StartCost cost;
  const double drag = *std::max_element(p.drag.begin(), p.drag.begin() + p.balls);
  const double damping = std::max(p.damping[0], p.damping[1]), slowing = drag / p.inertia_along_race();
  cost.by_drag = slowing >= damping;
  cost.fastest = std::max(slowing, damping);
  cost.cause = cost.by_drag ? drag : damping;
  const Horizon horizon = choose_horizon(study);
  const double slowest = std::max(horizon.rates.approach, horizon.rates.growth);
  // A chosen horizon gives up slow starts undecided, so it does not limit the work that they need.
  cost.time = slowest > 0.0 ? 1.0 / slowest : horizon.time;
  if (horizon.given) cost.time = std::min(cost.time, horizon.time);
  const double turning = steps_a_radian * std::max(1.0, std::fabs(study.speed_profile().final_speed()));
  cost.steps = cost.time * std::max(turning, cost.fastest / stable_to);
  return cost;
}

}  // namespace

bool StartCost::bearable() const { return fastest <= stable_to * steps_a_radian || steps <= most_steps; }

StartCost start_cost(const Study& study) {
  StartCost cost = cost_of(study);
  cost.allowed = cost.cause;
  if (cost.bearable()) return cost;
  // Between parts of the stated value that are powers of ten apart.
  double low = 1e-60, high = 1.0;
  for (int k = 0; k < 40; ++k) {
    const double part = std::sqrt(low * high);
    Study other = study;
    if (cost.by_drag)
      for (double& drag : other.parameters.drag) drag *= part;
    else
      for (double& damping : other.parameters.damping) damping *= part;
    (cost_of(other).bearable() ? low : high) = part;
  }
  cost.allowed = low * cost.cause;
  return cost;
}

void check_cost(const Study& study) {
  const StartCost cost = start_cost(study);
  if (cost.bearable()) return;
  throw InputError(
      study.name, cost.by_drag ? "balancer.drag" : "rotor.damping", fmt::format("{:.6g}", cost.cause),
      fmt::format(
          "makes the equations stiff: about {:.1g} steps per start, {:.2g} units of time with {:.3g} steps each; "
          "basin and attractors take up to {:.3g} here (or a shorter numerics.horizon)",
          cost.steps, cost.time, cost.fastest / stable_to, cost.allowed));
}

}  // namespace equipoise
