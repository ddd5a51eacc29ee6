// Rules that keys.cpp cannot express, and numbers put into members.
#include "equipoise/study/reading/rules.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/typed_numbers.hpp"
#include "equipoise/machine/balance/tolerance_planes.hpp"
#include "equipoise/study/contents/keys.hpp"
#include "equipoise/study/echo/given_value.hpp"

namespace equipoise::study {

namespace {

constexpr char not_the_supports[] =
    "must add up, with its moments about the centre of mass, to rotor.{0} and rotor.tilt.{0}";

void check_supports(const model::Parameters& p, const Refuse& refuse) {
  const model::Tilt& t = p.tilt;
  for (const std::size_t d : {0, 1}) {
    const model::SupportMatrix springs{p.stiffness[d], t.stiffness[d][0], t.stiffness[d][1]},
        dampers{p.damping[d], t.damping[d][0], t.damping[d][1]};
    if (!(springs.tilt > 0.0) || !(springs.determinant() > springs.rounding()))
      refuse("rotor.tilt.stiffness",
             fmt::format(
                 "must be [k12, k22] with k22 greater than 0 and k12^2 less than {0} k22, where {0} is rotor.stiffness",
                 springs.centre));
    if (dampers.tilt < 0.0 || dampers.determinant() < -dampers.rounding())
      refuse("rotor.tilt.damping",
             fmt::format("must be [c12, c22] with c22 at least 0 and c12^2 at most {0} c22, where {0} is rotor.damping",
                         dampers.centre));
  }
}

// Where stiffness and damping of each bearing are stated, they are those of the supports.
void check_bearings(const Study& study, const Refuse& refuse) {
  const std::vector<double>* const lists[] = {&study.bearings_stiffness, &study.bearings_damping};
  constexpr const char* keys[] = {"rotor.tilt.bearings_stiffness", "rotor.tilt.bearings_damping"};
  const std::size_t count = study.bearings.size();
  for (const std::size_t k : {0, 1}) {
    if (lists[k]->empty() && lists[1 - k]->empty()) continue;
    if (count > model::most_bearings)
      refuse("rotor.tilt.bearings_at",
             fmt::format("must have at most {} places where each bearing's stiffness is stated", model::most_bearings));
    if (lists[k]->size() != count && lists[k]->size() != 2 * count)
      refuse(keys[k],
             fmt::format("must be an array of {} numbers, one per bearing of rotor.tilt.bearings_at, or of {}, "
                         "of each in X and Y in turn",
                         count, 2 * count));
  }
  if (study.bearings_stiffness.empty()) return;
  const std::vector<model::Bearing> each = study.each_bearing();
  if (!model::make_stiffness(each, study.parameters)) refuse(keys[0], fmt::format(not_the_supports, "stiffness"));
  if (!model::make_damping(each, study.parameters)) refuse(keys[1], fmt::format(not_the_supports, "damping"));
}

// Of balls and race a tilting rotor takes the planes, and no more than the drag of sliding balls.
void check_tilting_balls(const Study& study, const Refuse& refuse) {
  const model::Parameters& p = study.parameters;
  const auto none = [&](const char* key, bool set, const char* physical_key = nullptr) {
    if (set && physical_key && study.scales)
      refuse(fmt::format("balancer.{}", physical_key),
             fmt::format("rotors with rotor.tilt have no rolling or touching balls: state balancer.{} = false",
                         physical_key));
    if (set)
      refuse(fmt::format("balancer.{}", key),
             "no rotor with rotor.tilt has this: its balls slide in a centred race and pass each other");
  };
  none("race_offset", !p.race_is_centred());
  none("rolls", p.rolls, "rolls");
  none("contact_angle", p.balls_collide(), "contact");
  const bool rolling = std::any_of(p.rolling.begin(), p.rolling.end(), [](double v) { return v > 0.0; });
  none(rolling ? "rolling" : "stiction", p.balls_stick());
}

// A rotor is not brought to speed for longer, and a change of speed that takes less is a jump.
constexpr double shortest_time = 1e-12, longest_time = 1e8;

bool is_allowed(double time) { return time >= shortest_time && time <= longest_time; }

// Draws of uncertain values come by here, so the key is put together only for a refusal.
void check_time(const std::string& table, const char* key, double time, const std::optional<model::Scales>& scales,
                const Refuse& refuse) {
  if (is_allowed(time)) return;
  const auto shown = [&](double t) { return in_own_unit(t, Dimension::time, scales); };
  refuse(fmt::format("{}.{}", table, key),
         fmt::format("must be from {} to {}", shown(shortest_time), shown(longest_time)));
}
void check_times(const std::string& table, const std::vector<double>& times, const std::optional<model::Scales>& scales,
                 const Refuse& refuse) {
  for (const double time : times)
    if (time != 0.0) check_time(table, "times", time, scales, refuse);
}

// Times or speeds must increase, and each needs a value.
void check_points(const std::string& table, bool times, const std::vector<double>& points, const char* values_key,
                  const std::vector<double>& values, const std::optional<model::Scales>& scales, const Refuse& refuse) {
  const char* key = times ? "times" : "speeds";
  for (std::size_t i = 1; i < points.size(); ++i)
    if (!(points[i] > points[i - 1]))
      refuse(fmt::format("{}.{}", table, key),
             fmt::format("{} out of order: entry {} must be greater than {}", key, i + 1,
                         in_own_unit(points[i - 1], times ? Dimension::time : Dimension::speed, scales)));
  if (points.size() != values.size())
    refuse(fmt::format("{}.{}", table, values_key),
           fmt::format("has {} entries; must have one per {}, {}", values.size(), times ? "time" : "speed",
                       points.size()));
}

// Of [speed], or of a motor's target.
void check_ramp(const RampSetting& ramp, const std::string& table, const Study& study, const Refuse& refuse) {
  const std::optional<model::Scales>& scales = study.scales;
  const auto check_after = [&](const char* key, double time, const char* before, double earlier) {
    if (!(time > earlier))
      refuse(fmt::format("{}.{}", table, key),
             fmt::format("must be greater than {}, {}", before, in_own_unit(earlier, Dimension::time, scales)));
  };
  if (ramp.profile == Profile::trapezoid) {
    check_after("hold_until", ramp.hold_until, "rise_until", ramp.rise_until);
    check_after("fall_until", ramp.fall_until, "hold_until", ramp.hold_until);
  }
  if (ramp.profile == Profile::points) {
    if (!ramp.times.empty() && ramp.times.front() != 0.0) refuse(table + ".times", "the first time must be 0");
    check_points(table, true, ramp.times, "speeds", ramp.speeds, scales, refuse);
  }
  if (ramp.profile == Profile::hill && ramp.until && *ramp.until < ramp.half_time)
    refuse(fmt::format("{}.until", table),
           fmt::format("must be at least {}, {}", "half_time", in_own_unit(ramp.half_time, Dimension::time, scales)));
  const auto lasts = [&](const char* key, double time) { check_time(table, key, time, scales, refuse); };
  if (ramp.profile == Profile::ramp && !is_allowed(ramp.duration))
    lasts(study.states(table + ".run_up") ? "run_up" : "duration", ramp.duration);
  if (ramp.profile == Profile::trapezoid) {
    lasts("rise_until", ramp.rise_until);
    lasts("fall_until", ramp.fall_until);
  }
  if (ramp.profile == Profile::points) check_times(table, ramp.times, scales, refuse);
  if (ramp.profile == Profile::hill) {
    lasts("half_time", ramp.half_time);
    if (const double end = ramp_profile(ramp).times.back(); !(end <= longest_time))
      refuse(
          fmt::format("{}.{}", table, ramp.until ? "until" : "half_time"),
          fmt::format("brings the rotor to its final speed at t = {}; must do so by t = {}",
                      in_own_unit(end, Dimension::time, scales), in_own_unit(longest_time, Dimension::time, scales)));
  }
}

void check_torque(const Study& study, const Refuse& refuse) {
  using Kind = model::MotorLaw::Kind;
  const TorqueSetting& motor = study.speed.torque;
  const std::optional<model::Scales>& scales = study.scales;
  const std::string table = "speed.torque";
  if (motor.kind == Kind::table) {
    check_points(table, true, motor.times, "values", motor.values, scales, refuse);
    check_times(table, motor.times, scales, refuse);
  }
  if (motor.kind == Kind::control) check_ramp(motor.target, table + ".target", study, refuse);
  if (motor.until && *motor.until != 0.0) check_time(table, "until", *motor.until, scales, refuse);
  if (motor.kind != Kind::curve) return;
  check_points(table, false, motor.speeds, "values", motor.values, scales, refuse);
  const std::size_t points = motor.speeds.size();
  if (points < 2 || points > model::most_curve_points)
    refuse(table + ".speeds", fmt::format("has {} entries; must have 2 to {}", points, model::most_curve_points));
}

void check_tilt(const Study& study, const Refuse& refuse) {
  const model::Parameters& p = study.parameters;
  if (!p.tilts()) return;
  if (!at_most(p.tilt.polar_inertia, 2.0 * p.tilt.transverse_inertia))
    refuse("rotor.tilt.polar_inertia", "must be at most twice rotor.tilt.transverse_inertia: no body has more");
  check_supports(p, refuse);
  check_bearings(study, refuse);
}

void check_balls(const Study& study, const Refuse& refuse) {
  const model::Parameters& p = study.parameters;
  for (int i = 0; i < p.balls; ++i)
    if (p.stiction[i] < p.rolling[i])
      refuse("balancer.stiction",
             fmt::format("must be at least rolling, {}: a ball at rest resists no less", p.rolling[i]));
  if (p.tilts()) check_tilting_balls(study, refuse);
}

void check_speed(const Study& study, const Refuse& refuse) {
  const SpeedSetting& speed = study.speed;
  check_ramp(speed, "speed", study, refuse);
  if (!speed.driven()) return;
  check_torque(study, refuse);
  if ((speed.load.linear != 0.0 || speed.load.quadratic != 0.0) && !speed.load.at)
    refuse("speed.load.at", "missing; must be the speed at which the load takes linear and quadratic");
  if (!(study.parameters.inertia > 0.0))
    refuse("rotor.inertia", study.scales
                                ? "must be a moment of inertia greater than 0, such as \"0.02 kg m2\", for a driven "
                                  "rotor (profile \"torque\"), or give rotor.radius_of_gyration or rotor.gd2"
                                : "must be a finite number greater than 0 for a driven rotor (profile \"torque\")");
}

void check_release(const Study& study, const Refuse& refuse) {
  const ReleaseSetting& release = study.release;
  if (release.speed && release.time) refuse("release.time", "give either release.speed or release.time, not both");
  if (!release.speed || study.speed.driven()) return;
  const model::SpeedProfile profile = study.speed_profile();
  if (!profile.first_time_at(*release.speed))
    refuse("release.speed",
           never_reached(profile, [&](double speed) { return in_own_unit(speed, Dimension::speed, study.scales); }));
}

// Balls that are held at first have no rates, stated or drawn, and nothing else of the start is drawn.
void check_held_balls(const Study& study, const Refuse& refuse) {
  const auto& rates = study.initial.phi_dot;
  const bool moves = std::any_of(rates.begin(), rates.end(), [](double rate) { return rate != 0.0; });
  if (!moves && study.sampling.box.empty()) return;
  const double release = study.release_time();
  if (!(release > 0.0)) return;
  if (moves) refuse("initial.phi_dot", "must be 0: the balls are clamped until their release");
  for (const auto& [key, side] : box_sides)
    if (study.sampling.box.*side)
      refuse(fmt::format("sampling.box.{}", key),
             fmt::format("needs balls that are free from t = 0, but their release is at t = {} (clamped balls share "
                         "one spin-up); set release.time = 0 or leave [sampling.box] out",
                         in_own_unit(release, Dimension::time, study.scales)));
}

}  // namespace

void check_numbers(const Study& study, const Refuse& refuse) {
  for (const auto rules : {check_tilt, check_balls, check_speed, check_release, check_held_balls}) rules(study, refuse);
}

namespace {

// Keys that mean something only in some studies.
struct Need {
  std::vector<const char*> keys;
  bool (*met)(const Study&);
  const char* why;
};

// Forces on each of several bearings are gathered if each is known and no feet slide by their sum; otherwise a sum,
// which does not show what tilts the rotor, and which limits.force does not take. Limits on a tilting rotor's unbalance
// need the places of two bearings, in whose planes it is judged.
const std::vector<Need>& needs() {
  static const std::vector<Need> all{
      {{"rotor.eccentricity_angle", "initial.tilt_x", "initial.tilt_y", "initial.tilt_x_dot", "initial.tilt_y_dot"},
       [](const Study& s) { return s.parameters.tilts(); },
       only_of_tilt},
      {{"standards.severity_class", "standards.hand_held", "standards.standing_mass", "standards.friction"},
       [](const Study& s) { return s.scales || !s.standards.any(); },
       "needs a study in physical units, or with [units]"},
      {{"standards.standing_mass"},
       [](const Study& s) { return s.standards.friction.has_value(); },
       "needs standards.friction, such as 0.5"},
      {{"standards.friction"},
       [](const Study& s) { return s.standards.standing_mass.has_value(); },
       "needs standards.standing_mass, such as \"70 kg\""},
      {{"limits.settling_time"},
       [](const Study& s) { return s.limits.settled.has_value(); },
       "needs limits.settled, the displacement below which the rotor has settled"},
      {{"limits.hand_arm"},
       [](const Study& s) { return s.scales.has_value(); },
       "is weighted by the frequency in Hz, which needs a study in physical units, or with [units]"},
      {{"limits.force", "limits.dynamic_force"},
       [](const Study& s) { return s.bearings.size() <= 2 || !s.bearings_stiffness.empty(); },
       "is of the bearing that takes most, and of more than two bearings each has to be known: state "
       "rotor.tilt.bearings_stiffness and rotor.tilt.bearings_damping, or in physical units rotor.tilt.bearings"},
      {{"limits.force", "limits.dynamic_force"},
       [](const Study& s) { return s.bearings.size() < 2 || !s.standards.standing_mass; },
       "is of the bearing that takes most, but with standards.standing_mass only the force on all together is "
       "known; state one of the two"},
      {{"limits.residual", "limits.grade"},
       [](const Study& s) { return !s.parameters.tilts() || model::tolerance_planes(s.bearings); },
       "is judged in the planes of two bearings, which rotor.tilt does not state: without them it would leave out the "
       "couple unbalance; state rotor.tilt.bearings_at, or in physical units rotor.tilt.bearings"},
  };
  return all;
}

}  // namespace

void check_needs(const Study& study, const Refuse& refuse) {
  for (const Need& need : needs())
    for (const char* key : need.keys)
      if (study.states(key) && !need.met(study)) refuse(key, need.why);
}

double number_of(Study& study, const UncertainValue& value, double drawn, const Refuse& refuse) {
  const StudyValue written = value.written(drawn);
  const auto [places, wanted] = numbers_of(study, value.key);
  if (places.empty()) refuse(value.key, "must be a number of the study");
  if (wanted.is_quantity())
    return measure_value(written, wanted, [&](const std::string& problem) { refuse(value.key, problem); }).value;
  if (value.key == "rotor.damping_ratio" && written.number() > 1.0)
    refuse(value.key, fmt::format(ratio_is_percentage, drawn));
  const double number = value.plain(drawn);
  if (!wanted.range.contains(number)) refuse(value.key, "must be " + wanted.text());
  return number;
}

bool put_numbers(Study& study, std::span<const NumberAt> numbers) {
  model::Parameters& p = study.parameters;
  const auto states = [&](std::string_view key) {
    return std::any_of(numbers.begin(), numbers.end(), [&](const NumberAt& n) { return n.key == key; });
  };
  const bool follows = !study.is_in_si();  // a machine in SI units knows what was stated
  const bool usual = follows && p.inertia == usual_inertia(p) && !states("rotor.inertia");
  const bool as_rolling =
      follows && p.stiction == p.rolling && states("balancer.rolling") && !states("balancer.stiction");
  for (const auto& [key, value] : numbers) {
    const std::vector<double*> places = numbers_of(study, key).places;
    if (places.empty()) return false;
    for (double* place : places) *place = value;
  }
  if (as_rolling) p.stiction = p.rolling;
  if (usual) p.inertia = usual_inertia(p);
  return true;
}

bool put_valid_numbers(Study& study, std::span<const NumberAt> numbers) {
  for (const auto& [key, value] : numbers)
    if (!numbers_of(study, key).wanted.range.contains(value)) return false;
  if (!put_numbers(study, numbers)) return false;
  try {
    check_numbers(study, refuse_in(study));
  } catch (const InputError&) {
    return false;
  }
  return true;
}

std::string or_give(std::string_view dotted) {
  const std::string table(dotted.substr(0, dotted.find('.')));
  std::string text;
  for (const Key* way : ways_of(dotted))
    if (const std::string key = fmt::format("{}.{}", table, way->name); key != dotted)
      text += fmt::format(", or give {}, {}", key, way->way.words);
  return text;
}

void refuse_several_ways(const Study& study, const Refuse& refuse) {
  for (const KeyTable& table : key_tables()) {
    std::map<std::string_view, std::string> given;
    for (const Key& key : table.keys) {
      const std::string dotted = fmt::format("{}.{}", table.name, key.name);
      if (!key.way.of || !study.states(dotted)) continue;
      const auto [first, only] = given.emplace(key.way.of, dotted);
      if (!only) refuse(dotted, fmt::format("give either {} or {}, not both", first->second, dotted));
    }
  }
}

std::string_view way_of(const Study& study, std::string_view first, const Refuse& refuse, bool required) {
  const std::string table(first.substr(0, first.find('.') + 1));
  const std::vector<const Key*> ways = ways_of(first);
  for (const Key* way : ways)
    if (study.states(table + way->name)) return way->name;
  if (required)
    refuse(std::string(first), fmt::format("missing; must be {}{}", ways.front()->way.words, or_give(first)));
  return "";
}

}  // namespace equipoise::study
