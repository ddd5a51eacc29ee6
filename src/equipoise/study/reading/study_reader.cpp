// From TOML to a checked study: rules that keys.cpp cannot express, and the order of reading.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/machine/mechanics/frames.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/study/contents/keys.hpp"
#include "equipoise/study/reading/machine_sheet.hpp"
#include "equipoise/study/reading/rules.hpp"
#include "equipoise/study/reading/table_reader.hpp"
#include "equipoise/study/toml/toml_tree.hpp"

namespace equipoise {

namespace {
using namespace study;

void read_release(const StudyFile& file, Study& study) {
  if (study.parameters.balls > 0)
    read_table(file, "release", study);
  else
    study.release.time = 0.0;
}

void read_initial(const StudyFile& file, Study& study) {
  TableReader reader(file, "initial");
  study.initial.phi = even_angles(study.parameters.balls);
  const bool balls = study.parameters.balls > 0;
  study.angles_stated = reader.has("phi") && balls;
  for (const Key& key : key_table("initial").of(all_variants, file.physical))
    if (balls || !std::string_view(key.name).starts_with("phi")) read_key(reader, key, study);
  reader.has("phi_dot");
  reader.finish();
}

void read_sampling(const StudyFile& file, Study& study) {
  TableReader reader(file, "sampling");
  if (reader.has("box")) read_table(file, "sampling.box", study);
  for (const Key& key : key_table("sampling").keys) {
    read_key(reader, key, study);
    if (key.name == std::string_view("starts") && study.sampling.method == SamplingMethod::grid &&
        study.sampling.starts < 2)
      reader.fail("starts", "must be 2 or more: a grid has two starts in every cell");
  }
  reader.finish();
}

// Optional units of a dimensionless study, so that results can be shown in physical ones.
void read_units(const StudyFile& file, Study& study) {
  if (file.physical || !file.root.find("units")) return;
  study.scales.emplace();
  read_table(file, "units", study);
}

// Whether the study does not say where the rotor starts.
bool states_no_place(const Study& study) {
  const SamplingBox& box = study.sampling.box;
  constexpr std::array places{"x", "y", "x_dot", "y_dot", "tilt_x", "tilt_y", "tilt_x_dot", "tilt_y_dot"};
  return !box.x && !box.y && !box.x_dot && !box.y_dot && std::none_of(places.begin(), places.end(), [&](const char* p) {
    return study.states(std::string("initial.") + p);
  });
}

// Such a rotor starts at rest under its weight, not on unloaded springs.
void put_at_rest(Study& study, const Refuse& refuse) {
  InitialState& s = study.initial;
  s.x = s.y = s.x_dot = s.y_dot = s.tilt_x = s.tilt_y = s.tilt_x_dot = s.tilt_y_dot = 0.0;
  if (study.parameters.gravity == 0.0) return;
  const model::Drive drive = study.drive();
  const std::array<double, 2> rest = model::rest_position(study.parameters, drive.psi);
  if (!any_number.contains(rest[0]) || !any_number.contains(rest[1]))
    refuse("rotor.gravity", fmt::format("pulls the rotor further than {} race radii; must be less", unbounded));
  s.x = 0.0 + rest[0];  // not -0
  s.y = rest[1];
  const double still[] = {s.x, s.y, 0.0, 0.0};  // in fixed axes
  const std::array<double, 2> velocity = model::rotating_velocity(drive.speed, still);
  s.x_dot = velocity[0];
  s.y_dot = velocity[1];
  if (!study.parameters.tilts()) return;
  const double slope = model::static_slope(study.parameters);
  const double leaning[] = {0.0 + slope * std::sin(drive.psi), slope * std::cos(drive.psi), 0.0, 0.0};
  s.tilt_x = leaning[0];
  s.tilt_y = leaning[1];
  const std::array<double, 2> rate = model::rotating_velocity(drive.speed, leaning);
  s.tilt_x_dot = rate[0];
  s.tilt_y_dot = rate[1];
}

// Checks each value alone at either end: if both ends make a valid study, so does everything between.
void check_ends(const StudyFile& file, const Study& study) {
  const std::vector<UncertainValue>& values = study.uncertain.values;
  std::vector<double> medians;
  for (const UncertainValue& value : values) medians.push_back(value.taken());
  for (std::size_t k = 0; k < values.size(); ++k)
    for (const double end : values[k].ends()) {
      std::vector<double> draw = medians;
      draw[k] = end;
      try {
        drawn_study(study, draw);
      } catch (const InputError& e) {
        const std::string key = e.key().empty() || e.key() == values[k].key ? "" : e.key() + " ";
        file.fail(values[k].key, fmt::format("with {}: {}{}", shown_text(values[k].text(end)), key, e.problem()));
      }
    }
}

// Every dotted key that is there.
void add_keys(const StudyValue& value, const std::string& prefix, Study::Keys& keys) {
  if (const StudyValue::Table* members = value.table())
    for (const auto& [key, inner] : *members) {
      keys.insert(prefix + key);
      add_keys(inner, prefix + key + ".", keys);
    }
  if (const StudyValue::Array* array = value.array())
    for (std::size_t i = 0; i < array->size(); ++i) add_keys((*array)[i], fmt::format("{}{}.", prefix, i + 1), keys);
}

Study::Keys keys_of(const StudyValue& root) {
  Study::Keys keys;
  add_keys(root, "", keys);
  return keys;
}

// The first key that only studies in physical units have; empty if there is none.
std::string physical_key(const StudyFile& file) {
  for (const KeyTable& table : key_tables())
    for (const Key& key : table.keys)
      if (key.has(Key::physical))
        if (std::string dotted = table.name + "." + key.name; file.root.find_path(dotted)) return dotted;
  return file.root.find("place") ? "place" : "";
}

// Without a mass nothing has a scale. The message names the key that makes the study physical: it may be a mistake.
void check_scales(const StudyFile& file) {
  if (const StudyValue* units = file.root.find("units"))
    throw InputError(file.where("units", units), "units", "",
                     "belongs to a dimensionless study; here the units follow from rotor.mass, balancer.race_radius "
                     "and rotor.stiffness");
  const std::string key = physical_key(file);
  if (key != "rotor.mass")
    throw InputError(file.where("rotor.mass", nullptr), "rotor.mass", "",
                     fmt::format("missing; must be {}, for {} makes this a study in physical units",
                                 Wanted(positive, {Dimension::mass}).text(), key));
}

// States speed.profile if a machine leaves it out and its keys say which.
void infer_profile(StudyFile& file) {
  StudyValue* speed = find_table(file.root, "speed");
  if (!speed || speed->find("profile")) return;
  for (const auto& [key, profile] : {std::pair{"torque", Profile::torque}, std::pair{"run_up", Profile::ramp},
                                     std::pair{"speed", Profile::constant}})
    if (const StudyValue* value = speed->find(key); value && (value->table() || profile != Profile::torque)) {
      speed->set("profile", profile_names[static_cast<std::size_t>(profile)]);
      return;
    }
}

// A real race has no latch: in physical units nothing holds the balls unless the study says so, and results mention it.
// A dimensionless study keeps the paper's convention. With a motor the balls are free in any case.
void free_balls_of_machine(StudyFile& file) {
  const std::string* profile = file.root.find_text("speed.profile");
  if (profile && *profile == profile_names[static_cast<std::size_t>(Profile::torque)]) return;
  StudyValue* release = file.root.find("release");
  if (!release) release = &file.root.set("release", StudyValue());
  if (release->table() && release->table()->empty()) release->set("time", "0 s");
}

// A grade as balancing has it, residual = "G 6.3", is the limit grade = "6.3 mm/s".
void read_grade(StudyFile& file) {
  const std::string* text = file.root.find_text("limits.residual");
  if (!text || text->empty() || text->front() != 'G') return;
  TableReader reader(file, "limits");
  if (!file.physical)
    reader.fail("residual", "is a grade, which needs a study in physical units; must be U/M in R, or state `grade`");
  if (reader.has("grade")) reader.fail("residual", "is already a grade; give limits.grade or this, not both");
  const auto grade = grade_named(*text);
  if (!grade || !positive.contains(*grade))
    reader.fail("residual", "must be \"G\" and a number of mm/s greater than 0, such as \"G 6.3\", or an unbalance");
  StudyValue& limits = *file.root.find("limits");
  limits.set("grade", fmt::format("{} mm/s", *grade));
  limits.erase("residual");
}

enum class Source { asked, kept };  // kept: a study stored in a result

Study read(StudyFile file, Source source = Source::asked) {
  check_tables(file);
  file.physical = !physical_key(file).empty();
  read_grade(file);
  check_keys(file, file.physical);
  Study result;
  result.name = file.name;
  result.physical = file.physical;
  result.stated = std::make_shared<const Study::Keys>(keys_of(file.root));
  Uncertainty uncertain;
  if (file.physical) {
    infer_profile(file);
    if (source == Source::asked) free_balls_of_machine(file);
  }
  uncertain.values = take_uncertain(file);
  const Refuse refuse = refuse_in(file);
  if (file.physical) {
    check_scales(file);
    refuse_several_ways(result, refuse);
  }
  read_rotor(file, result);
  read_balancer(file, result);
  read_speed(file, result);
  read_release(file, result);
  read_initial(file, result);
  read_sampling(file, result);
  for (const char* table : {"numerics", "limits", "sweep", "standards"}) read_table(file, table, result);
  read_units(file, result);
  if (file.physical) {
    const auto machine = std::make_shared<const Study>(std::move(result));
    result = nondimensionalise(*machine, refuse);
    result.in_si = machine;
  } else if (!result.states("rotor.inertia")) {
    result.parameters.inertia = usual_inertia(result.parameters);
  }
  check_numbers(result, refuse);
  const bool no_place = states_no_place(result);
  if (no_place) put_at_rest(result, refuse);
  check_needs(result, refuse);
  if (uncertain.empty()) return result;
  if (file.physical) {
    uncertain.physical = file.root;
    uncertain.horizon = result.numerics.horizon;
  }
  const bool weighs = std::any_of(uncertain.values.begin(), uncertain.values.end(),
                                  [](const UncertainValue& v) { return v.key == "rotor.gravity"; });
  uncertain.rests = no_place && (weighs || result.parameters.gravity != 0.0);
  result.uncertain = std::move(uncertain);
  check_ends(file, result);
  return result;
}

}  // namespace

Study parse_study(const std::string& toml_text, const std::string& name, const std::vector<std::string>& overrides) {
  return read(parse_study_file(toml_text, name, overrides));
}

Study parse_kept_study(const std::string& toml_text, const std::string& name) {
  return read(parse_study_file(toml_text, name, {}), Source::kept);
}

Study study_from(const StudyValue& tree, const std::string& name, const std::vector<std::string>& overrides) {
  return read(study_file_of(tree, name, overrides));
}

Study with_medians(Study study) {
  study.uncertain = {};
  return study;
}

namespace {
// What draws are put into: the study, or its machine in SI units, whose sampling and numerics may have changed since it
// was read.
Study drawn_from(const Study& study) {
  if (!study.in_si) return with_medians(study);
  Study machine = *study.in_si;
  machine.name = study.name;
  machine.sampling = {study.sampling.method, study.sampling.starts, study.sampling.seed, machine.sampling.box};
  machine.numerics.decide = study.numerics.decide;
  if (study.numerics.tolerance) machine.numerics.tolerance = study.numerics.tolerance;
  const std::optional<double>& horizon = study.numerics.horizon;
  if (horizon && horizon != study.uncertain.horizon) machine.numerics.horizon = *horizon * study.scales->time();
  return machine;
}
}  // namespace

Study drawn_study(const Study& study, std::span<const double> values) {
  const std::vector<UncertainValue>& uncertain = study.uncertain.values;
  const Refuse refuse = [&](const std::string& key, const std::string& problem) {
    std::string value;
    for (std::size_t k = 0; k < uncertain.size(); ++k)
      if (uncertain[k].key == key) value = shown(uncertain[k].written(values[k]));
    throw InputError(study.name, key, value, problem);
  };
  Study drawn = drawn_from(study);
  std::vector<NumberAt> numbers;
  for (std::size_t k = 0; k < uncertain.size(); ++k)
    numbers.push_back({uncertain[k].key, number_of(drawn, uncertain[k], values[k], refuse)});
  put_numbers(drawn, numbers);
  if (study.in_si) drawn = nondimensionalise(drawn, refuse);
  check_numbers(drawn, refuse);
  if (study.uncertain.rests) put_at_rest(drawn, refuse);
  return drawn;
}

namespace {
// What a physical study with uncertain values states, as written, in dimensionless terms.
std::string text_of_written(const Study& study) {
  StudyValue tree = to_tree(with_medians(study));
  for (const char* table : {"sampling", "numerics"}) tree.erase(table);
  return toml_text(tree);
}
}  // namespace

// The same rules for studies from files, trees and code.
void check(const Study& study) {
  const std::string name = study.name.empty() ? "study" : study.name;
  const Study again = read(study_file_of(to_tree(study), name, {}));
  if (study.uncertain.physical && text_of_written(again) != text_of_written(study))
    throw InputError(name, "", "",
                     "was changed after it was read, which its draws in physical units would not show; must be changed "
                     "by overrides, or after with_medians()");
}

}  // namespace equipoise
