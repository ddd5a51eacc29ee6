// Reads KEY=FROM:TO:STEP, and makes the study at each value.
#include "equipoise/analyses/continuation/parameter_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/stepped_values.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/study/echo/given_value.hpp"
#include "equipoise/study/contents/keys.hpp"
#include "equipoise/study/reading/rules.hpp"
#include "equipoise/study/toml/toml_tree.hpp"

namespace equipoise {

namespace {

constexpr char line_form[] =
    "must be KEY=FROM:TO:STEP with three numbers, e.g. speed.final=1.4:6.5:0.05; in a study with units also "
    "quantities, e.g. \"speed.final=900 rpm:4000 rpm:50 rpm\"";

}  // namespace

ParameterLine::ParameterLine(const Study& study, const std::string& text, const std::string& where)
    : study_(with_medians(study)) {
  parse(text, where);
  for (const double value : values_) {
    try {
      check_at(value, where);
    } catch (const InputError& e) {
      throw InputError(fmt::format("{} {}", where, text), e.key(), e.value(), e.problem());
    }
  }
}

void ParameterLine::check_at(double value, const std::string& where) const {
  const Study there = study_at(value);
  check_offers(there, model::ResultKind::branches);
  if (const model::System system = there.system(); system.prescribed() && system.speed() == 0.0)
    throw InputError(where, key_, fmt::format("{}", value), "nothing turns; the final speed must not be 0");
}

std::optional<double> ParameterLine::half_way(std::size_t value) const {
  if (value + 1 >= values_.size()) return std::nullopt;
  const double largest = std::max(std::fabs(values_.front()), std::fabs(values_.back()));
  const double middle = to_twelve_digits(0.5 * (values_[value] + values_[value + 1]), largest);
  try {
    check_at(middle, "");
  } catch (const InputError&) {
    return std::nullopt;
  }
  return middle;
}

void ParameterLine::parse(const std::string& text, const std::string& where) {
  const auto reject = [&](const std::string& problem) { throw InputError(where, "", text, problem); };
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) reject(line_form);
  key_ = text.substr(0, equals);
  std::vector<double> parts;
  const auto unit = study::unit_of(study_, key_);
  for (const std::string& given : parts_of(text.substr(equals + 1), ':')) {
    const study::GivenValue part = study::read_given(given, unit);
    if (!part.problem.empty() || !std::isfinite(part.value))
      reject((unit ? part.problem + "; " : std::string()) + line_form);
    parts.push_back(part.value);
  }
  if (parts.size() != 3) reject(line_form);
  const std::string table = key_.substr(0, key_.find('.'));
  if ((table != "rotor" && table != "balancer" && table != "speed") || table == key_ || key_ == "balancer.balls")
    reject(fmt::format("KEY must be a key of rotor, balancer or speed that takes a number, or speed.final; {}",
                       line_form));
  const double step = parts[2];
  if (const std::string problem = stepped_values(parts[0], parts[1], step, most_line_values, values_); !problem.empty())
    reject(problem);
  if (step < 0.0) std::reverse(values_.begin(), values_.end());
  step_ = std::fabs(step);
}

double* initial_value(InitialState& start, int balls, const std::string& key) {
  for (int i = 0; i < balls; ++i) {
    const auto ball = static_cast<std::size_t>(i);
    if (key == fmt::format("initial.phi_{}", i + 1)) return &start.phi[ball];
    if (key == fmt::format("initial.phi_dot_{}", i + 1)) return &start.phi_dot[ball];
  }
  constexpr std::array<std::pair<const char*, double InitialState::*>, 9> of_rotor{
      {{"initial.x", &InitialState::x},
       {"initial.y", &InitialState::y},
       {"initial.x_dot", &InitialState::x_dot},
       {"initial.y_dot", &InitialState::y_dot},
       {"initial.psi", &InitialState::psi},
       {"initial.tilt_x", &InitialState::tilt_x},
       {"initial.tilt_y", &InitialState::tilt_y},
       {"initial.tilt_x_dot", &InitialState::tilt_x_dot},
       {"initial.tilt_y_dot", &InitialState::tilt_y_dot}}};
  for (const auto& [name, value] : of_rotor)
    if (key == name) return &(start.*value);
  return nullptr;
}

namespace {

// A study in physical units has become dimensionless here. Numbers that follow from several of its values do not change
// as they would if one of those were given otherwise.
void refuse_if_derived(const Study& study, const std::string& key) {
  if (!study.scales) return;
  const std::size_t dot = std::min(key.rfind('.'), key.size() - 1);
  const study::KeyTable* table = study::find_keys(key.substr(0, dot));
  const std::string own = key.substr(dot + 1);
  if (table && table->find(own, true) && !table->find(own, false))
    throw InputError(
        study.name, key, "",
        "is a key of data sheets; this command varies what they become, such as rotor.eccentricity, balancer.mass and "
        "balancer.drag; \"equipoise sweep\" reads the whole study again for each value, and takes any key");
  if (!study.parameters.tilts()) return;
  const auto is = [&](const char* name) { return key == name; };
  if (study.parameters.tilt.misalignment != 0.0 &&
      (is("rotor.tilt.transverse_inertia") || is("rotor.tilt.polar_inertia")))
    throw InputError(study.name, key, "",
                     "here only the inertia would change and the angle of the couple unbalance stay, so that another "
                     "couple would act; \"equipoise sweep\" reads the whole study again for each value");
  if (!study.bearings.empty() && (is("rotor.damping") || is("rotor.stiffness")))
    throw InputError(study.name, key, "", study::bearings_state_it);
}
}  // namespace

Study study_with(const Study& original, const std::string& key, double value) {
  refuse_if_derived(original, key);
  Study study = with_medians(original);
  if (key.starts_with("initial.phi_"))  // of one ball: no key of a study file
    if (double* initial = initial_value(study.initial, study.parameters.balls, key)) {
      *initial = value;
      check(study);
      return study;
    }
  const study::NumberAt number{key, value};
  if (study::put_valid_numbers(study, {&number, 1})) return study;
  if (key == "speed.final") {
    check(study);
    return study;
  }
  StudyValue tree = to_tree(with_medians(original));
  // release.speed and release.time replace each other.
  if (StudyValue* release = tree.find("release"); release && key.starts_with("release."))
    release->erase(key == "release.speed" ? "time" : "speed");
  return study_from(tree, study.name, {key + "=" + study::number_text(value)});
}

Study ParameterLine::study_at(double value) const { return study_with(study_, key_, value); }

model::System ParameterLine::system_at(double value) const { return study_at(value).system(); }

}  // namespace equipoise
