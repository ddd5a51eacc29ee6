// From TOML to a checked study and back.
#include "equipoise/study/study.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/base/angles.hpp"
#include "equipoise/base/error.hpp"
#include "equipoise/model/frames.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/study/known_keys.hpp"
#include "equipoise/study/physical.hpp"
#include "equipoise/study/table_reader.hpp"
#include "equipoise/study/toml_tree.hpp"
#include "equipoise/study/uncertain_reader.hpp"

namespace equipoise {

namespace {
using namespace study;

void read_rotor(const Document& document, model::Parameters& p) {
  TableReader rotor(document, "rotor");
  p.eccentricity = rotor.number("eccentricity", not_negative);
  const auto damping = rotor.one_or_each("damping", not_negative, 2, "direction (x, y)");
  const auto stiffness = rotor.one_or_each("stiffness", positive, 2, "direction (x, y)", 1.0);
  p.damping = {damping[0], damping[1]};
  p.stiffness = {stiffness[0], stiffness[1]};
  p.gravity = rotor.number("gravity", not_negative, 0.0);
  p.inertia = rotor.number("inertia", not_negative, 0.0);
  rotor.finish();
}

// What real races and balls add.
void read_race(TableReader& balancer, model::Parameters& p) {
  if (balancer.has("race_offset")) {
    const auto offset = balancer.numbers("race_offset", any_number);
    if (offset.size() != 2)
      balancer.fail("race_offset", fmt::format("has {} entries; must be two finite numbers, [x, y]", offset.size()));
    p.race_offset = {offset[0], offset[1]};
  }
  const auto rolling = balancer.one_or_each("rolling", not_negative, p.balls, "ball", 0.0);
  std::copy(rolling.begin(), rolling.end(), p.rolling.begin());
  p.stiction = p.rolling;
  if (balancer.has("stiction")) {
    const auto stiction = balancer.one_or_each("stiction", not_negative, p.balls, "ball");
    std::copy(stiction.begin(), stiction.end(), p.stiction.begin());
    for (int i = 0; i < p.balls; ++i)
      if (p.stiction[i] < p.rolling[i])
        balancer.fail("stiction",
                      fmt::format("must be at least rolling, {}: a ball at rest resists no less", p.rolling[i]));
  }
  p.rolls = balancer.flag("rolls", p.rolls);
  if (!p.rolls && balancer.has("ball_radius"))
    balancer.fail("ball_radius", "has a meaning only with balancer.rolls = true");
  const auto radius = balancer.one_or_each("ball_radius", {0.0, 1.0, false, true}, p.balls, "ball", 0.0);
  std::copy(radius.begin(), radius.end(), p.ball_radius.begin());
  p.contact_angle = balancer.number("contact_angle", {0.0, two_pi / p.balls, false, true}, 0.0);
  p.restitution = balancer.number("restitution", {0.0, 1.0}, p.restitution);
}

void read_balancer(const Document& document, model::Parameters& p) {
  TableReader balancer(document, "balancer");
  p.balls = static_cast<int>(balancer.integer("balls", 1, model::max_balls));
  const auto mass = balancer.one_or_each("mass", positive, p.balls, "ball");
  const auto drag = balancer.one_or_each("drag", not_negative, p.balls, "ball");
  std::copy(mass.begin(), mass.end(), p.mass.begin());
  std::copy(drag.begin(), drag.end(), p.drag.begin());
  read_race(balancer, p);
  balancer.finish();
}

// Increasing times and a value for each.
void check_times(TableReader& reader, const std::vector<double>& times, const char* values_key,
                 const std::vector<double>& values) {
  for (std::size_t i = 1; i < times.size(); ++i)
    if (!(times[i] > times[i - 1]))
      reader.fail("times", fmt::format("times out of order: entry {} must be greater than {}", i + 1,
                                       reader.time_text(times[i - 1])));
  if (times.size() != values.size())
    reader.fail(values_key, fmt::format("has {} entries; must have one a time, {}", values.size(), times.size()));
}

void read_points(TableReader& reader, RampSetting& speed) {
  speed.times = reader.numbers("times", not_negative);
  speed.speeds = reader.numbers("speeds", any_number);
  if (speed.times.front() != 0.0) reader.fail("times", "the first time must be 0");
  check_times(reader, speed.times, "speeds", speed.speeds);
}

void read_ramp(TableReader& reader, RampSetting& speed) {
  if (speed.profile == Profile::constant) {
    speed.speed = reader.number("speed", any_number);
  } else if (speed.profile == Profile::ramp) {
    speed.initial = reader.number("initial", any_number, 0.0);
    speed.final = reader.number("final", any_number);
    speed.duration = reader.number("duration", positive);
  } else if (speed.profile == Profile::trapezoid) {
    speed.initial = reader.number("initial", any_number, 0.0);
    speed.peak = reader.number("peak", any_number);
    speed.final = reader.number("final", any_number);
    speed.rise_until = reader.number("rise_until", positive);
    speed.hold_until = reader.number("hold_until", positive);
    speed.fall_until = reader.number("fall_until", positive);
    if (!(speed.hold_until > speed.rise_until))
      reader.fail("hold_until", fmt::format("must be greater than rise_until, {}", reader.time_text(speed.rise_until)));
    if (!(speed.fall_until > speed.hold_until))
      reader.fail("fall_until", fmt::format("must be greater than hold_until, {}", reader.time_text(speed.hold_until)));
  } else {
    read_points(reader, speed);
  }
}

// The keys that are there say which law it is.
void read_torque(const Document& document, TorqueSetting& torque) {
  using Kind = model::MotorLaw::Kind;
  TableReader reader(document, "speed.torque");
  if (reader.has("stall") || reader.has("no_load_speed")) {
    torque.by_stall = true;
    torque.stall = reader.number("stall", any_number);
    torque.no_load_speed = reader.number("no_load_speed", positive);
  } else if (reader.has("times") || reader.has("values")) {
    torque.kind = Kind::table;
    torque.times = reader.numbers("times", not_negative);
    torque.values = reader.numbers("values", any_number);
    check_times(reader, torque.times, "values", torque.values);
  } else if (reader.has("gain") || reader.has("integral") || reader.has("target")) {
    torque.kind = Kind::control;
    torque.gain = reader.number("gain", not_negative);
    torque.integral = reader.number("integral", not_negative, 0.0);
    torque.limit = reader.optional_number("limit", positive);
    if (!reader.has("target")) reader.fail("target", "missing; must be a table like { profile = \"ramp\", ... }");
    TableReader target(document, "speed.torque.target");
    torque.target.profile = target.choice<Profile>("profile", std::span(profile_names).first(ramp_functions));
    read_ramp(target, torque.target);
    target.finish();
  } else {
    torque.constant = reader.number("constant", any_number);
    torque.slope = reader.number("slope", any_number, 0.0);
    torque.until = reader.optional_number("until", not_negative);
  }
  reader.finish();
}

void read_driven(TableReader& reader, const Document& document, const model::Parameters& p, SpeedSetting& speed) {
  speed.initial = reader.number("initial", any_number, 0.0);
  speed.stalled_below = reader.optional_number("stalled_below", any_number);
  if (!reader.has("torque")) reader.fail("torque", "missing; must be a table, as { constant = 0.12, slope = -0.04 }");
  read_torque(document, speed.torque);
  if (speed.law != model::SpeedLaw::kinematic)
    reader.fail("law", "must be \"kinematic\": the speed of a driven rotor follows from its motor");
  if (!(p.inertia > 0.0)) {
    TableReader rotor(document, "rotor");
    rotor.fail("inertia", "must be a finite number greater than 0 for a driven rotor (profile \"torque\")");
  }
}

void read_speed(const Document& document, const model::Parameters& p, SpeedSetting& speed) {
  TableReader reader(document, "speed");
  speed.profile = reader.choice<Profile>("profile", profile_names);
  speed.law = reader.choice("law", speed_law_names, std::optional(model::SpeedLaw::kinematic));
  if (speed.driven())
    read_driven(reader, document, p, speed);
  else
    read_ramp(reader, speed);
  reader.finish();
}

std::string never_reached(const std::string& low, const std::string& high) {
  return fmt::format("the ramp function never reaches it; must be from {} to {}", low, high);
}

void read_release(const Document& document, Study& study) {
  TableReader reader(document, "release");
  study.release.speed = reader.optional_number("speed", any_number);
  study.release.time = reader.optional_number("time", not_negative);
  reader.finish();
  if (study.release.speed && study.release.time)
    reader.fail("time", "give either release.speed or release.time, not both");
  const model::SpeedProfile profile = study.speed_profile();
  if (study.release.speed && !study.speed.driven() && !profile.first_time_at(*study.release.speed)) {
    const auto [low, high] = std::minmax_element(profile.speeds.begin(), profile.speeds.end());
    reader.fail("speed", never_reached(reader.speed_text(*low), reader.speed_text(*high)));
  }
}

void read_initial(const Document& document, Study& study) {
  TableReader reader(document, "initial");
  InitialState& s = study.initial;
  s.psi = reader.number("psi", any_number, 0.0);
  s.x = reader.number("x", any_number, 0.0);
  s.y = reader.number("y", any_number, 0.0);
  s.x_dot = reader.number("x_dot", any_number, 0.0);
  s.y_dot = reader.number("y_dot", any_number, 0.0);
  const int balls = study.parameters.balls;
  s.phi = even_angles(balls);
  study.angles_stated = reader.has("phi");
  if (study.angles_stated) {
    const auto phi = reader.one_or_each("phi", any_number, balls, "ball");
    std::copy(phi.begin(), phi.end(), s.phi.begin());
  }
  const auto phi_dot = reader.one_or_each("phi_dot", any_number, balls, "ball", 0.0);
  std::copy(phi_dot.begin(), phi_dot.end(), s.phi_dot.begin());
  if (study.release_time() > 0.0)
    for (double rate : phi_dot)
      if (rate != 0.0) reader.fail("phi_dot", "must be 0: the balls are clamped until their release");
  reader.finish();
}

std::optional<SamplingBox::Side> read_side(TableReader& box, const std::string& key) {
  if (!box.has(key)) return std::nullopt;
  const auto bounds = box.numbers(key, any_number);
  if (bounds.size() != 2)
    box.fail(key, fmt::format("has {} entries; must be two finite numbers, [low, high]", bounds.size()));
  if (!(bounds[0] <= bounds[1])) box.fail(key, "bounds out of order; must be [low, high] with low at most high");
  return SamplingBox::Side{bounds[0], bounds[1]};
}

void read_box(const Document& document, double release_time, SamplingBox& box) {
  TableReader reader(document, "sampling.box");
  for (const auto& [key, side] : box_sides) {
    box.*side = read_side(reader, key);
    if (box.*side && release_time > 0.0)
      reader.fail(key,
                  fmt::format("needs balls that are free from t = 0, but their release is at t = {} (clamped balls "
                              "share one spin-up); set release.time = 0 or leave [sampling.box] out",
                              reader.time_text(release_time)));
  }
  reader.finish();
}

void read_sampling(const Document& document, double release_time, Sampling& sampling) {
  TableReader reader(document, "sampling");
  if (reader.has("box")) read_box(document, release_time, sampling.box);
  if (reader.has("method")) sampling.method = reader.choice<SamplingMethod>("method", sampling_method_names);
  constexpr std::int64_t largest_seed = std::numeric_limits<std::int64_t>::max();  // of a TOML integer
  sampling.starts = reader.integer("starts", 1, 1'000'000'000'000, static_cast<std::int64_t>(sampling.starts));
  if (sampling.method == SamplingMethod::grid && sampling.starts < 2)
    reader.fail("starts", "must be 2 or more: a grid has two starts in every cell");
  sampling.seed = reader.integer("seed", 0, largest_seed, static_cast<std::int64_t>(sampling.seed));
  reader.finish();
}

void read_numerics(const Document& document, Numerics& numerics) {
  TableReader reader(document, "numerics");
  numerics.tolerance = reader.optional_number("tolerance", {1e-14, 1e-2});
  numerics.horizon = reader.optional_number("horizon", horizon_range);
  numerics.decide = reader.choice("decide", decide_mode_names, std::optional(numerics.decide));
  reader.finish();
}

void read_limits(const Document& document, Limits& limits) {
  TableReader reader(document, "limits");
  limits.displacement = reader.optional_number("displacement", positive);
  limits.force = reader.optional_number("force", positive);
  limits.velocity = reader.optional_number("velocity", positive);
  limits.settled = reader.optional_number("settled", positive);
  reader.finish();
}

// What a dimensionless study may say of its units, so that results can be shown in physical ones.
std::optional<model::Scales> read_units(const Document& document) {
  if (document.scales || !document.root.find("units")) return document.scales;
  constexpr Range size{1e-30, 1e30};  // products of all three stay finite
  TableReader reader(document, "units");
  const model::Scales scales{reader.number("mass", size), reader.number("length", size),
                             reader.number("frequency", size)};
  reader.finish();
  return scales;
}

model::SpeedProfile profile_of(const RampSetting& speed) {
  model::SpeedProfile profile;
  if (speed.profile == Profile::constant) {
    profile.speeds = {speed.speed};
  } else if (speed.profile == Profile::ramp) {
    profile.times = {0.0, speed.duration};
    profile.speeds = {speed.initial, speed.final};
  } else if (speed.profile == Profile::trapezoid) {
    profile.times = {0.0, speed.rise_until, speed.hold_until, speed.fall_until};
    profile.speeds = {speed.initial, speed.peak, speed.peak, speed.final};
  } else {
    profile.times = speed.times;
    profile.speeds = speed.speeds;
  }
  return profile;
}

}  // namespace

model::SpeedProfile Study::speed_profile() const {
  model::SpeedProfile profile;
  if (speed.driven())
    profile.speeds = {motor().final_speed().value_or(speed.initial)};
  else
    profile = profile_of(speed);
  profile.law = speed.law;
  profile.initial_angle = initial.psi;
  return profile;
}

std::array<double, model::max_balls> even_angles(int balls) {
  std::array<double, model::max_balls> phi{};
  for (int i = 0; i < std::min(balls, model::max_balls); ++i) phi[i] = two_pi * i / balls;
  return phi;
}

bool states_angles(const Study& study) {
  return study.angles_stated || study.initial.phi != even_angles(study.parameters.balls);
}

double Study::release_time() const {
  if (release.time) return *release.time;
  if (speed.driven())
    return release.speed && *release.speed != speed.initial ? std::numeric_limits<double>::infinity() : 0.0;
  const model::SpeedProfile profile = speed_profile();
  if (release.speed) {
    const auto time = profile.first_time_at(*release.speed);
    if (!time) {
      const auto [low, high] = std::minmax_element(profile.speeds.begin(), profile.speeds.end());
      throw InputError(name, "release.speed", fmt::format("{}", *release.speed),
                       never_reached(fmt::format("{}", *low), fmt::format("{}", *high)));
    }
    return *time;
  }
  return speed.profile == Profile::trapezoid ? speed.rise_until : profile.settled_time();
}

model::MotorLaw Study::motor() const {
  const TorqueSetting& t = speed.torque;
  model::MotorLaw law;
  law.kind = t.kind;
  law.constant = t.by_stall ? t.stall : t.constant;
  law.slope = t.by_stall ? -t.stall / t.no_load_speed : t.slope;
  law.until = t.until;
  law.times = t.times;
  law.values = t.values;
  law.gain = t.gain;
  law.integral = t.integral;
  law.limit = t.limit;
  if (t.kind == model::MotorLaw::Kind::control) law.target = profile_of(t.target);
  return law;
}

model::Drive Study::drive() const {
  const double release_at = release_time();
  if (!speed.driven()) return model::prescribed_drive(model::segments(speed_profile(), release_at));
  model::Drive drive = model::motor_drive(motor(), initial.psi, speed.initial);
  drive.release_time = release_at;
  drive.release_speed = release.speed;
  return drive;
}

model::System Study::system() const {
  if (!speed.driven()) return {parameters, speed_profile().final_speed()};
  return {parameters, model::motor_drive(motor(), initial.psi, speed.initial).pieces.back()};
}

namespace {

// From where supports isolate, or nearly what the motor aims at.
double usual_stall_speed(const Study& study) {
  const auto aim = study.motor().final_speed();
  return aim ? std::min(std::sqrt(2.0), 0.9 * std::fabs(*aim)) : std::sqrt(2.0);
}

}  // namespace

double Study::stall_speed() const { return speed.stalled_below ? *speed.stalled_below : usual_stall_speed(*this); }

double Study::passed_speed() const {
  const auto& kappa = parameters.stiffness;
  return std::max(std::sqrt(std::max(kappa[0], kappa[1])), usual_stall_speed(*this));
}

namespace {

// What the texts say is read when something is varied.
void read_sweep(const Document& document, SweepSetting& sweep) {
  TableReader r(document, "sweep");
  sweep.over = r.texts("over");
  sweep.zip = r.flag("zip", false);
  r.finish();
}

// Whether the study puts the rotor nowhere.
bool states_no_place(const Document& document, const SamplingBox& box) {
  TableReader initial(document, "initial");
  const bool stated = initial.has("x") || initial.has("y") || initial.has("x_dot") || initial.has("y_dot");
  return !stated && !box.x && !box.y && !box.x_dot && !box.y_dot;
}

// Such a rotor rests under its weight at first, not on slack springs.
void rest_under_gravity(const Document& document, Study& study) {
  if (study.parameters.gravity == 0.0 || !states_no_place(document, study.sampling.box)) return;
  const model::Drive drive = study.drive();
  const std::array<double, 2> rest = model::rest_position(study.parameters, drive.psi);
  InitialState& s = study.initial;
  s.x = 0.0 + rest[0];  // not -0
  s.y = rest[1];
  const double still[] = {s.x, s.y, 0.0, 0.0};  // in fixed axes
  const std::array<double, 2> velocity = model::rotating_velocity(drive.speed, still);
  s.x_dot = velocity[0];
  s.y_dot = velocity[1];
}

}  // namespace

namespace {

enum class Source { asked, kept };  // kept: the study of a result

Study read(Document document, Source source = Source::asked);

// Each value alone at either end: what lies between makes a study if both ends do.
void check_ends(const Document& document, const StudyValue& medians, const std::vector<UncertainValue>& values) {
  for (const UncertainValue& value : values)
    for (const double end : value.ends()) {
      StudyValue tree = medians;
      put_value(tree, value, end);
      try {
        read(document_of(std::move(tree), document.name, {}));
      } catch (const InputError& e) {
        fail_at_end(document, value, end, e);
      }
    }
}

// A real race has no latch: in the units of a machine nothing holds the balls unless the study says so, and results say
// that it does not. A dimensionless study keeps the paper's way. With a motor balls are free in any case.
void free_balls_of_machine(Document& document) {
  if (!is_physical(document)) return;
  const StudyValue* profile = document.root.find_path("speed.profile");
  if (profile && profile->string() && *profile->string() == profile_names[static_cast<std::size_t>(Profile::torque)])
    return;
  StudyValue* release = document.root.find("release");
  if (!release) release = &document.root.set("release", StudyValue());
  if (release->table() && release->table()->empty()) release->set("time", "0 s");
}

Study read(Document document, Source source) {
  check_tables(document,
               {"rotor", "balancer", "speed", "release", "initial", "sampling", "numerics", "limits", "sweep", "design",
                "units"});
  check_keys(document, is_physical(document));
  if (source == Source::asked) free_balls_of_machine(document);
  Uncertainty uncertain;
  if (is_physical(document)) uncertain.physical = document.root;
  uncertain.values = take_uncertain(document);
  const StudyValue medians = uncertain.empty() ? StudyValue() : document.root;
  make_dimensionless(document);
  Study result;
  result.name = document.name;
  read_rotor(document, result.parameters);
  read_balancer(document, result.parameters);
  read_speed(document, result.parameters, result.speed);
  read_release(document, result);
  read_initial(document, result);
  read_sampling(document, result.release_time(), result.sampling);
  rest_under_gravity(document, result);
  read_numerics(document, result.numerics);
  read_limits(document, result.limits);
  read_sweep(document, result.sweep);
  result.scales = read_units(document);
  if (uncertain.empty()) return result;
  check_ends(document, medians, uncertain.values);
  if (uncertain.physical) uncertain.horizon = result.numerics.horizon;
  const bool weighs = std::any_of(uncertain.values.begin(), uncertain.values.end(),
                                  [](const UncertainValue& v) { return v.key == "rotor.gravity"; });
  uncertain.rests = (weighs || result.parameters.gravity != 0.0) && states_no_place(document, result.sampling.box);
  result.uncertain = std::move(uncertain);
  return result;
}

}  // namespace

Study parse_study(const std::string& toml_text, const std::string& name, const std::vector<std::string>& overrides) {
  return read(parse_document(toml_text, name, overrides));
}

Study parse_kept_study(const std::string& toml_text, const std::string& name) {
  return read(parse_document(toml_text, name, {}), Source::kept);
}

Study study_from(const StudyValue& tree, const std::string& name, const std::vector<std::string>& overrides) {
  return read(document_of(tree, name, overrides));
}

namespace {
BallDetails ball_details_of(Document document) {
  check_keys(document, is_physical(document));  // whichever is asked first speaks of typing errors first
  take_uncertain(document);
  return ball_details(document);
}
}  // namespace

BallDetails parse_ball_details(const std::string& toml_text, const std::string& name,
                               const std::vector<std::string>& overrides) {
  return ball_details_of(parse_document(toml_text, name, overrides));
}

BallDetails ball_details_from(const StudyValue& tree, const std::string& name,
                              const std::vector<std::string>& overrides) {
  return ball_details_of(document_of(tree, name, overrides));
}

Study with_medians(Study study) {
  study.uncertain = {};
  return study;
}

Study drawn_study(const Study& study, std::span<const double> values) {
  StudyValue tree = to_tree(study);
  for (std::size_t k = 0; k < study.uncertain.values.size(); ++k) put_value(tree, study.uncertain.values[k], values[k]);
  return study_from(tree, study.name);
}

namespace {
// What a study in physical units with uncertain values states as it was written, in dimensionless terms.
std::string text_of_written(const Study& study) {
  StudyValue tree = to_tree(with_medians(study));
  for (const char* table : {"sampling", "numerics"}) tree.erase(table);
  return toml_text(tree);
}
}  // namespace

// One set of rules, whether a study comes from a file, a tree or code.
void check(const Study& study) {
  const std::string name = study.name.empty() ? "study" : study.name;
  const Study again = read(document_of(to_tree(study), name, {}));
  if (study.uncertain.physical && text_of_written(again) != text_of_written(study))
    throw InputError(name, "", "",
                     "was changed after it was read, which its draws in physical units would not show; must be changed "
                     "by overrides, or after with_medians()");
}

}  // namespace equipoise
