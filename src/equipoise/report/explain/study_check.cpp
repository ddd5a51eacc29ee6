// Machine, unbalance, balls and assumptions, each in a line.
#include "equipoise/report/explain/study_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/plural.hpp"
#include "equipoise/report/decision/below_resonance.hpp"
#include "equipoise/report/explain/explain.hpp"
#include "equipoise/report/explain/what_matters.hpp"
#include "equipoise/report/text/carrying_text.hpp"
#include "equipoise/report/text/engineering.hpp"
#include "equipoise/report/text/grade_text.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/report/words/study_check.hpp"
#include "equipoise/report/words/text.hpp"
#include "equipoise/results/commands/left_grade.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise {

namespace {
using study::Dimension;

// "12 kg" of a study with scales, else "0.05 R".
std::string quantity(const Study& s, double value, Dimension dimension) {
  if (s.scales) return engineering(value * study::scale_of(dimension, *s.scales), dimension);
  return fmt::format("{:.5g} {}", value, study::words(dimension).dimensionless);
}

std::string speed_of(const Study& s, double speed) {
  return s.scales ? rotor_speed_text(s, speed) : fmt::format("{:.5g} omega_c", speed);
}

// Two values, told once if they are alike.
template <class Text>
std::string of_both(const std::array<double, 2>& values, Text&& text) {
  return values[0] == values[1] ? text(values[0]) : fmt::format("{} and {} (x, y)", text(values[0]), text(values[1]));
}

const char* with_balls(const Explanation& e) {
  return e.study.parameters.balls > 0 ? words::study_check::with_its_balls : "";
}

// Of a machine that tilts: its critical speeds and its speed.
std::string whirl_words(const Explanation& e) {
  std::string speeds;
  for (const double speed : e.tilt->with_balls.excited())
    speeds += (speeds.empty() ? "" : ", ") + speed_of(e.study, speed);
  const std::string line = fmt::format(words::study_check::tilting_with_critical_speeds, speeds) + with_balls(e);
  if (!e.speed) return line + words::study_check::no_speed_held;
  return line + fmt::format(words::study_check::runs_at_highest, speed_of(e.study, *e.speed),
                            std::abs(*e.speed) / e.critical_with_balls[1]);
}

std::string machine_line(const Explanation& e) {
  const Study& s = e.study;
  std::string line = s.scales ? fmt::format(words::study_check::mass_on, engineering(s.scales->mass, Dimension::mass))
                              : words::study_check::supports_of;
  const auto stiffness = [&](double kappa) {
    return s.scales ? engineering(kappa * study::scale_of(Dimension::stiffness, *s.scales), Dimension::stiffness)
                    : fmt::format("{:.5g} k", kappa);
  };
  line += of_both(s.parameters.stiffness, stiffness);
  if (e.tilt) return line + whirl_words(e);
  line += fmt::format(words::study_check::with_critical_speed,
                      of_both(e.critical_with_balls, [&](double v) { return speed_of(s, v); })) +
          with_balls(e);
  const double critical = std::max(e.critical_with_balls[0], e.critical_with_balls[1]);
  if (e.run_up && !e.run_up->shaken)
    line += fmt::format(words::study_check::may_stall, speed_of(s, *e.speed), speed_of(s, e.run_up->stalls_at));
  else if (e.speed)
    line += fmt::format(words::study_check::runs_at, speed_of(s, *e.speed), std::abs(*e.speed) / critical,
                        e.critical_with_balls[0] == e.critical_with_balls[1] ? words::study_check::that
                                                                             : words::study_check::the_higher);
  else
    line += words::study_check::no_speed_held;
  return line;
}

std::string unbalance_line(const Explanation& e) {
  const Study& s = e.study;
  const double eccentricity = s.parameters.eccentricity;
  std::string line = quantity(s, eccentricity, Dimension::unbalance);
  if (e.tilt)
    line = fmt::format(
        words::study_check::static_and_couple, line,
        s.scales ? quantity(s, e.tilt->couple, Dimension::inertia) : fmt::format("{:.5g} M R^2", e.tilt->couple));
  if (s.scales) {
    line += fmt::format(words::study_check::centre_of_mass, quantity(s, eccentricity, Dimension::length));
    if (const auto grade = e.speed ? own_balance_grade(s, *e.speed) : std::nullopt)
      line +=
          fmt::format(fmt::runtime(e.tilt ? words::study_check::grade_in_planes : words::study_check::grade_at_speed),
                      grade_text(*grade), speed_of(s, *e.speed));
  }
  if (!e.tilt && e.unbalance != eccentricity)
    line += fmt::format(words::study_check::with_the_race, quantity(s, e.unbalance, Dimension::unbalance));
  return line;
}

// Where it comes from, of a study with places.
std::string origin_of_unbalance(const Study& s, const Explanation& e) {
  const std::size_t places = s.sheet.places.size();
  if (!s.sheet.unbalances.empty() || (places > 0 && s.parameters.tilts()))
    return e.tilt && e.tilt->couple == 0.0
               ? words::study_check::no_couple
               : fmt::format(words::study_check::couple_direction, 180.0 / pi * e.study.direction_of_x);
  if (places == 0) return "";
  const bool own = s.states("rotor.eccentricity") || s.states("rotor.unbalance") || s.states("rotor.balance_grade");
  const double degrees = 180.0 / pi * e.study.direction_of_x;
  return fmt::format(words::study_check::resultant_of_places, own ? words::study_check::of_the_rotor_too : "", places,
                     plural(places), degrees == 0.0 ? 0.0 : degrees);
}

// Where balance is possible.
const char* but_unstable(const Explanation& e) {
  return e.motion && !e.motion->stable ? words::study_check::balance_unstable : "";
}

// Of a machine that tilts: what the balls of each plane can cancel.
std::string planes_words(const Explanation& e) {
  std::string line;
  for (const ExplainedPlane& plane : e.tilt->planes) {
    const std::string at = quantity(e.study, plane.at, Dimension::length);
    const bool too_heavy = plane.least > plane.unbalance;
    const char* how = too_heavy                      ? words::study_check::no_less_than
                      : plane.most < plane.unbalance ? words::study_check::at_most
                                                     : words::study_check::up_to;
    line += plane.unbalance > 0.0 ? fmt::format(words::study_check::plane_cancels, at, how,
                                                (too_heavy ? plane.least : plane.most) / plane.unbalance)
                                  : fmt::format(words::study_check::nothing_to_cancel_at, at);
  }
  if (e.balanced.kind != model::BalancedStates::Kind::none) return line + but_unstable(e);
  return line + fmt::format(words::study_check::balance_impossible_as, e.balanced.reason);
}

std::string balls_line(const Explanation& e) {
  const Study& s = e.study;
  const model::Parameters& p = s.parameters;
  if (p.balls == 0) return words::study_check::no_balls;
  const auto [least, most] = std::minmax_element(p.mass.begin(), p.mass.begin() + p.balls);
  std::string masses = quantity(s, *least, Dimension::mass);
  if (!s.scales) masses = fmt::format("{:.5g} M", *least);
  if (*least != *most)
    masses += s.scales ? " to " + quantity(s, *most, Dimension::mass) : fmt::format(" to {:.5g} M", *most);
  std::string line = fmt::format("{} of {} {}", p.balls, masses, p.balls == 1 ? "" : "each");
  if (line.back() == ' ') line.pop_back();
  if (s.scales) line += fmt::format(words::study_check::on_a_circle, engineering(s.scales->length, Dimension::length));
  if (e.tilt) return line + planes_words(e);
  const std::string least_cancelled =
      e.least_unbalance == 0.0 ? "0" : quantity(s, e.least_unbalance, Dimension::unbalance);
  const std::string range =
      fmt::format("from {} to {}", least_cancelled, quantity(s, e.largest_unbalance, Dimension::unbalance));
  if (e.unbalance == 0.0) return line + fmt::format(words::study_check::nothing_to_cancel, range);
  const bool can = e.balanced.kind != model::BalancedStates::Kind::none;
  return line + fmt::format(words::study_check::balls_cancel, range,
                            can ? words::study_check::up_to : words::study_check::at_most,
                            e.largest_unbalance / e.unbalance,
                            can ? but_unstable(e) : words::study_check::balance_impossible_too);
}

// Under gravity.
std::string weight_words(const Explanation& e) {
  if (!e.carrying) return "";
  const std::string hanging = hanging_text(e.study);
  return "; " + (hanging.empty() ? carried_text(e.study, *e.carrying) : hanging);
}

class Assumptions {
 public:
  explicit Assumptions(const Study& s) : s_(s) {}

