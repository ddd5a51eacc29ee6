// A study as plain data with visible defaults. docs/reference/study-file.md is its reference.
// This room: what a study holds: its values, the table of keys, uncertain values.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "equipoise/machine/datasheet/scales.hpp"
#include "equipoise/machine/drives/full_state.hpp"
#include "equipoise/machine/drives/motor.hpp"
#include "equipoise/machine/drives/speed.hpp"
#include "equipoise/machine/model/bearings.hpp"
#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/study/contents/uncertain.hpp"
#include "equipoise/study/sampling/sampling.hpp"
#include "equipoise/study/toml/study_value.hpp"

namespace equipoise {

namespace model {
class System;
}

/// What turns the rotor: a ramp function of one of five forms, or a motor.
enum class Profile { constant, ramp, trapezoid, points, hill, torque };
/// In the order of the values; first those that a motor's target may have.
inline constexpr std::array<const char*, 6> profile_names{"constant", "ramp", "trapezoid", "points", "hill", "torque"};
inline constexpr std::size_t target_profiles = 4;

/// [speed], or the target of a speed control, which cannot be a motor.
struct RampSetting {
  Profile profile = Profile::constant;
  double speed = 0.0;           ///< constant
  double initial = 0.0;         ///< ramp, trapezoid; torque: psi' at t = 0
  double final = 0.0;           ///< ramp, trapezoid; hill: Omega_max
  double duration = 0.0;        ///< ramp: T0, > 0
  double peak = 0.0;            ///< trapezoid
  double rise_until = 0.0;      ///< trapezoid: T0
  double hold_until = 0.0;      ///< trapezoid: T1
  double fall_until = 0.0;      ///< trapezoid: T2
  double half_time = 0.0;       ///< hill: t_half, > 0
  double exponent = 0.0;        ///< hill: n >= 1
  std::optional<double> until;  ///< hill: from then on the speed goes along its tangent to `final`
  std::vector<double> times;    ///< points
  std::vector<double> speeds;   ///< points
};

/// The ramp function of a profile that is no motor's.
model::SpeedProfile ramp_profile(const RampSetting& speed);

/// speed.torque: the motor of a driven rotor by the keys that were given; Study::motor() has what follows from them.
struct TorqueSetting : model::MotorLaw {
  bool by_stall = false;       ///< linear, given by stall torque and no-load speed
  double stall = 0.0;          ///< stall: torque at rest
  double no_load_speed = 0.0;  ///< stall: speed at which the torque has fallen to 0
  RampSetting target;          ///< control: `aim` follows from it
};

/// speed.load: what the machine takes of the motor's torque, against the rotation.
struct LoadSetting {
  double constant = 0.0;                 ///< at every speed (but see model::Load::creeping)
  double linear = 0.0, quadratic = 0.0;  ///< at speed `at`; they grow with the speed and with its square
  std::optional<double> at;              ///< set if one of these is not 0

  bool is_none() const { return constant == 0.0 && linear == 0.0 && quadratic == 0.0; }
};

/// In the order of model::SpeedLaw's values.
inline constexpr std::array<const char*, 2> speed_law_names{"kinematic", "published"};

/// [speed]: how the rotor turns: a ramp function with the law that turns it into psi(t), or a motor.
struct SpeedSetting : RampSetting {
  model::SpeedLaw law = model::SpeedLaw::kinematic;
  TorqueSetting torque;                 ///< profile torque
  LoadSetting load;                     ///< profile torque
  std::optional<double> stalled_below;  ///< profile torque: a rotor whose mean speed stays below has stalled

