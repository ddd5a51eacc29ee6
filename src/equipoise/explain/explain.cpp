// Critical speeds, what the balls can cancel, the linearised way into balance, and warnings.
#include "equipoise/explain/explain.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "equipoise/base/angles.hpp"
#include "equipoise/discovery/cost.hpp"
#include "equipoise/discovery/horizon.hpp"
#include "equipoise/discovery/undecided.hpp"
#include "equipoise/explain/advice.hpp"
#include "equipoise/explain/balanced_motion.hpp"
#include "equipoise/explain/quantity_table.hpp"
#include "equipoise/explain/rules_of_thumb.hpp"
#include "equipoise/fates/machine_runner.hpp"
#include "equipoise/model/ball_drag.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/report/engineering.hpp"
#include "equipoise/spin_up/initial_state.hpp"

namespace equipoise {

namespace {
using study::Dimension;

constexpr double root_two = 1.4142135623730951;

double last_speed(const RampSetting& s) {
  if (s.profile == Profile::constant) return s.speed;
  if (s.profile == Profile::points) return s.speeds.back();
  return s.final;
}

std::optional<double> last_time(const RampSetting& s) {
  if (s.profile == Profile::ramp) return s.duration;
  if (s.profile == Profile::trapezoid) return s.fall_until;
  if (s.profile == Profile::points) return s.times.back();
  return std::nullopt;
}

std::optional<double> final_speed(const Study& study) {
  return study.speed.driven() ? study.motor().final_speed() : last_speed(study.speed);
}

BareVibration bare_vibration(const model::Parameters& p, double speed) {
  BareVibration v;
  for (std::size_t i = 0; i < 2; ++i) {
    const double damping = p.damping[i] * speed;
    v.displacement[i] = p.eccentricity * speed * speed / std::hypot(p.stiffness[i] - speed * speed, damping);
    v.force[i] = v.displacement[i] * std::hypot(p.stiffness[i], damping);
  }
  return v;
}

class Warnings {
 public:
  Warnings(Explanation& e, const BallDetails& balls) : e_(e), p_(e.study.parameters) {
    speed();
    unbalance();
    sag();
    if (e.motion) motion(*e.motion);
    patience();
    release();
    room(balls);
    if (e.gravity_ratio && *e.gravity_ratio >= 1.0)
      warn("at the final speed the weight of a ball exceeds its centrifugal force: it falls off the top of the race");
    if (!p_.balls_collide() && p_.restitution != model::Parameters{}.restitution)
      warn("balancer.restitution has no effect: balls of no contact_angle pass each other");
    if (p_.total_mass() >= 1.0) warn("the balls together are heavier than the rotor");
    if (e.reynolds && *e.reynolds > 1.0)
      warn(
          "the Reynolds number of a ball that slips is {:.3g}: Stokes' drag holds below about 1, so only near "
          "balance, where balls creep, and is too small before",
          *e.reynolds);
  }

 private:
  template <class... T>
  void warn(fmt::format_string<T...> format, T&&... values) {
    e_.warnings.push_back(fmt::format(format, std::forward<T>(values)...));
  }

  void speed() {
    if (!e_.speed) return;
    const double w = std::abs(*e_.speed);
    const double lowest = std::min(e_.critical_with_balls[0], e_.critical_with_balls[1]);
    const double highest = std::max(e_.critical_alone[0], e_.critical_alone[1]);
    if (w < lowest)
      warn(
          "the final speed is below the critical speed: there balls gather on the heavy side and add to the unbalance");
    if (w >= 0.9 * lowest && w <= 1.1 * highest)
      warn("the final speed is within 10 % of a critical speed: vibration is near its largest");
    else if (w >= lowest && w < root_two * highest)
      warn(
          "the final speed is less than sqrt(2) times the critical speed: vibration without balls exceeds twice the "
          "eccentricity unless damping is strong, and balance is often unstable");
  }

  void sag() {
    const std::optional<double>& room = e_.study.limits.displacement;
    if (!room || e_.sag <= *room) return;
    warn("the rotor sags by {} under its weight, more than limits.displacement, {}, which counts from where it rests",
         length(e_.sag), length(*room));
  }

  std::string length(double value) const {
    return e_.study.scales ? engineering(value * e_.study.scales->length, Dimension::length)
                           : fmt::format("{:.5g}", value);
  }

  void unbalance() {
    const double lambda = p_.eccentricity;
    if (lambda > e_.largest_unbalance)
      warn("the unbalance is {:.3g} times what all balls together can cancel", lambda / e_.largest_unbalance);
    else if (lambda < e_.least_unbalance)
      warn("the unbalance is below the least that these unequal balls can balance: they would add one of their own");
    else if (lambda > 0.9 * e_.largest_unbalance)
      warn("the unbalance is within 10 % of the most that the balls can cancel");
    else if (e_.least_unbalance > 0.0 && lambda < 1.1 * e_.least_unbalance)
      warn("the unbalance is within 10 % of the least that these unequal balls can balance");
  }

