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
#include "equipoise/fates/machine_runner.hpp"
#include "equipoise/math/dense.hpp"
#include "equipoise/model/ball_drag.hpp"
#include "equipoise/model/linearisation.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/report/engineering.hpp"
#include "equipoise/spin_up/initial_state.hpp"

namespace equipoise {

namespace {
using study::Dimension;

// Rounding moves an eigenvalue by about 1e-15; that of a double zero by its square root.
constexpr double zero_rate = 1e-7;
constexpr double least_rate = 1e-9;  // slower than any horizon shows
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

// The table of quantities, in the order of the study's tables.
class Quantities {
 public:
  explicit Quantities(const Study& study) : study_(study), p_(study.parameters) {
    rotor();
    balancer();
    if (study.speed.driven())
      motor();
    else
      ramp(study.speed, "speed");
    conditions();
  }
  std::vector<ExplainedQuantity> rows;

 private:
  void add(const std::string& symbol, const std::string& name, double value, std::optional<Dimension> dimension) {
    rows.push_back({symbol, name, value, dimension});
  }

  void add_pair(const std::string& symbol, const std::string& name, const std::array<double, 2>& values,
                std::optional<Dimension> d) {
    if (values[0] == values[1]) return add(symbol, name, values[0], d);
    add(symbol + "_x", name + ", x", values[0], d);
    add(symbol + "_y", name + ", y", values[1], d);
  }

  void add_balls(const std::string& symbol, const std::string& name, const std::array<double, model::max_balls>& values,
                 std::optional<Dimension> d) {
    const bool same = std::all_of(values.begin(), values.begin() + p_.balls, [&](double v) { return v == values[0]; });
    if (same) return add(symbol, name + (p_.balls > 1 ? ", each" : ""), values[0], d);
    for (int i = 0; i < p_.balls; ++i)
      add(fmt::format("{}_{}", symbol, i + 1), fmt::format("{} {}", name, i + 1), values[static_cast<std::size_t>(i)],
          d);
  }

  void rotor() {
    add("M", "rotor mass", 1.0, Dimension::mass);
    add("R", "race radius, to the ball centres", 1.0, Dimension::length);
    add("omega_c", "critical speed, sqrt(k/M)", 1.0, Dimension::speed);
    add("1/omega_c", "unit of time", 1.0, Dimension::time);
    add_pair("k, kappa", "support stiffness", p_.stiffness, Dimension::stiffness);
    add_pair("c, zeta", "support damping", p_.damping, Dimension::damping);
    add_pair("c/(2 sqrt(kM))", "damping ratio",
             {0.5 * p_.damping[0] / std::sqrt(p_.stiffness[0]), 0.5 * p_.damping[1] / std::sqrt(p_.stiffness[1])},
             std::nullopt);
    add("eps, lambda", "eccentricity", p_.eccentricity, Dimension::length);
    add("M eps", "unbalance", p_.eccentricity, Dimension::unbalance);
    if (p_.gravity > 0.0) add("g, G", "gravity", p_.gravity, Dimension::acceleration);
    if (p_.inertia > 0.0) add("I_C, iota", "moment of inertia", p_.inertia, Dimension::inertia);
  }

  void balancer() {
    add("n", "balls", p_.balls, std::nullopt);
    add_balls("m, mu", "ball mass", p_.mass, Dimension::mass);
    add("N", "mass of all balls", p_.total_mass(), Dimension::mass);
    add_balls("beta", "ball drag D/(m R^2 omega_c)", p_.drag, std::nullopt);
    std::array<double, model::max_balls> torque{};
    for (std::size_t i = 0; i < torque.size(); ++i) torque[i] = p_.drag[i] * p_.mass[i];
    add_balls("D", "ball drag, torque for a rate", torque, Dimension::gain);
    if (p_.rolls) {
      add_balls("r", "radius of a ball, which rolls", p_.ball_radius, Dimension::length);
      add("m_eff/m", "inertia of a ball along the race", p_.inertia_along_race(), std::nullopt);
    }
    if (!p_.race_is_centred()) {
      add("e_x", "race off the shaft, x", p_.race_offset[0], Dimension::length);
      add("e_y", "race off the shaft, y", p_.race_offset[1], Dimension::length);
    }
    if (p_.balls_stick()) {
      add_balls("rolling", "rolling resistance", p_.rolling, std::nullopt);
      add_balls("stiction", "resistance at rest", p_.stiction, std::nullopt);
    }
    if (p_.balls_collide()) {
      add("contact", "angle between touching balls", p_.contact_angle, Dimension::angle);
      add("restitution", "of ball on ball", p_.restitution, std::nullopt);
    }
  }

  void ramp(const RampSetting& s, const std::string& name) {
    if (s.profile == Profile::constant) return add("Omega", name, s.speed, Dimension::speed);
    if (s.profile == Profile::points) {
      add("Omega", "final " + name, s.speeds.back(), Dimension::speed);
      return add("t", "reached at", s.times.back(), Dimension::time);
    }
    add("Omega_0", "initial " + name, s.initial, Dimension::speed);
    if (s.profile == Profile::trapezoid) {
      add("Omega_p", "highest " + name, s.peak, Dimension::speed);
      add("T_0", "reached at", s.rise_until, Dimension::time);
      add("T_1", "held until", s.hold_until, Dimension::time);
    }
    add("Omega", "final " + name, s.final, Dimension::speed);
    add(s.profile == Profile::trapezoid ? "T_2" : "T_0", "reached at",
        s.profile == Profile::trapezoid ? s.fall_until : s.duration, Dimension::time);
  }