  bool driven() const { return profile == Profile::torque; }
};

/// [release]: when the balls are released; at most one member is set.
struct ReleaseSetting {
  std::optional<double> speed;  ///< when the ramp function first reaches this
  std::optional<double> time;
};

/// [initial]: the state at t = 0 in the rotating frame. Ensembles draw phi. A study that does not state phi is read
/// with even_angles(). Under gravity, one without x, y, x_dot and y_dot is read as at rest under its weight.
struct InitialState {
  double psi = 0.0, x = 0.0, y = 0.0, x_dot = 0.0, y_dot = 0.0;
  std::array<double, model::max_balls> phi{}, phi_dot{};
  double tilt_x = 0.0, tilt_y = 0.0, tilt_x_dot = 0.0, tilt_y_dot = 0.0;  ///< of a tilting rotor
};

/// [sampling.box]: what starts draw in addition to the ball angles, uniformly between two bounds; absent quantities
/// keep their value in [initial]. Rotating frame; phi_dot is drawn for each ball.
struct SamplingBox {
  struct Side {
    double low = 0.0, high = 0.0;
  };
  std::optional<Side> x, y, x_dot, y_dot, phi_dot;

  bool empty() const { return !x && !y && !x_dot && !y_dot && !phi_dot; }
};

/// The keys of [sampling.box].
struct BoxSide {
  const char* key;
  std::optional<SamplingBox::Side> SamplingBox::*side;
};
inline constexpr std::array<BoxSide, 5> box_sides{{{"x", &SamplingBox::x},
                                                   {"y", &SamplingBox::y},
                                                   {"x_dot", &SamplingBox::x_dot},
                                                   {"y_dot", &SamplingBox::y_dot},
                                                   {"phi_dot", &SamplingBox::phi_dot}}};

/// [sampling]: the starts of an ensemble.
struct Sampling {
  std::optional<SamplingMethod> method;  ///< unset: random, unless basin() chooses (BasinOptions::half_width)
  std::uint64_t starts = 100000;
  std::uint64_t seed = 1;
  SamplingBox box;
};

/// The grounds on which a start may be decided.
enum class ClassificationMode {
  validated,  ///< as early as sampled states allow
  proof,      ///< balanced only inside a level set proved to lead to balance
  horizon,    ///< every start is followed to the horizon
};
inline constexpr std::array<const char*, 3> classification_mode_names{"validated", "proof", "horizon"};

/// [numerics]: all optional.
struct Numerics {
  std::optional<double> tolerance;  ///< per step; default_*_tolerance if unset
  /// Time after the last piece begins (and release) until a start is `undecided`. If unset, it is chosen when a run
  /// begins (classification/rotor_family/horizon.hpp) and stated in the result.
  std::optional<double> horizon;
  ClassificationMode decide = ClassificationMode::validated;
};

inline constexpr double default_simulate_tolerance = 1e-12;
inline constexpr double default_basin_tolerance = 1e-6;

/// [limits]: what the machine has to keep, for statistics of transients. Dimensionless.
struct Limits {
  std::optional<double> displacement;  ///< radial, in R
  std::optional<double> force;         ///< on the supports, in M R omega_c^2
  std::optional<double> velocity;      ///< root mean square in both directions, of the race's centre, in R omega_c
  std::optional<double> velocity_one_direction;  ///< the same in X or Y, whichever has more
  std::optional<double> dynamic_force;           ///< on the supports without the weight at rest, in M R omega_c^2
  std::optional<double> settling_time;           ///< from release until the rotor has settled, in 1/omega_c
  std::optional<double> hand_arm;                ///< acceleration weighted for hands, in R omega_c^2
  std::optional<double> settled;                 ///< radial displacement below which the rotor counts as settled, in R
  std::optional<double> residual;                ///< unbalance left in the end over the rotor's mass, U/M in R
  std::optional<double> grade;                   ///< U/M times the speed in the end, e omega, in R omega_c
  std::optional<double> share;                   ///< of starts that have to keep all of these, for the verdict
  std::optional<double> clearance;               ///< radial, between rotor and housing where the rotor rests, in R

  bool any() const {
    return displacement || force || velocity || settled || residual || grade || clearance || velocity_one_direction ||
           dynamic_force || settling_time || hand_arm;
  }
};

/// Classes of machines of ISO 10816-1:1995, Annex B (machine/standards/severity.hpp).
enum class SeverityClassName { i, ii, iii, iv };
inline constexpr std::array<const char*, 4> severity_class_names{"I", "II", "III", "IV"};

/// [standards]: what results are judged by next to the limits; only in a study with scales.
struct Standards {
  std::optional<SeverityClassName> severity_class;
  bool hand_held = false;               ///< hands hold the vibrating machine
  std::optional<double> standing_mass;  ///< of all that stands on the floor, in M
  std::optional<double> friction;       ///< between its feet and the floor