  std::vector<std::string> list() {
    if (s_.parameters.balls > 0) {
      add_release();
      add_balls();
      add_drag();
    }
    add_supports();
    return std::move(list_);
  }

 private:
  bool states(const char* key) const { return s_.states(key); }
  void add(const char* key, const std::string& words) {
    if (!states(key)) list_.push_back(words);
  }

  void add_release() {
    if (states("release.time") || states("release.speed") || s_.speed.profile == Profile::constant) return;
    list_.push_back(s_.release_time() == 0.0 ? words::study_check::balls_free_from_start
                                             : words::study_check::balls_held_in_run_up);
  }

  void add_balls() {
    const model::Parameters& p = s_.parameters;
    if (!states("balancer.contact") && !states("balancer.contact_angle") && p.balls > 1)
      list_.push_back(p.contact_angle > 0.0 ? words::study_check::balls_touch : words::study_check::balls_pass_through);
    if (p.contact_angle > 0.0) add("balancer.restitution", fmt::format(words::study_check::restitution, p.restitution));
    add("balancer.rolls", p.rolls ? words::study_check::balls_roll : words::study_check::balls_slide);
    add("balancer.rolling", words::study_check::no_rolling_resistance);
    add("balancer.race_offset", words::study_check::race_centred);
    if (states("balancer.ball_material"))
      list_.push_back(fmt::format(words::study_check::typical_density, s_.sheet.material));
  }