  void motor() {
    const TorqueSetting& t = study_.speed.torque;
    add("psi'(0)", "initial speed", study_.speed.initial, Dimension::speed);
    using Kind = model::MotorLaw::Kind;
    if (t.kind == Kind::linear && !t.by_stall) {
      add("tau_0", "motor torque at rest", t.constant, Dimension::torque);
      add("slope", "motor torque for a speed", t.slope, Dimension::gain);
      if (t.until) add("until", "motor off at", *t.until, Dimension::time);
    } else if (t.by_stall) {
      add("tau_0", "motor torque at rest", t.stall, Dimension::torque);
      add("Omega_n", "no-load speed", t.no_load_speed, Dimension::speed);
    } else if (t.kind == Kind::table) {
      add("tau_max", "largest motor torque", *std::max_element(t.values.begin(), t.values.end()), Dimension::torque);
    } else {
      add("K_p", "control gain", t.gain, Dimension::gain);
      if (t.integral != 0.0) add("K_i", "integral gain, torque", t.integral, Dimension::torque);
      if (t.limit) add("tau_max", "torque limit", *t.limit, Dimension::torque);
      ramp(t.target, "target speed");
    }
  }

  void conditions() {
    if (study_.release.speed) add("Omega_r", "release at speed", *study_.release.speed, Dimension::speed);
    if (study_.release.time || !study_.speed.driven())
      add("t_r", "release at time", study_.release.time ? *study_.release.time : study_.release_time(),
          Dimension::time);
    const Horizon horizon = choose_horizon(study_);
    add("horizon", horizon.given ? "undecided after" : "undecided after (chosen)", horizon.time, Dimension::time);
    const Limits& l = study_.limits;
    if (l.displacement) add("limit", "displacement", *l.displacement, Dimension::length);
    if (l.force) add("limit", "support force", *l.force, Dimension::force);
    if (l.velocity) add("limit", "velocity, rms", *l.velocity, Dimension::velocity);
    if (l.settled) add("settled", "displacement below", *l.settled, Dimension::length);
  }

  const Study& study_;
  const model::Parameters& p_;
};

// Eigenvalues at one balanced state, slowest first; of a continuum without its own zeros.
std::vector<std::complex<double>> eigenvalues(const model::Parameters& p, double speed, const double* phi,
                                              bool family) {
  const Eigen::VectorXcd all = dense::eigenvalues(model::jacobian(p, speed, model::centred_state(p, phi).data()));
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

// A member of the continuum far from its ends: balls spread evenly on the light side, then moved into balance.
bool member_of_family(const model::Parameters& p, std::array<double, model::max_balls>& phi) {
  for (const double reach : {0.5, 0.9, 0.2}) {
    for (int i = 0; i < p.balls; ++i)
      phi[static_cast<std::size_t>(i)] = pi + reach * pi * (2.0 * (i + 0.5) / p.balls - 1.0);
    if (model::project_to_balanced(p, phi.data())) return true;
  }
  return false;
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
  const bool family = e.balanced.kind == model::BalancedStates::Kind::family;
  BalancedMotion motion;
  if (!family)
    motion.angles = e.balanced.angles.front();
  else if (!member_of_family(p, motion.angles))
    return skip("no balanced state was found among the continuum of them");
  motion.eigenvalues = eigenvalues(p, *e.speed, motion.angles.data(), family);
  motion.slowest_rate = motion.eigenvalues.front().real();
  motion.stable = motion.slowest_rate < -least_rate;
  constexpr double part = 1e-3;  // of the drag: a difference far above rounding, far below what bends the curve
  std::array<double, 2> rate{};
  for (const int side : {0, 1}) {
    model::Parameters other = p;
    for (double& beta : other.drag) beta *= side ? 1.0 + part : 1.0 - part;
    rate[static_cast<std::size_t>(side)] = eigenvalues(other, *e.speed, motion.angles.data(), family).front().real();
  }
  motion.drag_sensitivity = (rate[1] - rate[0]) / (2.0 * part * motion.slowest_rate);
  if (p.rolls) {
    model::Parameters sliding = p;
    sliding.rolls = false;
    motion.slowest_if_sliding = eigenvalues(sliding, *e.speed, motion.angles.data(), family).front().real();
  }
  e.motion = motion;
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
    double angle = p_.contact_angle * p_.balls;
    if (!balls.diameter.empty() && e_.study.scales) {
      angle = 0.0;
      for (const double d : balls.diameter) angle += 2.0 * std::asin(0.5 * d / e_.study.scales->length);
    }
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
  e.quantities = Quantities(study).rows;
  for (std::size_t i = 0; i < 2; ++i) {
    e.critical_alone[i] = std::sqrt(p.stiffness[i]);
    e.critical_with_balls[i] = std::sqrt(p.stiffness[i] / (1.0 + p.total_mass()));
  }
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
  Warnings(e, balls);
  return e;
}

}  // namespace equipoise