  bool any() const { return severity_class || hand_held || standing_mass; }
};

/// [sweep]: what `equipoise sweep` varies by default. No other result depends on it, and it is not echoed: a sweep's
/// result states what was varied.
struct SweepSetting {
  std::vector<std::string> over;  ///< as in --over
  bool zip = false;
};

/// Of a study in physical units: the quantities, in SI units, that no dimensionless study has. What several keys may
/// state, in one way each, is one member, here or of the parameters: Study::states() says in which.
struct DataSheet {
  // [rotor]
  double mass = 0.0;                   ///< M, kg
  double grade = 0.0, grade_at = 0.0;  ///< rotor.balance_grade: m/s, at this speed in rad/s
  bool gd2_of_weight = false;          ///< rotor.gd2 is in N m^2

  std::vector<model::Bearing> bearings;
  struct Plane {
    double at = 0.0, size = 0.0, angle = 0.0;  ///< m, kg m, rad
  };
  std::vector<Plane> unbalances;
  struct Place {
    double mass = 0.0, radius = 0.0, angle = 0.0, at = 0.0;
    std::string name;
  };
  std::vector<Place> places;

  // [balancer]; one entry a ball
  using Balls = std::array<double, model::max_balls>;
  double race = 0.0;                    ///< radius, or diameter, m
  Balls diameter{};                     ///< m
  std::string material;                 ///< whose density the balls have
  bool drag_of_force = false;           ///< the drag is not a torque per rate, N m s, but a force per velocity, N s/m
  std::optional<double> oil_viscosity;  ///< dynamic, Pa s, or kinematic, m^2/s; nondimensionalise() leaves the dynamic
  bool kinematic = false;               ///< the latter
  std::string oil_grade;
  std::optional<double> oil_at;                   ///< K, of an oil given by its grade
  std::optional<double> oil_density;              ///< kg/m^3; nondimensionalise() puts that of an `oil`
  double oil_viscosity_100 = 0.0, channel = 0.0;  ///< m^2/s; m
  bool contact = false;

  // [speed]: of the motor, at its own shaft
  double gear_ratio = 1.0, motor_inertia = 0.0;  ///< motor speed over rotor speed; kg m^2
  double power = 0.0, rated_torque = 0.0, rated_speed = 0.0, synchronous_speed = 0.0;
  double breakdown_ratio = 0.0, locked_rotor_ratio = 0.0;
};

/// A complete study: made by read_study(), or filled in by code (see check()).
struct Study {
  std::string name;  ///< file it came from; only for messages and results
  model::Parameters parameters;
  SpeedSetting speed;
  ReleaseSetting release;
  InitialState initial;
  bool angles_stated = false;  ///< the study states where the balls start: see states_angles()
  Sampling sampling;
  Numerics numerics;
  Limits limits;
  Standards standards;
  SweepSetting sweep;
  std::optional<model::Scales> scales;  ///< of a study in physical units
  /// Of a tilting rotor: where along its shaft it has bearings, from its centre of mass and in R, as far as stated.
  std::vector<double> bearings;
  /// Stiffness and damping of each of them, alike in X and Y, or of each in X and Y in turn; empty: not stated.
  std::vector<double> bearings_stiffness, bearings_damping;
  /// The bearings one by one as stated, if forces on each are known: they are all supports, two or with their stiffness
  /// and damping stated. Else empty.
  std::vector<model::Bearing> each_bearing() const;
  bool physical = false;  ///< its values are quantities in physical units
  DataSheet sheet;        ///< what else it states, if so
  /// Of a study in physical units: as it was read, all members in SI units, before nondimensionalise().
  std::shared_ptr<const Study> in_si;
  bool is_in_si() const { return physical && !scales; }  ///< this is such a study
  using Keys = std::set<std::string, std::less<>>;
  std::shared_ptr<const Keys> stated;  ///< dotted keys of what was read
  bool states(std::string_view key) const { return stated && stated->contains(key); }
  /// Of the balls in m; empty if not stated.
  std::span<const double> ball_diameters() const {
    return {sheet.diameter.data(), sheet.diameter[0] > 0.0 ? static_cast<std::size_t>(parameters.balls) : 0};
  }
  /// In physical units: from the axis of the rotor's own unbalance to the resultant with every [[place]], to which x of
  /// the model points. For a tilting rotor: from its angle 0 to the resultant couple unbalance. In radians.
  double direction_of_x = 0.0;
  Uncertainty uncertain;  ///< what each start draws for itself; everything else here uses the medians

