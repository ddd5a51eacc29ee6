// One function for each kind of study, and random additions to it.
#include "drawn_study.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <random>

#include <fmt/format.h>

#include "equipoise/machine/model/system.hpp"

namespace equipoise::audit {

namespace {

// The standard library's distributions differ between libraries; its generators do not.
class Dice {
 public:
  Dice(std::uint64_t seed, int number) : bits_(seed * 1000003 + static_cast<std::uint64_t>(number)) {
    bits_.discard(16);
  }
  double even(double low, double high) { return low + (high - low) * 0x1p-53 * static_cast<double>(bits_() >> 11); }
  // Uniform in the logarithm.
  double scale(double low, double high) { return std::exp(even(std::log(low), std::log(high))); }
  int whole(int low, int high) { return low + static_cast<int>(even(0.0, 1.0) * (high - low + 1)); }
  bool chance(double p) { return even(0.0, 1.0) < p; }
  double one_of(std::initializer_list<double> values) {
    return *(values.begin() + whole(0, static_cast<int>(values.size()) - 1));
  }

 private:
  std::mt19937_64 bits_;
};

// Three digits: people read and type a study that failed.
double rounded(double value) {
  if (value == 0.0) return 0.0;
  const double unit = std::pow(10.0, 2.0 - std::floor(std::log10(std::fabs(value))));
  return std::round(value * unit) / unit;
}

void equal_balls(Study& s, int balls, double mass, double drag) {
  s.parameters.balls = balls;
  std::fill_n(s.parameters.mass.begin(), balls, rounded(mass));
  std::fill_n(s.parameters.drag.begin(), balls, rounded(drag));
}

// A rotor that its balls can balance four times in five.
void ordinary(Study& s, Dice& d, int balls) {
  s.parameters.eccentricity = rounded(d.scale(0.002, 0.05));
  s.parameters.damping.fill(rounded(d.scale(0.05, 1.5)));
  equal_balls(s, balls, s.parameters.eccentricity * d.scale(0.85, 6.0) / balls, d.scale(0.008, 0.4));
}

void constant(Study& s, double speed) {
  s.speed.profile = Profile::constant;
  s.speed.speed = rounded(speed);
}

void at_constant_speed(Study& s, Dice& d, int balls, double slowest, double fastest) {
  ordinary(s, d, balls);
  constant(s, d.even(slowest, fastest));
}

void unequal(Study& s, Dice& d) {
  for (int i = 0; i < s.parameters.balls; ++i) {
    s.parameters.mass[i] = rounded(s.parameters.mass[i] * d.even(0.7, 1.3));
    if (d.chance(0.5)) s.parameters.drag[i] = rounded(s.parameters.drag[i] * d.even(0.6, 1.6));
  }
}

// The mean stays 1, and so does the unit of time, whether the study is in physical units or not.
void anisotropic(Study& s, Dice& d) {
  const double part = 0.01 * d.whole(2, 25);
  s.parameters.stiffness = {1.0 - part, 1.0 + part};
  if (d.chance(0.5)) s.parameters.damping[1] = rounded(s.parameters.damping[0] * d.even(0.5, 2.0));
}

void driven(Study& s, Dice& d, double initial) {
  s.speed.profile = Profile::torque;
  s.parameters.inertia = rounded(d.scale(0.3, 2.0));
  s.speed.initial = initial == 0.0 ? 0.0 : rounded(initial);
}

void ordinary_driven(Study& s, Dice& d) {
  ordinary(s, d, 2);
  driven(s, d, 0.0);
}

// A torque that falls to zero at `slowest` to 4 critical speeds.
void falling_torque(Study& s, Dice& d, double slowest) {
  s.speed.torque.slope = -rounded(d.scale(0.02, 0.2));
  s.speed.torque.constant = rounded(-s.speed.torque.slope * d.even(slowest, 4.0));
}

// Time that a torque needs to bring rotor and balls to 1.8 to 4 critical speeds.
double time_to_speed(const Study& s, Dice& d, double torque) {
  return rounded(d.even(1.8, 4.0) * (s.parameters.inertia + s.parameters.total_mass()) / torque);
}

using Draw = void (*)(Study&, Dice&);
struct Kind {
  const char* name;
  Draw draw;
};

const Kind kinds[] = {
    {"constant", [](Study& s, Dice& d) { at_constant_speed(s, d, 2, 1.4, 5.0); }},
    {"motor, linear",
     [](Study& s, Dice& d) {
       ordinary(s, d, 2);
       driven(s, d, d.chance(0.5) ? 0.0 : d.even(1.0, 3.0));
       falling_torque(s, d, 1.6);
     }},
    {"three to eight balls", [](Study& s, Dice& d) { at_constant_speed(s, d, d.whole(3, 8), 1.8, 4.0); }},
    {"gravity",
     [](Study& s, Dice& d) {
       ordinary(s, d, d.whole(1, 4));
       s.parameters.gravity = rounded(d.scale(1e-3, 0.05));
       constant(s, d.even(1.8, 4.0));
     }},
    {"ramp, balls let go on the way",
     [](Study& s, Dice& d) {
       ordinary(s, d, 2);
       s.speed.profile = Profile::ramp;
       s.speed.final = rounded(d.even(1.8, 4.0));
       s.speed.duration = rounded(d.scale(5.0, 400.0));
       if (d.chance(0.7)) s.release.speed = rounded(s.speed.final * d.even(0.2, 1.0));
     }},
    {"stiction",
     [](Study& s, Dice& d) {
       at_constant_speed(s, d, d.whole(2, 4), 1.8, 4.0);
       for (int i = 0; i < s.parameters.balls; ++i) {
         s.parameters.rolling[i] = i > 0 ? s.parameters.rolling[0] : rounded(d.scale(1e-4, 5e-3));
         s.parameters.stiction[i] = i > 0 ? s.parameters.stiction[0] : s.parameters.rolling[0] * d.one_of({1.0, 2.0});
       }
     }},
    {"motor by stall torque",
     [](Study& s, Dice& d) {
       ordinary_driven(s, d);
       s.speed.torque.by_stall = true;
       s.speed.torque.no_load_speed = rounded(d.even(1.8, 4.0));
       s.speed.torque.stall = rounded(d.scale(0.02, 0.5));
     }},
    {"unequal balls",
     [](Study& s, Dice& d) {
       ordinary(s, d, d.whole(2, 3));
       unequal(s, d);
       constant(s, d.even(1.6, 4.5));
     }},
    {"race off-centre",
     [](Study& s, Dice& d) {
       ordinary(s, d, 2);
       const double offset = s.parameters.eccentricity * d.scale(1e-4, 0.5);
       s.parameters.race_offset = {rounded(offset * d.even(-1.0, 1.0)), rounded(offset)};
       constant(s, d.even(1.8, 4.0));
     }},
    {"anisotropic supports",
     [](Study& s, Dice& d) {
       ordinary(s, d, d.whole(1, 3));
       anisotropic(s, d);
       constant(s, d.even(1.8, 4.0));
     }},
    {"motor switched off",
     [](Study& s, Dice& d) {
       ordinary_driven(s, d);
       s.speed.torque.constant = rounded(d.even(0.05, 0.3));
       s.speed.torque.until = time_to_speed(s, d, s.speed.torque.constant);
     }},
    {"backwards",
     [](Study& s, Dice& d) {
       ordinary(s, d, 2);
       constant(s, -d.even(1.6, 4.5));
     }},
    {"balls that collide",
     [](Study& s, Dice& d) {
       ordinary(s, d, d.whole(2, 4));
       s.parameters.contact_angle = rounded(d.even(0.05, 0.5));
       s.parameters.restitution = 0.1 * d.whole(0, 10);
       constant(s, d.even(1.8, 4.0));
     }},
    {"trapezoid",
     [](Study& s, Dice& d) {
       ordinary(s, d, 2);
       s.speed.profile = Profile::trapezoid;
       s.speed.peak = rounded(d.even(3.0, 5.0));
       s.speed.final = rounded(d.even(1.8, 3.0));
       s.speed.rise_until = rounded(d.scale(5.0, 80.0));
       s.speed.hold_until = rounded(s.speed.rise_until + d.even(5.0, 200.0));
       s.speed.fall_until = rounded(s.speed.hold_until + d.even(5.0, 80.0));
     }},
    {"run-up by a Hill function",
     [](Study& s, Dice& d) {
       ordinary(s, d, 2);
       s.speed.profile = Profile::hill;
       s.speed.final = rounded(d.even(1.8, 4.0));
       s.speed.half_time = rounded(d.scale(3.0, 60.0));
       s.speed.exponent = rounded(d.even(1.0, 5.0));
     }},
    {"motor by its curve, with a load",
     [](Study& s, Dice& d) {
       ordinary_driven(s, d);
       TorqueSetting& t = s.speed.torque;
       t.kind = model::MotorLaw::Kind::curve;
       const double fast = rounded(d.even(1.8, 4.0)), most = rounded(d.scale(0.05, 0.5));
       t.speeds = {0.0, rounded(0.5 * fast), rounded(0.85 * fast), fast};
       t.values = {rounded(most * d.even(0.5, 0.9)), rounded(most * d.even(0.4, 0.8)), most, 0.0};
       s.speed.load = {rounded(most * d.even(0.0, 0.05)), rounded(most * d.even(0.0, 0.1)),
                       rounded(most * d.even(0.0, 0.3)), fast};
     }},
    {"motor by a table",
     [](Study& s, Dice& d) {
       ordinary_driven(s, d);
       s.speed.torque.kind = model::MotorLaw::Kind::table;
       const double full = rounded(d.even(0.05, 0.3)), rise = time_to_speed(s, d, full);
       s.speed.torque.times = {0.0, rise, 1.5 * rise};
       s.speed.torque.values = {full, full, 0.0};
     }},
    {"tiny",
     [](Study& s, Dice& d) {
       s.parameters.eccentricity = rounded(d.scale(1e-9, 1e-5));
       s.parameters.damping.fill(rounded(d.scale(0.05, 1.0)));
       equal_balls(s, 2, s.parameters.eccentricity * d.scale(0.7, 4.0), d.scale(0.02, 0.2));
       constant(s, d.even(1.6, 4.0));
     }},
    {"drag that overdamps",
     [](Study& s, Dice& d) {
       ordinary(s, d, 2);
       equal_balls(s, 2, s.parameters.mass[0], d.scale(1.0, 30.0));
       constant(s, d.even(1.8, 5.0));
     }},
    {"speed control",
     [](Study& s, Dice& d) {
       ordinary_driven(s, d);
       TorqueSetting& t = s.speed.torque;
       t.kind = model::MotorLaw::Kind::control;
       t.gain = rounded(d.scale(0.05, 1.0));
       t.integral = d.chance(0.5) ? 0.0 : rounded(d.scale(0.002, 0.05));
       if (d.chance(0.5)) t.limit = rounded(d.even(0.1, 0.5));
       t.target.profile = Profile::ramp;
       t.target.final = rounded(d.even(1.8, 4.0));
       t.target.duration = rounded(d.scale(5.0, 100.0));
     }},
    {"one ball", [](Study& s, Dice& d) { at_constant_speed(s, d, 1, 1.2, 5.0); }},
    {"heavy",
     [](Study& s, Dice& d) {
       s.parameters.eccentricity = rounded(d.scale(0.1, 2.0));
       s.parameters.damping.fill(rounded(d.scale(0.2, 4.0)));
       equal_balls(s, 2, s.parameters.eccentricity * d.scale(0.55, 1.5), d.scale(0.05, 0.5));
       constant(s, d.even(1.8, 6.0));
     }},
    {"motor backwards",
     [](Study& s, Dice& d) {
       ordinary_driven(s, d);
       falling_torque(s, d, 1.8);
       s.speed.torque.constant *= -1.0;
     }},
    {"points",
     [](Study& s, Dice& d) {
       ordinary(s, d, 2);
       s.speed.profile = Profile::points;
       const double rise = d.scale(5.0, 100.0);
       s.speed.times = {0.0, rounded(rise), rounded(rise + d.even(5.0, 50.0))};
       s.speed.speeds = {rounded(d.even(0.0, 0.5)), rounded(d.even(2.0, 5.0)), rounded(d.even(1.8, 4.0))};
     }},
    {"gravity on a machine",
     [](Study& s, Dice& d) {
       ordinary(s, d, 2);
       s.parameters.gravity = rounded(d.scale(1e-4, 0.02));
       if (d.chance(0.5)) {
         s.parameters.contact_angle = rounded(d.even(0.05, 0.5));
         constant(s, d.even(1.8, 4.0));
       } else {
         driven(s, d, 0.0);
         s.speed.torque.slope = -0.1;
         s.speed.torque.constant = rounded(d.even(0.18, 0.4));
       }
     }},
    {"below resonance",
     [](Study& s, Dice& d) {
       ordinary(s, d, 2);
       constant(s, d.scale(0.05, 1.0));
     }},
    {"starts from a box",
     [](Study& s, Dice& d) {
       at_constant_speed(s, d, 2, 1.8, 4.0);
       const double r = rounded(d.scale(0.01, 0.3)), v = rounded(d.scale(0.01, 0.6));
       s.sampling.box.x = s.sampling.box.y = SamplingBox::Side{-r, r};
       if (d.chance(0.5)) s.sampling.box.x_dot = s.sampling.box.y_dot = SamplingBox::Side{-v, v};
       if (d.chance(0.5)) s.sampling.box.phi_dot = SamplingBox::Side{-3.0, 3.0};
     }},
    {"published law",
     [](Study& s, Dice& d) {
       ordinary(s, d, 2);
       s.speed.profile = Profile::ramp;
       s.speed.law = model::SpeedLaw::published;
       s.speed.final = rounded(d.even(1.8, 4.0));
       s.speed.duration = rounded(d.scale(5.0, 200.0));
     }},
};

// Random additions to any study.
void season(Study& s, Dice& d) {
  const bool at_rest = s.speed.driven() || s.speed.profile != Profile::constant;
  if (d.chance(0.12) && s.parameters.balls > 1) unequal(s, d);
  if (d.chance(0.10) && s.parameters.isotropic() && s.system().simple()) anisotropic(s, d);
  if (d.chance(0.10) && s.parameters.race_is_centred() && !s.system().simple())
    s.parameters.race_offset = {0.0, rounded(0.1 * s.parameters.eccentricity)};
  if (d.chance(0.15)) s.initial.psi = rounded(d.even(0.0, 6.0));
  if (d.chance(0.10) && !at_rest) s.initial.x = rounded(s.parameters.eccentricity * d.even(-3.0, 3.0));
  if (d.chance(0.10)) {
    s.parameters.rolls = true;
    s.parameters.ball_radius.fill(rounded(d.even(0.02, 0.2)));
  }
  if (d.chance(0.3) && s.system().events().contact && !s.system().events().stick) {
    s.parameters.rolling.fill(rounded(d.scale(1e-4, 1e-2)));
    s.parameters.stiction = s.parameters.rolling;
  }
}

}  // namespace

const int kind_count = static_cast<int>(std::size(kinds));

DrawnStudy draw_study(std::uint64_t seed, int number) {
  Dice dice(seed, number);
  const Kind& kind = kinds[number % kind_count];
  DrawnStudy drawn;
  drawn.number = number;
  drawn.kind = kind.name;
  kind.draw(drawn.study, dice);
  season(drawn.study, dice);
  drawn.study.sampling.seed = static_cast<std::uint64_t>(1 + number);
  // As in a study file: what is not stated takes its default.
  const std::string name = fmt::format("audit-{}-{}.toml", seed, number);
  drawn.study = parse_study(to_toml(drawn.study), name);
  return drawn;
}

}  // namespace equipoise::audit
