// A study: what is asked, as plain data with visible defaults. docs/guide/study-file.md is its reference.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "equipoise/drives/full_state.hpp"
#include "equipoise/drives/motor.hpp"
#include "equipoise/drives/speed.hpp"
#include "equipoise/model/parameters.hpp"
#include "equipoise/model/scales.hpp"
#include "equipoise/sampling/sampling.hpp"
#include "equipoise/study/uncertain.hpp"
#include "equipoise/toml/study_value.hpp"

namespace equipoise {

namespace model {
class System;
}

/// What makes the rotor turn: a ramp function of one of four forms, or a motor.
enum class Profile { constant, ramp, trapezoid, points, torque };
/// In the order of the values; the ramp functions first.
inline constexpr std::array<const char*, 5> profile_names{"constant", "ramp", "trapezoid", "points", "torque"};
inline constexpr std::size_t ramp_functions = 4;

/// [speed], or the target of a speed control, which no motor can be.
struct RampSetting {
  Profile profile = Profile::constant;
  double speed = 0.0;          ///< constant
  double initial = 0.0;        ///< ramp, trapezoid; torque: psi' at t = 0
  double final = 0.0;          ///< ramp, trapezoid
  double duration = 0.0;       ///< ramp: T0, > 0
  double peak = 0.0;           ///< trapezoid
  double rise_until = 0.0;     ///< trapezoid: T0
  double hold_until = 0.0;     ///< trapezoid: T1
  double fall_until = 0.0;     ///< trapezoid: T2
  std::vector<double> times;   ///< points
  std::vector<double> speeds;  ///< points
};

/// speed.torque: the motor of a driven rotor, as model::MotorLaw has it, by the keys that were given.
struct TorqueSetting {
  model::MotorLaw::Kind kind = model::MotorLaw::Kind::linear;
  bool by_stall = false;        ///< linear, given by stall torque and no-load speed
  double constant = 0.0;        ///< linear: tau = constant + slope psi' until `until`, then 0
  double slope = 0.0;           ///< linear
  std::optional<double> until;  ///< linear
  double stall = 0.0;           ///< stall: torque at rest
  double no_load_speed = 0.0;   ///< stall: where the torque has fallen to 0
  std::vector<double> times;    ///< table
  std::vector<double> values;   ///< table
  double gain = 0.0;            ///< control: torque for a speed error of 1
  double integral = 0.0;        ///< control: rate of torque for a speed error of 1
  std::optional<double> limit;  ///< control: largest |tau|
  RampSetting target;           ///< control
};

/// By model::SpeedLaw's values.
inline constexpr std::array<const char*, 2> speed_law_names{"kinematic", "published"};

/// [speed]: how the rotor turns: a prescribed ramp function and the law that turns it into psi(t), or a motor.
struct SpeedSetting : RampSetting {
  model::SpeedLaw law = model::SpeedLaw::kinematic;
  TorqueSetting torque;                 ///< profile torque
  std::optional<double> stalled_below;  ///< profile torque: mean speed below which a rotor has not come through

  bool driven() const { return profile == Profile::torque; }
};

/// [release]: when the balls are let go; at most one is set.
struct ReleaseSetting {
  std::optional<double> speed;  ///< when the ramp function first equals this
  std::optional<double> time;
};

/// [initial]: state at t = 0, rotating frame. Ensembles draw phi. A study that says nothing of phi is read with
/// even_angles(); under gravity one that says nothing of x, y, x_dot and y_dot with those of a rotor at rest under its
/// weight.
struct InitialState {
  double psi = 0.0, x = 0.0, y = 0.0, x_dot = 0.0, y_dot = 0.0;
  std::array<double, model::max_balls> phi{}, phi_dot{};
};

/// [sampling.box]: what starts draw besides the ball angles, uniformly between two bounds; the absent keep the value of
/// [initial]. Rotating frame; phi_dot is drawn for each ball.
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
  std::optional<SamplingMethod> method;  ///< unset: random, unless basin() is to choose (BasinOptions::half_width)
  std::uint64_t starts = 100000;
  std::uint64_t seed = 1;
  SamplingBox box;
};

/// On what grounds a start may be called decided.
enum class ClassificationMode {
  validated,  ///< as early as tried states allow
  proof,      ///< balanced only inside a level set proved to lead there
  horizon,    ///< every start is followed to the horizon
};
inline constexpr std::array<const char*, 3> classification_mode_names{"validated", "proof", "horizon"};

/// [numerics]: all optional.
struct Numerics {
  std::optional<double> tolerance;  ///< per step; default_*_tolerance where unset
  /// Time after the last branch begins (and release) until a start is `undecided`. Unset: chosen when a run begins
  /// (rotor_family/horizon.hpp), and stated in what it answers.
  std::optional<double> horizon;
  ClassificationMode decide = ClassificationMode::validated;
};