  /// The ramp function and law as the model sees them. For a driven rotor: the speed that its motor aims at, else the
  /// speed at t = 0, as a constant.
  model::SpeedProfile speed_profile() const;
  /// Time >= 0 at which the balls are released. Without [release]: 0 at constant speed and for a driven rotor, else the
  /// end of the ramp (trapezoid: of the rise; points: the last time). A study in physical units without [release] is
  /// read with release.time = 0. Infinite for a driven rotor that releases at a speed. Throws InputError if the ramp
  /// function never reaches release.speed.
  double release_time() const;
  /// The motor of profile torque.
  model::MotorLaw motor() const;
  /// How the rotor is brought to speed and when it releases its balls.
  model::Drive drive() const;
  /// The dynamical system of the last piece of that drive, with psi = 0 at time 0.
  model::System system() const;
  /// For a driven rotor: the mean speed below which it counts as stalled. It is stalled_below of [speed]; else the
  /// smaller of sqrt(2), above which supports isolate, and nine tenths of the speed that the motor aims at.
  double stall_speed() const;
  /// For a driven rotor: the mean speed above which it has passed its resonance. It is the default of stall_speed(),
  /// but at least the highest critical speed, whatever the motor aims at.
  double passed_speed() const;
};

/// Why a release at some speed is refused; `shown` writes a speed.
std::string never_reached(const model::SpeedProfile& profile, const std::function<std::string(double)>& shown);

/// Ball angles spread evenly around the race, the first at 0; entries beyond `balls` are 0.
std::array<double, model::max_balls> even_angles(int balls);

/// Whether somebody chose the ball angles of [initial]: stated in the study, or set by code.
bool states_angles(const Study& study);

/// The text of a study file; a pipe can be read only once. Throws InputError if it cannot be read or does not end.
std::string read_study_text(const std::string& path);

/// Reads and checks a study file. `overrides`: "key=value" with dotted keys, as given to --set.
/// Throws InputError for anything unusable.
Study read_study(const std::string& path, const std::vector<std::string>& overrides = {});

/// The same from TOML text; `name` replaces the file name in messages.
Study parse_study(const std::string& toml_text, const std::string& name,
                  const std::vector<std::string>& overrides = {});

/// The study kept in a result, as to_toml() wrote it. Versions up to 0.3.0 held the balls of machines until the end of
/// their ramp without writing that down; such a study is read with that release.
Study parse_kept_study(const std::string& toml_text, const std::string& name);

/// The same from a tree of values: tables and keys as in a study file.
Study study_from(const StudyValue& tree, const std::string& name = "study",
                 const std::vector<std::string>& overrides = {});

/// The study with every uncertain value at its median, and nothing uncertain.
Study with_medians(Study study);

/// The study of one draw: every uncertain value, in the order of uncertain.values, at a number in its own unit, and
/// nothing uncertain. Throws InputError if these values together make no valid study.
Study drawn_study(const Study& study, std::span<const double> values);

/// Throws InputError unless read_study() would accept `study`. simulate() and basin() call it.
void check(const Study& study);

/// The resolved study, defaults included, as a tree that study_from() reads back to an equal study.
StudyValue to_tree(const Study& study);

/// The same as TOML that read_study() reads back to an equal study.
std::string to_toml(const Study& study);

/// TOML that parse_study() takes, from a tree that study_from() takes.
std::string to_toml(const StudyValue& tree);

}  // namespace equipoise
