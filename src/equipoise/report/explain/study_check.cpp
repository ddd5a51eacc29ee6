// Machine, unbalance, balls and assumptions, each in a line.
#include "equipoise/report/explain/explain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/report/decision/verdict.hpp"
#include "equipoise/report/explain/parts.hpp"
#include "equipoise/report/text/quantities.hpp"
#include "equipoise/report/text/grade_text.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/results/commands/left_grade.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise {

namespace {

constexpr char up_to[] = "up to";
constexpr char at_most[] = "at most";
using study::Dimension;

// "12 kg" of a study with scales, else "0.05 R".
std::string quantity(const Study& s, double value, Dimension dimension) {
  std::string number = engineering(s.scales, value, dimension);
  if (s.scales) return number;
  const char* unit = dimension == Dimension::mass        ? "M"
                     : dimension == Dimension::stiffness ? "k"
                     : dimension == Dimension::inertia   ? "M R^2"
                                                         : study::words(dimension).dimensionless;
  return number + " " + unit;
}

// Two values, given once if they are equal.
template <class Text>
std::string of_both(const std::array<double, 2>& values, Text&& text) {
  return values[0] == values[1] ? text(values[0]) : fmt::format("{} and {} (x, y)", text(values[0]), text(values[1]));
}

std::string machine_line(const Explanation& e) {
  const Study& s = e.study;
  const auto& [first, second] = e.critical_with_balls;
  const auto speed = [&](double v) { return quantity(s, v, Dimension::speed); };
  std::string speeds,
      line = s.scales ? fmt::format("{} on ", engineering(s.scales->mass, Dimension::mass)) : "supports of ";
  line += of_both(s.parameters.stiffness, [&](double kappa) { return quantity(s, kappa, Dimension::stiffness); });
  if (e.tilt)
    for (const double critical : e.tilt->with_balls.excited()) speeds += (speeds.empty() ? "" : ", ") + speed(critical);
  line += e.tilt ? ", tilting, critical speeds " + speeds : ", critical speed " + of_both(e.critical_with_balls, speed);
  if (s.parameters.balls > 0) line += " with its balls";
  if (!e.speed) return line + "; no speed is held in the end";
  if (e.run_up && !e.run_up->shaken)
    return line +
           fmt::format(
               "; made to run at {}, but may stall at {}, where its own unbalance takes all that the motor gives",
               speed(*e.speed), speed(e.run_up->stalls_at));
  return line + fmt::format("; runs at {}, {:.3g} times {}", speed(*e.speed),
                            std::abs(*e.speed) / std::max(first, second),
                            e.tilt            ? "the highest"
                            : first == second ? "that"
                                              : "the higher");
}

std::string unbalance_line(const Explanation& e) {
  const Study& s = e.study;
  const double eccentricity = s.parameters.eccentricity;
  std::string line = quantity(s, eccentricity, Dimension::unbalance);
  if (e.tilt) line = fmt::format("{} static and {} couple", line, quantity(s, e.tilt->couple, Dimension::inertia));
  if (s.scales) {
    line += fmt::format(", its centre of mass {} from the shaft", quantity(s, eccentricity, Dimension::length));
    if (const auto grade = e.speed ? own_balance_grade(s, *e.speed) : std::nullopt)
      line += fmt::format(fmt::runtime(e.tilt ? "; {} in the worse plane of its bearings at {}" : "; {} at {}"),
                          grade_text(*grade), quantity(s, *e.speed, Dimension::speed));
  }
  if (!e.tilt && e.unbalance != eccentricity)
    line += fmt::format("; the off-centre race makes it {} at the final speed, which the balls have to cancel",
                        quantity(s, e.unbalance, Dimension::unbalance));
  return line;
}

// Where it comes from, of a study with places.
std::string origin_of_unbalance(const Study& s, const Explanation& e) {
  const std::size_t places = s.sheet.places.size();
  if (!s.sheet.unbalances.empty() || (places > 0 && s.parameters.tilts()))
    return e.tilt && e.tilt->couple == 0.0 ? "; x of the model points at 0 degrees"
                                           : fmt::format("; x of the model points along the couple, at {:.3g} degrees",
                                                         180.0 / pi * e.study.direction_of_x);
  if (places == 0) return "";
  const bool own = s.states("rotor.eccentricity") || s.states("rotor.unbalance") || s.states("rotor.balance_grade");
  const double degrees = 180.0 / pi * e.study.direction_of_x;
  return fmt::format("; the resultant of {}{} place{}, at {:.3g} degrees, where x of the model points",
                     own ? "the rotor's own and of " : "", places, plural(places), degrees == 0.0 ? 0.0 : degrees);
}

// Where balance is possible.
std::string but_unstable(const Explanation& e) {
  if (e.motion) return e.motion->stable ? "" : ", but balance is not stable at the final speed";
  return e.speed && *e.speed != 0.0 ? ", but whether balance is stable is not known: " + e.no_motion : "";
}

// Of a tilting machine: what the balls of each plane can cancel.
std::string planes_words(const Explanation& e) {
  std::string line;
  for (const ExplainedPlane& plane : e.tilt->planes) {
    const std::string at = quantity(e.study, plane.at, Dimension::length);
    const bool too_heavy = plane.least > plane.unbalance;
    const char* how = too_heavy ? "no less than" : plane.most < plane.unbalance ? at_most : up_to;
    line += plane.unbalance > 0.0 ? fmt::format("; at {} they cancel {} {:.3g} times the unbalance", at, how,
                                                (too_heavy ? plane.least : plane.most) / plane.unbalance)
                                  : fmt::format("; at {} there is nothing to cancel", at);
  }
  if (e.balanced.kind != model::BalancedStates::Kind::none) return line + but_unstable(e);
  return line + fmt::format(": balance is impossible ({})", e.balanced.reason);
}

std::string balls_line(const Explanation& e) {
  const Study& s = e.study;
  const model::Parameters& p = s.parameters;
  if (p.balls == 0) return "none: nothing cancels the unbalance";
  const auto [least, most] = std::minmax_element(p.mass.begin(), p.mass.begin() + p.balls);
  std::string masses = quantity(s, *least, Dimension::mass);
  if (*least != *most) masses += " to " + quantity(s, *most, Dimension::mass);
  std::string line = fmt::format("{} of {}{}", p.balls, masses, p.balls == 1 ? "" : " each");
  if (s.scales) line += fmt::format(" on a circle of {}", engineering(s.scales->length, Dimension::length));
  if (e.tilt) return line + planes_words(e);
  const std::string least_cancelled =
      e.least_unbalance == 0.0 ? "0" : quantity(s, e.least_unbalance, Dimension::unbalance);
  const std::string range =
      fmt::format("from {} to {}", least_cancelled, quantity(s, e.largest_unbalance, Dimension::unbalance));
  if (e.unbalance == 0.0) return line + fmt::format("; they cancel {}, and there is nothing to cancel", range);
  const bool can = e.balanced.kind != model::BalancedStates::Kind::none;
  return line + fmt::format("; they cancel {}, {} {:.3g} times the unbalance{}", range, can ? up_to : at_most,
                            e.largest_unbalance / e.unbalance,
                            can ? but_unstable(e) : std::string(": balance is impossible"));
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
    list_.push_back(s_.release_time() == 0.0 ? "balls free from t = 0" : "balls held until the run-up is over");
  }

