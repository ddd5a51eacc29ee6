// The checks of a study before any work, and the key that an error names.
#include "equipoise/classification/start_runs/checks.hpp"

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/classification/rotor_family/study_family.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"
#include "equipoise/simulation/transients/clamped_transients.hpp"
#include "equipoise/study/echo/given_value.hpp"

namespace equipoise {

namespace {

const char* final_speed_key(const Study& study) {
  const Profile profile = study.speed.profile;
  return profile == Profile::constant ? "speed.speed" : profile == Profile::points ? "speed.speeds" : "speed.final";
}

// The key that makes a study miss a need, and its value.
std::pair<const char*, std::string> blamed(const Study& study, model::Need need) {
  using model::Need;
  const model::Parameters& p = study.parameters;
  const auto number = [](double v) { return fmt::format("{}", v); };
  const auto pair = [](const std::array<double, 2>& v) { return fmt::format("[{}, {}]", v[0], v[1]); };
  const auto supports = [&]() -> std::pair<const char*, std::string> {
    if (p.stiffness[0] != p.stiffness[1]) return {"rotor.stiffness", pair(p.stiffness)};
    return {"rotor.damping", pair(p.damping)};
  };
  switch (need) {
    case Need::prescribed_speed:
      return {"speed.profile", "torque"};
    case Need::passing_balls:
      return {"balancer.contact_angle", number(p.contact_angle)};
    case Need::sliding_balls:
      if (p.rolling[0] > 0.0) return {"balancer.rolling", number(p.rolling[0])};
      return {"balancer.stiction", number(p.stiction[0])};
    case Need::centred_race:
      return {"balancer.race_offset", pair(p.race_offset)};
    case Need::equal_supports:
      return supports();
    case Need::no_gravity:
      return {"rotor.gravity", number(p.gravity)};
    case Need::turning:
      return {final_speed_key(study), "0"};
    default:
      return {"speed.torque", "0 in the end"};
  }
}

std::string values_text(const Uncertainty& uncertain, const std::vector<double>& values) {
  std::string text;
  for (std::size_t k = 0; k < values.size(); ++k)
    text += fmt::format("{}{} = {}", k ? ", " : "", uncertain.values[k].key, uncertain.values[k].text(values[k]));
  return text;
}

void check_corner(const Study& study, const std::vector<double>& values, bool transients) {
  try {
    check_runnable(drawn_study(study, values), transients);
  } catch (const InputError& e) {
    throw InputError(e.place(), e.key(), e.value(),
                     fmt::format("{}; with {}", e.problem(), values_text(study.uncertain, values)));
  }
}

// Tries a study with uncertain values at its medians, and with all values at their ends. Throws InputError if its
// starts cannot be decided there.
void check_drawable(const Study& study, bool transients) {
  if (study.numerics.decide != ClassificationMode::validated)
    throw InputError(
        study.name, "numerics.decide", classification_mode_names[static_cast<std::size_t>(study.numerics.decide)],
        "with uncertain values every start is followed to a motion of its own rotor; must be \"validated\"");
  check_runnable(with_medians(study), transients);
  const std::vector<UncertainValue>& uncertain = study.uncertain.values;
  if (uncertain.size() > most_tried_together) return;  // the study reader has tried each end by itself
  for (std::size_t corner = 0; corner < std::size_t{1} << uncertain.size(); ++corner) {
    std::vector<double> values;
    for (std::size_t k = 0; k < uncertain.size(); ++k) values.push_back(uncertain[k].ends()[(corner >> k) & 1]);
    check_corner(study, values, transients);
  }
}

// For a tilting rotor, clamped balls are followed only at a prescribed speed, and no energy is known that would show
// whether it coasts to rest.
void check_tilting(const Study& study) {
  if (!study.parameters.tilts()) return;
  const bool clamped = study.release_time() > 0.0;
  const auto refuse = [&](const study::StatedValue& stated, const char* why) {
    throw InputError(study.name, stated.key, stated.text, why);
  };
  if (clamped && study.speed.driven())
    refuse(study::stated_release(study),
           "balls of a rotor with rotor.tilt that a motor drives are free from the beginning, without [release]");
  if (study.speed.driven() && study.system().coasts())
    refuse({"speed.torque", "0 in the end"},
           "with rotor.tilt, starts of a rotor that ends up coasting cannot be decided (simulate follows one)");
}

// Throws InputError if the spin-up with clamped balls is too long to look for peaks in it.
void check_watchable(const Study& study) {
  const double release = study.release_time();
  const double points = clamped_grid_points(study.parameters, model::segments(study.speed_profile(), release));
  if (points <= most_clamped_grid_points) return;
  const study::StatedValue stated = study::stated_release(study);
  const auto time = [&](double t) { return study::in_own_unit(t, study::Dimension::time, study.scales); };
  throw InputError(study.name, stated.key, stated.text,
                   fmt::format("holds the balls until t = {}, too long to watch for transients; must release them by "
                               "about t = {}, or the study must do without [limits] and transients",
                               time(release), time(release * (most_clamped_grid_points / points))));
}

void check_decidable(const Study& study) {
  check_has_balls(study);
  check_cost(study);
  const double speed = study.speed_profile().final_speed();
  // No machine is faster, and the integrator's steps shrink with the speed.
  if (std::fabs(speed) > runaway_speed)
    throw InputError(
        study.name, final_speed_key(study), fmt::format("{:.6g}", speed),
        fmt::format("basin and attractors take final speeds from -{0:g} to {0:g} critical speeds", runaway_speed));
  if (study.numerics.decide == ClassificationMode::proof)
    if (const auto lack = model::lacking(study.system(), model::ResultKind::proofs))
      throw InputError(study.name, "numerics.decide", "proof",
                       fmt::format("{}; must be \"validated\" or \"horizon\"", lack->reason));
  reject_if_lacking(study, model::ResultKind::shares);
  check_tilting(study);
}

}  // namespace

void reject_if_lacking(const Study& study, model::ResultKind answer) {
  const auto lack = model::lacking(study.system(), answer);
  if (!lack) return;
  const auto [key, value] = blamed(study, lack->need);
  throw InputError(study.name, key, value, lack->reason);
}

void check_has_balls(const Study& study) {
  if (study.parameters.balls == 0)
    throw InputError(study.name, "balancer.balls", "0",
                     fmt::format("leaves nothing to balance with; must be 1 to {} here: only basin, report, simulate "
                                 "and explain take a rotor without balls",
                                 model::max_balls));
}

void check_offers(const Study& study, model::ResultKind answer) {
  check(study);
  check_has_balls(study);
  reject_if_lacking(study, answer);
}

void check_runnable(const Study& study, bool transients) {
  check(study);
  check_decidable_as_read(study, transients);
}

void check_decidable_as_read(const Study& study, bool transients) {
  if (!study.uncertain.empty()) return check_drawable(study, transients);
  check_decidable(study);
  if (transients) reject_if_lacking(study, model::ResultKind::transients);
  if (transients && !study.speed.driven() && !study.parameters.tilts()) check_watchable(study);
}

}  // namespace equipoise
