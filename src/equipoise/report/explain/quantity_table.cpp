// Every number of a study by symbol and name.
#include "equipoise/report/explain/parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "equipoise/classification/rotor_family/horizon.hpp"

namespace equipoise {

namespace {
using study::Dimension;

class QuantityTable {
 public:
  explicit QuantityTable(const Study& study) : study_(study), p_(study.parameters) {
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
    const bool critical = !p_.tilts() && p_.stiffness[0] == p_.stiffness[1];
    add("omega_c", critical ? "critical speed, sqrt(k/M)" : "unit of speed, sqrt(k/M)", 1.0, Dimension::speed);
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
    if (p_.tilts()) tilt();
  }

  void tilt() {
    const model::Tilt& t = p_.tilt;
    // Angles count from where a positive couple unbalance points.
    const char* angle = t.couple() < 0.0 ? "its angle" : "its angle from the couple unbalance";
    add("beta_0", angle, p_.eccentricity_angle, Dimension::angle);
    add("J_t", "transverse moment of inertia", t.transverse_inertia, Dimension::inertia);
    add("J_p", "polar moment of inertia", t.polar_inertia, Dimension::inertia);
    add("chi", "misalignment of the principal axis", t.misalignment, Dimension::angle);
    add("chi (J_t - J_p)", "couple unbalance", t.couple(), Dimension::inertia);
    const auto both = [](const auto& m, std::size_t k) { return std::array{m[0][k], m[1][k]}; };
    add_pair("k_12", "support force for a slope", both(t.stiffness, 0), Dimension::force);
    add_pair("k_22", "support moment for a slope", both(t.stiffness, 1), Dimension::torque);
    add_pair("c_12", "damper force for a rate of slope", both(t.damping, 0), Dimension::tilt_damping);
    add_pair("c_22", "damper moment for a rate of slope", both(t.damping, 1), Dimension::gain);
    for (std::size_t b = 0; b < study_.bearings.size(); ++b)
      add(fmt::format("z_b{}", b + 1), fmt::format("place of bearing {}", b + 1), study_.bearings[b],
          Dimension::length);
  }

  void balancer() {
    add("n", "balls", p_.balls, std::nullopt);
    if (p_.balls == 0) return;
    add_balls("m, mu", "ball mass", p_.mass, Dimension::mass);
    add("N", "mass of all balls", p_.total_mass(), Dimension::mass);
    add_balls("beta", "ball drag D/(m R^2 omega_c)", p_.drag, std::nullopt);
    std::array<double, model::max_balls> torque{};
    for (std::size_t i = 0; i < torque.size(); ++i) torque[i] = p_.drag[i] * p_.mass[i];
    add_balls("D", "ball drag, torque for a rate", torque, Dimension::gain);
    if (p_.tilts()) add_balls("z", "place of a ball's race", p_.tilt.plane, Dimension::length);
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
    if (s.profile == Profile::hill) {
      add("Omega", "final " + name, s.final, Dimension::speed);
      add("t_half", "half of it at", s.half_time, Dimension::time);
      add("n", "exponent of the Hill function", s.exponent, std::nullopt);
      return add("T", "reached at", study_.speed_profile().settled_time(), Dimension::time);
    }
    add("Omega_0", "initial " + name, s.initial, Dimension::speed);
    if (s.profile == Profile::trapezoid) {
      add("Omega_p", "highest " + name, s.peak, Dimension::speed);
      add("T_0", "reached at", s.rise_until, Dimension::time);
      add("T_1", "held until", s.hold_until, Dimension::time);
    }
    add("Omega", "final " + name, s.final, Dimension::speed);
    const bool falls = s.profile == Profile::trapezoid;
    add(falls ? "T_2" : "T_0", "reached at", falls ? s.fall_until : s.duration, Dimension::time);
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
    } else if (t.kind == Kind::curve) {
      const auto most = std::max_element(t.values.begin(), t.values.end());
      add("tau_0", "motor torque at rest", model::drive_segments(study_.motor()).front().motor_torque(0.0, 0.0, 0.0),
          Dimension::torque);
      add("tau_max", "largest motor torque", *most, Dimension::torque);
      add("Omega_max", "at speed", t.speeds[static_cast<std::size_t>(most - t.values.begin())], Dimension::speed);
    } else if (t.kind == Kind::table) {
      add("tau_max", "largest motor torque", *std::max_element(t.values.begin(), t.values.end()), Dimension::torque);
    } else {
      add("K_p", "control gain", t.gain, Dimension::gain);
      if (t.integral != 0.0) add("K_i", "integral gain, torque", t.integral, Dimension::torque);
      if (t.limit) add("tau_max", "torque limit", *t.limit, Dimension::torque);
      ramp(t.target, "target speed");
    }
    const LoadSetting& load = study_.speed.load;
    if (load.is_none()) return;
    if (load.constant > 0.0) add("tau_c", "load, constant", load.constant, Dimension::torque);
    if (load.linear > 0.0) add("tau_l", "load, with the speed", load.linear, Dimension::torque);
    if (load.quadratic > 0.0) add("tau_q", "load, with its square", load.quadratic, Dimension::torque);
    if (load.linear + load.quadratic > 0.0) add("Omega_l", "the last at speed", *load.at, Dimension::speed);
  }

  void conditions() {
    if (study_.release.speed) add("Omega_r", "release at speed", *study_.release.speed, Dimension::speed);
    if (p_.balls > 0 && (study_.release.time || !study_.speed.driven()))
      add("t_r", "release at time", study_.release.time ? *study_.release.time : study_.release_time(),
          Dimension::time);
    const Horizon horizon = choose_horizon(study_);
    if (p_.balls > 0)
      add("horizon", horizon.given ? "undecided after" : "undecided after (chosen)", horizon.time, Dimension::time);
    const Limits& l = study_.limits;
    if (l.displacement) add("limit", "displacement", *l.displacement, Dimension::length);
    if (l.force) add("limit", "support force", *l.force, Dimension::force);
    if (l.velocity) add("limit", "velocity, rms of both directions", *l.velocity, Dimension::velocity);
    if (l.dynamic_force) add("limit", "support force, dynamic", *l.dynamic_force, Dimension::force);
    if (l.velocity_one_direction)
      add("limit", "velocity, rms, one direction", *l.velocity_one_direction, Dimension::velocity);
    if (l.hand_arm) add("limit", "a_hv", *l.hand_arm, Dimension::acceleration);
    if (l.settling_time) add("limit", "settling time", *l.settling_time, Dimension::time);
    if (l.residual) add("limit", "unbalance left", *l.residual, Dimension::unbalance);
    if (l.grade) add("limit", "e omega of the unbalance left", *l.grade, Dimension::velocity);
    if (l.clearance) add("limit", "clearance", *l.clearance, Dimension::length);
    if (l.settled) add("settled", "displacement below", *l.settled, Dimension::length);
  }

  const Study& study_;
  const model::Parameters& p_;
};

}  // namespace

std::vector<ExplainedQuantity> quantity_table(const Study& study) { return QuantityTable(study).rows; }

}  // namespace equipoise