  void motion(const BalancedMotion& m) {
    if (!m.stable) {
      if (m.slowest_rate <= least_rate)
        warn("balance is not linearly stable at the final speed: its largest rate is 0");
      else
        warn("balance is unstable at the final speed: the balls do not stay there; {} drag makes it less so",
             m.drag_sensitivity < 0.0 ? "more" : "less");
      return;
    }
    const double constant = -1.0 / m.slowest_rate;
    const bool overdamped = m.drag_sensitivity < 0.0;
    const char* remedy = overdamped ? "less drag would settle them sooner" : "more drag would settle them sooner";
    if (constant > 1000.0)
      warn("the balls settle slowly, in more than 1000 units of time: drag too {}; {}", overdamped ? "high" : "low",
           remedy);
    else if (e_.spin_up && constant > *e_.spin_up)
      warn("the balls settle more slowly than the rotor spins up; {}", remedy);
    if (overdamped) warn("the balls are overdamped: {}", remedy);
    if (!p_.balls_collide()) return;
    for (int i = 0; i < p_.balls; ++i)
      for (int j = 0; j < i; ++j)
        if (std::abs(std::remainder(m.angles[static_cast<std::size_t>(i)] - m.angles[static_cast<std::size_t>(j)],
                                    2.0 * pi)) < p_.contact_angle) {
          warn("balls {} and {} would overlap in the balanced state shown", j + 1, i + 1);
          return;
        }
  }

  // What basin and attractors will make of it.
  void patience() {
    const StartCost cost = start_cost(e_.study);
    const char* key = cost.by_drag ? "balancer.drag" : "rotor.damping";
    if (!cost.bearable())
      warn("stiff: with {} = {:.4g} a start takes about {:.1g} steps; basin and attractors refuse above {:.3g}", key,
           cost.cause, cost.steps, cost.allowed);
    const Horizon horizon = choose_horizon(e_.study);
    if (!horizon.long_enough())
      warn("{}: of starts that are followed for {:.6g} many may stay undecided", slowness_text(horizon), horizon.time);
  }

  // Whether a motor comes to the speed at which the balls are let go hangs on where they are held: some are tried.
  void release() {
    const Study& study = e_.study;
    if (!study.speed.driven() || !study.release.speed) return;
    const std::vector<UndecidedEnd> ends =
        MachineRunner(study, nullptr).look_at(starts_of(study, sampler_of(study), study.sampling.seed, 0, 8));
    const auto held =
        std::count_if(ends.begin(), ends.end(), [](const UndecidedEnd& end) { return end.what == Restlessness::held; });
    if (held > 0) warn("of {} starts tried {} never let their balls go: {}", ends.size(), held, held_text(ends));
  }

  void room(const BallDetails& balls) {
    const std::vector<double> widths = ball_widths(e_.study, balls);
    const double angle = std::accumulate(widths.begin(), widths.end(), 0.0);
    if (angle > 2.0 * pi)
      warn("{} balls of this size do not fit into the race: there is room for {:.0f} % of them", p_.balls,
           100.0 * 2.0 * pi / angle);
  }

  Explanation& e_;
  const model::Parameters& p_;
};

}  // namespace

Explanation explain(const Study& study, const BallDetails& balls) {
  Explanation e;
  const model::Parameters& p = study.parameters;
  e.study = study;
  e.quantities = quantity_table(study);
  for (std::size_t i = 0; i < 2; ++i) e.critical_alone[i] = std::sqrt(p.stiffness[i]);
  e.critical_with_balls = rules::critical_speeds(p);
  e.speed = final_speed(study);
  e.spin_up = study.speed.driven() ? last_time(study.speed.torque.target) : last_time(study.speed);
  const double heaviest = *std::max_element(p.mass.begin(), p.mass.begin() + p.balls);
  e.largest_unbalance = p.total_mass();
  e.least_unbalance = std::max(0.0, 2.0 * heaviest - p.total_mass());
  model::Parameters weightless = p;
  weightless.gravity = 0.0;
  e.balanced = model::balanced_states(weightless);
  e.sag = 0.0 - model::static_sag(p);
  if (p.gravity > 0.0 && e.speed && *e.speed != 0.0) e.gravity_ratio = p.gravity / (*e.speed * *e.speed);
  linearise(e);
  if (e.speed) e.bare = bare_vibration(p, *e.speed);
  if (e.speed && study.scales && balls.oil_viscosity && balls.oil_density) {
    const double slip =
        std::max(0.0, std::abs(*e.speed) - std::min(e.critical_with_balls[0], e.critical_with_balls[1]));
    const double largest = *std::max_element(balls.diameter.begin(), balls.diameter.end());
    e.reynolds =
        model::reynolds_number(*balls.oil_density, slip * study.scales->velocity(), largest, *balls.oil_viscosity);
  }
  e.advice = advice(e, ball_widths(study, balls));
  Warnings(e, balls);
  return e;
}

}  // namespace equipoise
