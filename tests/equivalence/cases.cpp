// The table of studies behind the equivalence tests.
#include "cases.hpp"

#include <cmath>
#include <functional>

namespace cases {

using equipoise::Profile;
using equipoise::Study;
using equipoise::model::SpeedLaw;

namespace {

// Two equal balls on isotropic supports, free from the start at constant speed.
Study plain(int balls) {
  Study s;
  s.parameters.balls = balls;
  s.parameters.mass.fill(balls == 1 ? 0.03 : 0.1 / balls);
  s.parameters.drag.fill(0.25);
  s.speed.speed = 2.4;
  for (int i = 0; i < equipoise::model::max_balls; ++i) s.initial.phi[i] = 0.4 + 1.9 * i;
  return s;
}

void make_unequal(Study& s) {
  for (int i = 0; i < equipoise::model::max_balls; ++i) {
    s.parameters.mass[i] *= 1.0 + 0.15 * ((3 * i) % 5 - 2);
    s.parameters.drag[i] *= 1.0 + 0.2 * ((2 * i) % 5 - 1);
  }
}

void make_anisotropic(Study& s) {
  s.parameters.damping = {0.5, 0.35};
  s.parameters.stiffness = {1.0, 1.3};
}

// In motion at t = 0, and so are free balls.
void set_in_motion(Study& s, bool balls) {
  s.initial.psi = 0.7;
  s.initial.x = 0.03;
  s.initial.y = -0.02;
  s.initial.x_dot = 0.05;
  s.initial.y_dot = 0.04;
  if (balls)
    for (int i = 0; i < equipoise::model::max_balls; ++i) s.initial.phi_dot[i] = 0.3 - 0.13 * i;
}

void make_everything(Study& s, bool free_at_once) {
  make_unequal(s);
  make_anisotropic(s);
  s.parameters.gravity = 0.02;
  set_in_motion(s, free_at_once);
}

void make_rolling(Study& s) {
  s.parameters.rolls = true;
  for (int i = 0; i < s.parameters.balls; ++i) s.parameters.ball_radius[i] = 0.05 + 0.03 * i;
}

void ramp(Study& s, double from, double to, double duration, SpeedLaw law) {
  s.speed.profile = Profile::ramp;
  s.speed.initial = from;
  s.speed.final = to;
  s.speed.duration = duration;
  s.speed.law = law;
}

void trapezoid(Study& s, double peak, double to, double t0, double t1, double t2, SpeedLaw law) {
  s.speed.profile = Profile::trapezoid;
  s.speed.peak = peak;
  s.speed.final = to;
  s.speed.rise_until = t0;
  s.speed.hold_until = t1;
  s.speed.fall_until = t2;
  s.speed.law = law;
}

void points(Study& s, SpeedLaw law) {
  s.speed.profile = Profile::points;
  s.speed.times = {0.0, 10.0, 22.5, 30.0, 55.0};
  s.speed.speeds = {0.5, 2.0, 2.0, 2.9, 2.5};
  s.speed.law = law;
}

void hill(Study& s, double to, double half_time, double exponent, double until) {
  s.speed.profile = Profile::hill;
  s.speed.final = to;
  s.speed.half_time = half_time;
  s.speed.exponent = exponent;
  s.speed.until = until;
}

class Table {
 public:
  void add(const std::string& name, int balls, double release, const std::function<void(Study&)>& change) {
    Study s = plain(balls);
    change(s);
    s.name = name;
    cases_.push_back({name, s, release});
  }
  std::vector<Case> take() { return std::move(cases_); }