inline constexpr double default_simulate_tolerance = 1e-12;
inline constexpr double default_basin_tolerance = 1e-6;

/// [limits]: what the machine is asked to keep, for the statistics of transients. Dimensionless.
struct Limits {
  std::optional<double> displacement;  ///< radial, in R
  std::optional<double> force;         ///< on the supports, in M R omega_c^2
  std::optional<double> velocity;      ///< root mean square, of the centre of the race, in R omega_c
  std::optional<double> settled;       ///< radial displacement below which the rotor counts as settled, in R
};

/// [sweep]: what `equipoise sweep` varies unless it is told otherwise. No part of what a run's results depend on, and
/// not echoed: those of a sweep say themselves what was varied.
struct SweepSetting {
  std::vector<std::string> over;  ///< as of --over
  bool zip = false;
};

/// A complete study: made by read_study(), or filled in by code (see check()).
struct Study {
  std::string name;  ///< file it came from; for messages and results only
  model::Parameters parameters;
  SpeedSetting speed;
  ReleaseSetting release;
  InitialState initial;
  bool angles_stated = false;  ///< the study said where the balls start: see states_angles()
  Sampling sampling;
  Numerics numerics;
  Limits limits;
  SweepSetting sweep;
  std::optional<model::Scales> scales;  ///< of a study in physical units
  Uncertainty uncertain;  ///< what each start draws for itself; all else here holds with the medians of it

  /// The ramp function and law as the model sees them; of a driven rotor the speed that its motor aims at, else that at
  /// t = 0, as a constant.
  model::SpeedProfile speed_profile() const;
  /// Time at which the balls are let go, >= 0. With no [release]: 0 at constant speed and of a driven rotor, else the
  /// end of the ramp (trapezoid: of the rise; points: the last time); a study in physical units that says nothing is
  /// read with release.time = 0. Infinite for a driven rotor that lets go at a speed. Throws InputError if the ramp
  /// function never reaches release.speed.
  double release_time() const;
  /// The motor of profile torque.
  model::MotorLaw motor() const;
  /// How the rotor is brought to speed and when it lets go of its balls.
  model::Drive drive() const;
  /// What moves at last: in the last piece of that drive, psi = 0 at time 0.
  model::System system() const;
  /// Of a driven rotor: the mean speed below which it counts as stalled. stalled_below of [speed]; else the smaller of
  /// sqrt(2), from where supports isolate, and nine tenths of the speed that the motor aims at.
  double stall_speed() const;
  /// Of a driven rotor: the mean speed above which it has come through the resonance: the default of stall_speed(), but
  /// no less than the greatest critical speed, whatever the motor aims at.
  double passed_speed() const;
};

/// Ball angles evenly around the race, the first at 0; where there is no such ball 0.
std::array<double, model::max_balls> even_angles(int balls);

/// Whether the ball angles of [initial] are somebody's choice: stated in the study, or set by code.
bool states_angles(const Study& study);

/// The text of a study file; a pipe can be read once only. Throws InputError if it cannot be read or does not end.
std::string read_study_text(const std::string& path);

/// Reads and checks a study file. `overrides`: "key=value" with dotted keys, as given to --set.
/// Throws InputError for anything unusable.
Study read_study(const std::string& path, const std::vector<std::string>& overrides = {});

/// The same from TOML text; `name` stands in for the file name in messages.
Study parse_study(const std::string& toml_text, const std::string& name,
                  const std::vector<std::string>& overrides = {});

/// The study that a result carries, as to_toml() wrote it. Versions up to 0.3.0 held the balls of machines to the end
/// of their ramp and did not write that down; here such a study says so.
Study parse_kept_study(const std::string& toml_text, const std::string& name);

/// The same from a tree of values: tables and keys as in a study file.
Study study_from(const StudyValue& tree, const std::string& name = "study",
                 const std::vector<std::string>& overrides = {});

/// The study with every uncertain value at its median and nothing uncertain.
Study with_medians(Study study);

/// The study of one draw: every uncertain value, in the order of uncertain.values, at a number in its own unit, and
/// nothing uncertain. Throws InputError if such values together make no study.
Study drawn_study(const Study& study, std::span<const double> values);

/// Throws InputError unless read_study() would accept `study`: for studies filled in by code. simulate() and basin()
/// call it themselves.
void check(const Study& study);

/// The resolved study, defaults included, as a tree that study_from() takes back to an equal study.
StudyValue to_tree(const Study& study);

/// The same as TOML that read_study() takes back to an equal study.
std::string to_toml(const Study& study);

/// A tree that study_from() takes as TOML that parse_study() takes.
std::string to_toml(const StudyValue& tree);

}  // namespace equipoise