  void add_drag() {
    if (!s_.ball_details.oil_viscosity) return;
    const std::string eta = fmt::format("{:.3g} mPa s", 1000.0 * *s_.ball_details.oil_viscosity);
    if (states("balancer.oil.grade")) {
      const bool mineral = s_.sheet.oil_grade.find("VG") != std::string::npos;
      list_.push_back(!mineral ? fmt::format(words::study_check::silicone_oil, eta)
                      : states("balancer.oil.viscosity_100")
                          ? fmt::format(words::study_check::oil_of_middle, eta)
                          : fmt::format(words::study_check::oil_of_middle_and_index, eta));
    }
    list_.push_back(states("balancer.channel_diameter") ? words::study_check::drag_in_a_tube
                                                        : words::study_check::drag_of_stokes);
  }

  void add_supports() {
    if (s_.parameters.stiffness[0] == s_.parameters.stiffness[1]) list_.push_back(words::study_check::supports_alike);
    list_.push_back(words::study_check::viscous_damping);
    if (s_.parameters.tilts()) list_.push_back(words::study_check::small_slopes);
    add("rotor.gravity", words::study_check::no_gravity);
    if (s_.uncertain.empty()) return;
    list_.emplace_back(medians_assumed);
    if (std::any_of(s_.uncertain.values.begin(), s_.uncertain.values.end(),
                    [](const UncertainValue& v) { return v.has_no_direction(); }))
      list_.back() += words::study_check::angles_without_direction;
  }

  const Study& s_;
  std::vector<std::string> list_;
};

}  // namespace

const char* const medians_assumed = words::study_check::values_at_medians;

std::string StudyCheck::text() const {
  const std::string first = leave_out.empty() ? "" : fmt::format(words::text::leave_out, leave_out) + "\n";
  return first + fmt::format(words::study_check::lines, machine, unbalance, balls, fmt::join(assumed, "; "), most);
}

StudyCheck check_study(const std::string& toml_text, const std::string& name, const std::vector<std::string>& overrides,
                       const StopFlag* stop) {
  const Study study = parse_study(toml_text, name, overrides), medians = with_medians(study);
  const Explanation e = explain(medians, stop);
  StudyCheck check;
  check.leave_out = below_resonance_words(study);
  check.machine = machine_line(e);
  check.unbalance = unbalance_line(e) + origin_of_unbalance(study, e);
  check.balls = balls_line(e) + weight_words(e);
  check.assumed = Assumptions(study).list();
  check.most = what_matters_most(medians, stop);
  return check;
}

}  // namespace equipoise