 private:
  std::vector<Case> cases_;
};

void add_constant_speed(Table& table) {
  for (int n : {1, 2, 3, 5, 8}) {
    table.add("constant_equal_" + std::to_string(n), n, 0.0, [](Study&) {});
    table.add("constant_everything_" + std::to_string(n), n, 0.0, [](Study& s) { make_everything(s, true); });
  }
  table.add("constant_unequal", 2, 0.0, make_unequal);
  for (int n : {1, 2, 4, 8})
    table.add("constant_everything_rolling_" + std::to_string(n), n, 0.0, [](Study& s) {
      make_everything(s, true);
      make_rolling(s);
    });
  table.add("constant_rolling", 3, 0.0, make_rolling);
  table.add("constant_anisotropic", 2, 0.0, make_anisotropic);
  table.add("constant_gravity", 2, 0.0, [](Study& s) { s.parameters.gravity = 0.05; });
  table.add("constant_in_motion", 2, 0.0, [](Study& s) { set_in_motion(s, true); });
  table.add("constant_backward", 3, 0.0, [](Study& s) { s.speed.speed = -2.4; });
  table.add("constant_undamped_supports", 2, 0.0, [](Study& s) { s.parameters.damping = {0.0, 0.0}; });
  table.add("constant_balanced_rotor", 3, 0.0, [](Study& s) { s.parameters.eccentricity = 0.0; });
  table.add("constant_released_late", 3, 12.3, [](Study& s) {
    make_everything(s, false);
    s.release.time = 12.3;
  });
}

void add_varying_speed(Table& table, SpeedLaw law, const std::string& suffix) {
  table.add("ramp_released_at_end" + suffix, 2, 30.0, [&](Study& s) { ramp(s, 0.0, 2.4, 30.0, law); });
  table.add("ramp_released_by_speed" + suffix, 2, 27.5, [&](Study& s) {
    ramp(s, 0.0, 2.4, 30.0, law);
    s.release.speed = 2.2;
  });
  table.add("ramp_rolling_released_at_once" + suffix, 2, 0.0, [&](Study& s) {
    ramp(s, 1.8, 2.6, 10.0, law);
    s.release.time = 0.0;
    make_rolling(s);
  });
  table.add("ramp_released_at_once" + suffix, 3, 0.0, [&](Study& s) {
    ramp(s, 1.8, 2.6, 40.0, law);
    s.release.time = 0.0;
    set_in_motion(s, true);
  });
  table.add("ramp_down_released_late" + suffix, 2, 45.0, [&](Study& s) {
    ramp(s, 3.0, 2.3, 40.0, law);
    s.release.time = 45.0;
  });
  table.add("trapezoid" + suffix, 2, 20.0, [&](Study& s) { trapezoid(s, 3.0, 2.4, 20.0, 40.0, 60.0, law); });
  table.add("trapezoid_released_falling" + suffix, 3, 50.0, [&](Study& s) {
    trapezoid(s, 3.0, 2.4, 20.0, 40.0, 60.0, law);
    s.release.time = 50.0;
  });
  table.add("points" + suffix, 2, 55.0, [&](Study& s) { points(s, law); });
  table.add("points_released_by_speed" + suffix, 3, 26.25, [&](Study& s) {
    points(s, law);
    s.release.speed = 2.45;
  });
  table.add("points_released_within" + suffix, 2, 26.0, [&](Study& s) {
    points(s, law);
    s.release.time = 26.0;
  });
  for (int n : {1, 2, 3, 5, 8}) {
    const std::string name = "everything_" + std::to_string(n) + suffix;
    table.add("ramp_" + name, n, 20.0, [&](Study& s) {
      make_everything(s, false);
      ramp(s, 0.3, 2.4, 30.0, law);
      s.release.speed = 1.7;
    });
    table.add("trapezoid_" + name, n, 20.0, [&](Study& s) {
      make_everything(s, false);
      trapezoid(s, 3.0, 2.4, 20.0, 40.0, 60.0, law);
    });
    table.add("points_" + name, n, 18.0, [&](Study& s) {
      make_everything(s, false);
      points(s, law);
      s.release.time = 18.0;
    });
    table.add("points_rolling_" + name, n, 18.0, [&](Study& s) {
      make_everything(s, false);
      make_rolling(s);
      points(s, law);
      s.release.time = 18.0;
    });
  }
}

// The speed bends: psi'' is no constant, neither while balls are held nor after.
void add_hill(Table& table) {
  table.add("hill_released_at_once", 2, 0.0, [](Study& s) {
    hill(s, 2.4, 8.0, 3.0, 40.0);
    s.release.time = 0.0;
  });
  table.add("hill_released_by_speed", 3, 12.0 * std::sqrt(1.5), [](Study& s) {
    hill(s, 2.5, 12.0, 2.0, 60.0);
    s.release.speed = 1.5;
  });
  for (int n : {1, 2, 4, 8})
    table.add("hill_everything_rolling_" + std::to_string(n), n, 9.0, [](Study& s) {
      make_everything(s, false);
      make_rolling(s);
      hill(s, 2.3, 7.0, 1.5, 30.0);
      s.release.time = 9.0;
    });
}

}  // namespace

std::vector<Case> all() {
  Table table;
  add_constant_speed(table);
  add_varying_speed(table, SpeedLaw::kinematic, "_kinematic");
  add_varying_speed(table, SpeedLaw::published, "_published");
  add_hill(table);
  return table.take();
}

}  // namespace cases