  void add_balls() {
    const model::Parameters& p = s_.parameters;
    if (!states("balancer.contact") && !states("balancer.contact_angle") && p.balls > 1)
      list_.push_back(p.contact_angle > 0.0 ? "balls touch" : "balls pass through each other");
    if (p.contact_angle > 0.0) add("balancer.restitution", fmt::format("restitution {:.3g}", p.restitution));
    add("balancer.rolls", p.rolls ? "balls roll without sliding" : "balls are points that slide");
    add("balancer.rolling", "no rolling resistance");
    add("balancer.race_offset", "race centred on the shaft");
    if (states("balancer.ball_material")) list_.push_back(fmt::format("typical density of {}", s_.sheet.material));
  }

  void add_drag() {
    if (!s_.sheet.oil_viscosity) return;
    const std::string eta = fmt::format("{:.3g} mPa s", 1000.0 * *s_.sheet.oil_viscosity);
    if (states("balancer.oil.grade")) {
      const bool mineral = s_.sheet.oil_grade.find("VG") != std::string::npos;
      list_.push_back(!mineral ? fmt::format("oil of {}, by the law of silicone oils", eta)
                      : states("balancer.oil.viscosity_100")
                          ? fmt::format("oil of {}, in the middle of its class", eta)
                          : fmt::format("oil of {}, in the middle of its class, viscosity index 95", eta));
    }
    list_.push_back(states("balancer.channel_diameter") ? "drag of a ball on the axis of a tube"
                                                        : "Stokes drag, without walls");
  }

  void add_supports() {
    if (s_.parameters.stiffness[0] == s_.parameters.stiffness[1]) list_.push_back("supports alike in x and y");
    list_.push_back("viscous damping");
    if (s_.parameters.tilts()) list_.push_back("small slopes, balls that stay in their planes");
    add("rotor.gravity", "no gravity across the shaft");
    if (s_.uncertain.empty()) return;
    list_.emplace_back(medians_assumed);
    if (std::any_of(s_.uncertain.values.begin(), s_.uncertain.values.end(),
                    [](const UncertainValue& v) { return v.has_no_direction(); }))
      list_.back() += ", angles that are drawn all round at a quarter turn";
  }

  const Study& s_;
  std::vector<std::string> list_;
};

}  // namespace

const char* const medians_assumed = "uncertain values at their medians";

std::string StudyCheck::text() const {
  const std::string first = leave_out.empty() ? "" : fmt::format(leave_balancer_out, leave_out) + "\n";
  return first + fmt::format("Machine: {}.\nUnbalance: {}.\nBalls: {}.\nAssumed: {}.\nMost sensitive to: {}.\n",
                             machine, unbalance, balls, fmt::join(assumed, "; "), most);
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
