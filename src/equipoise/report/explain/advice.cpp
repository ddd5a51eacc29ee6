// Each rule of thumb applied to a study, beside what linear theory gives.
#include "equipoise/report/explain/parts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/machine/words/mechanics.hpp"
#include "equipoise/report/explain/balanced_motion.hpp"
#include "equipoise/report/explain/drag_scan.hpp"
#include "equipoise/report/explain/rules_of_thumb.hpp"
#include "equipoise/report/words/explain.hpp"
#include "equipoise/simulation/spin_up/run_up.hpp"

namespace equipoise {

namespace {
using study::Dimension;

void add(RuleOfThumb& rule, const char* symbol, const std::string& name, double value, std::optional<Dimension> d) {
  if (std::isfinite(value)) rule.figures.push_back({symbol, name, value, d});
}

double lowest(const std::array<double, 2>& pair) { return std::min(pair[0], pair[1]); }
double highest(const std::array<double, 2>& pair) { return std::max(pair[0], pair[1]); }

// The rotor that linear theory knows: the study's own, or the nearest one whose balls rest in balance.
struct NearBalance {
  model::Parameters parameters;
  double speed;
  std::array<double, model::max_balls> angles;
  bool family;
  std::string less;  // what was left out: "; without gravity"

  bool above_resonance() const { return speed > highest(rules::critical_speeds(parameters)); }
};

std::optional<NearBalance> near_balance(const Explanation& e, std::string& why_not) {
  const model::Parameters& own = e.study.parameters;
  if (!e.speed)
    why_not = e.speed_words;
  else if (std::abs(*e.speed) <= lowest(e.critical_with_balls))
    why_not = words::explain::below_resonance;
  if (!why_not.empty()) return std::nullopt;
  const double speed = std::abs(*e.speed);
  const model::Parameters p = model::centred_twin(model::weakened(own, 0.0), speed).parameters;
  const model::BalancedStates states = model::balanced_states(p);
  const auto angles = balanced_angles(states, p);
  if (!angles) {
    why_not = states.reason.empty() ? words::explain::no_balanced_state_found : states.reason;
    return std::nullopt;
  }
  std::string less;
  if (own.gravity != 0.0) less += words::explain::without_gravity_too;
  if (!own.isotropic()) less += words::explain::with_means_too;
  if (!own.race_is_centred()) less += words::explain::with_a_centred_race_too;
  return NearBalance{p, speed, *angles, states.kind == model::BalancedStates::Kind::continuum, less};
}

RuleOfThumb ball_mass(const Explanation& e) {
  const model::Parameters& p = e.study.parameters;
  RuleOfThumb rule{"ball_mass", words::explain::ball_mass, words::explain::ball_mass_formula,
                   words::explain::ball_mass_source};
  const double lambda = e.unbalance;
  rule.kept = e.balanced.kind != model::BalancedStates::Kind::none;
  rule.words = *rule.kept ? words::explain::balls_can_cancel : e.balanced.reason;
  add(rule, "", words::explain::most_cancelled, e.largest_unbalance, Dimension::unbalance);
  add(rule, "", words::explain::least_cancelled, e.least_unbalance, Dimension::unbalance);
  add(rule, "", "unbalance", lambda, Dimension::unbalance);
  if (p.balls == 2 && p.equal_balls() && lambda > 0.0)
    add(rule, "", words::explain::fastest_settling_mass, lambda / std::sqrt(2.0), Dimension::mass);
  return rule;
}

RuleOfThumb critical_speeds(const Explanation& e) {
  const model::Parameters& p = e.study.parameters;
  RuleOfThumb rule{"critical_speed", words::explain::critical_speed, words::explain::critical_speed_formula,
                   words::explain::critical_speed_source};
  const std::array<double, 2>& critical = e.critical_with_balls;
  const bool one = p.isotropic();
  for (int d = 0; d < (one ? 1 : 2); ++d) {
    const std::string direction = one ? "" : d == 0 ? ", x" : ", y";
    add(rule, "", words::explain::critical_speed_with_balls + direction, critical[static_cast<std::size_t>(d)],
        Dimension::speed);
    if (const auto peak = rules::speed_of_largest_vibration(p, d))
      add(rule, "", words::explain::largest_vibration + direction + words::explain::of_held_balls, *peak,
          Dimension::speed);
  }
  if (p.gravity > 0.0) add(rule, "", words::explain::resonance_by_weight, 0.5 * lowest(critical), Dimension::speed);
  const double least = rules::quiet_speed(p);
  add(rule, "", words::explain::run_above, least, Dimension::speed);
  if (!e.speed) {
    rule.words = e.speed_words;
    return rule;
  }
  rule.kept = std::abs(*e.speed) >= least;
  rule.words = *rule.kept ? words::explain::far_above_resonance : words::explain::near_resonance;
  if (!one && std::abs(*e.speed) > lowest(critical) && std::abs(*e.speed) < highest(critical))
    rule.words = words::explain::between_critical_speeds;
  return rule;
}

// The angle between two balls that balance; none if two cannot.
std::optional<double> spacing_in_balance(const Explanation& e) {
  const model::Parameters& p = e.study.parameters;
  if (p.balls != 2) return std::nullopt;
  const double a = p.mass[0], b = p.mass[1], cosine = (e.unbalance * e.unbalance - a * a - b * b) / (2.0 * a * b);
  return std::abs(cosine) <= 1.0 ? std::optional(std::acos(cosine)) : std::nullopt;
}

RuleOfThumb room(const Explanation& e) {
  const std::vector<double>& width = e.ball_width;
  RuleOfThumb rule{"room", words::explain::room, words::explain::room_formula, words::explain::room_source};
  if (width.empty()) {
    rule.words = words::explain::size_not_given;
    return rule;
  }
  const double all = std::accumulate(width.begin(), width.end(), 0.0),
               widest = *std::max_element(width.begin(), width.end());
  rule.kept = all <= two_pi;
  rule.words = *rule.kept ? words::explain::balls_fit : words::mechanics::balls_do_not_fit;
  add(rule, "", words::explain::angle_of_touching_balls, widest, Dimension::angle);
  add(rule, "", words::explain::balls_that_fit, std::floor(two_pi / widest * (1.0 + 1e-12)), std::nullopt);
  add(rule, "", words::explain::part_of_race_filled, all / two_pi, std::nullopt);
  // Three balls or more have many balanced states, some of them with room whenever rule ball_mass holds.
  const auto spacing = spacing_in_balance(e);
  if (!spacing) return rule;
  add(rule, "", words::explain::angle_in_balance, *spacing, Dimension::angle);
  if (*spacing < 0.5 * (width[0] + width[1])) {
    rule.kept = false;
    rule.words = words::explain::balls_would_overlap;
  }
  return rule;
}

void add_drag(RuleOfThumb& rule, const Explanation& e, const std::string& name, double beta) {
  add(rule, "beta", name, beta, std::nullopt);
  if (e.study.scales && e.study.parameters.equal_balls())
    add(rule, "D", name, beta * e.study.parameters.mass[0], Dimension::gain);
}

RuleOfThumb drag(const Explanation& e) {
  RuleOfThumb rule{"drag", words::explain::ball_drag, words::explain::drag_formula, words::explain::drag_source};
  const auto near = near_balance(e, rule.words);
  if (!near) return rule;
  const double own = rules::mean_drag(near->parameters);
  const double stiffness = rules::ball_stiffness(near->parameters, near->speed, near->angles.data());
  if (stiffness <= 0.0) {
    rule.words = near->above_resonance() ? words::explain::all_balls_on_a_line
                                         : words::explain::no_return_between_critical_speeds;
    return rule;
  }
  const double best = rules::settling_drag(near->parameters, stiffness);
  double from = rules::least_of_settling_drag * best, to = rules::most_of_settling_drag * best;
  add_drag(rule, e, "from", from);
  add_drag(rule, e, "to", to);
  bool unstable = false;
  if (own > 0.0) {
    // Drags a thousand times less and more than either: nobody has a choice of more.
    const double low = std::min(best, own) / (1e3 * own), high = std::max(best, own) * 1e3 / own;
    const DragScan scan(near->parameters, near->speed, near->angles, near->family);
    if (const auto range = scan.range(rules::settling_share, low, high)) {
      from = range->low * own;
      to = range->high * own;
      add_drag(rule, e, words::explain::from_by_linear_theory, from);
      add_drag(rule, e, words::explain::fastest_by_linear_theory, range->best * own);
      add_drag(rule, e, words::explain::to_by_linear_theory, to);
    } else {
      unstable = true;
    }
  }
  rule.kept = own >= from && own <= to && !unstable;
  rule.words = unstable     ? words::explain::no_drag_stabilises
               : own < from ? words::explain::too_little_drag
               : own > to   ? words::explain::too_much_drag
                            : words::explain::drag_settles_fast;
  rule.words += near->less;
  // Linear theory leaves less out.
  if (rule.kept == true && e.motion && !e.motion->stable) {
    rule.kept = false;
    rule.words += words::explain::with_which_unstable;
  }
  const double against = rules::drag_against_capture(e.study.parameters, near->speed);
  add_drag(rule, e, words::explain::drag_against_lagging, against);
  if (own < against) rule.words += words::explain::may_lag_too;
  return rule;
}

RuleOfThumb carried(const Explanation& e) {
  RuleOfThumb rule{"carried", words::explain::carried, words::explain::carried_formula, words::explain::carried_source};
  const model::Carrying& c = *e.carrying;
  rule.kept = !c.may_hang();
  rule.words = c.reached >= c.all ? words::explain::carried_from_rest
               : c.turning        ? words::explain::not_carried_but_turning
                                  : words::explain::not_carried;
  add(rule, "", words::explain::carries_all_from, c.all, Dimension::speed);
  add_drag(rule, e, words::explain::least_drag_of_one, e.study.parameters.gravity / c.reached);
  return rule;
}

RuleOfThumb settling(const Explanation& e) {
  RuleOfThumb rule{"settling", words::explain::settling, words::explain::settling_formula,
                   words::explain::settling_source};
  const auto near = near_balance(e, rule.words);
  if (!near) return rule;
  const double stiffness = rules::ball_stiffness(near->parameters, near->speed, near->angles.data());
  const double time = rules::settling_time(near->parameters, std::max(stiffness, 0.0));
  // Linear theory may leave less out than the rule.
  const bool knows_more = e.motion && e.motion->less.empty() && !near->less.empty();
  rule.words =
      words::explain::falls_to_a_part + (knows_more ? words::explain::the_rule + near->less.substr(2) : near->less);
  if (!std::isfinite(time))
    rule.words = stiffness > 0.0 ? words::explain::nothing_settles : words::explain::nothing_returns;
  if (e.study.parameters.balls_stick()) rule.words += words::explain::friction_holds_too;
  add(rule, "", words::explain::by_the_rule, time, Dimension::time);
  const double rate = e.motion ? e.motion->slowest_rate
                               : DragScan(near->parameters, near->speed, near->angles, near->family).slowest(1.0);
  if (rate < -least_rate)
    add(rule, "", words::explain::by_linear_theory, -1.0 / rate, Dimension::time);
  else
    rule.words +=
        rate > least_rate ? words::explain::unstable_by_linear_theory : words::explain::undecided_by_linear_theory;
  return rule;
}

// The motor's torque at this speed during run-up; none if the study does not bound it.
std::optional<double> torque_at(const Study& study, double speed) {
  const TorqueSetting& t = study.speed.torque;
  using Kind = model::MotorLaw::Kind;
  if (t.kind == Kind::linear || t.kind == Kind::curve)
    return model::drive_segments(study.motor()).front().torque(0.0, speed, 0.0);
  if (t.kind == Kind::table) return *std::max_element(t.values.begin(), t.values.end());
  if (t.integral != 0.0) return t.limit;  // the integral grows until the rotor is through, or the limit holds it
  const double given = t.gain * (study.motor().target.final_speed() - speed);
  return t.limit ? std::min(given, *t.limit) : given;
}

RuleOfThumb torque(const Explanation& e) {
  const model::Parameters& p = e.study.parameters;
  RuleOfThumb rule{"torque", words::explain::motor_torque, words::explain::torque_formula,
                   words::explain::torque_source};
  const double critical = highest(e.critical_with_balls), first = lowest(e.critical_with_balls);
  const auto need = [&](double unbalance) {
    return std::max(rules::shaking_torque(p, unbalance, first), rules::shaking_torque(p, unbalance, critical));
  };
  const double alone = need(p.eccentricity), together = need(p.all_unbalances());
  if (e.speed && std::abs(*e.speed) <= first) {
    rule.words = words::explain::final_speed_below;
    return rule;
  }
  if (e.study.speed.driven() && std::abs(e.study.speed.initial) > critical) {
    rule.words = words::explain::above_from_the_beginning;
    return rule;
  }
  if (!std::isfinite(together)) {
    rule.words = words::explain::no_torque_without_damping;
    return rule;
  }
  add(rule, "tau", words::explain::taken_with_balls, together, Dimension::torque);
  add(rule, "tau", words::explain::taken_by_rotor, alone, Dimension::torque);
  if (!e.study.speed.driven()) {
    rule.words = words::explain::speed_is_prescribed;
    return rule;
  }
  const auto given = torque_at(e.study, critical);
  if (!given) {
    rule.kept = true;
    rule.words = words::explain::integral_without_limit;
    return rule;
  }
  const TorqueSetting& motor = e.study.speed.torque;
  const bool passing = motor.kind == model::MotorLaw::Kind::table || motor.until;
  add(rule, "tau",
      passing                        ? words::explain::largest_torque
      : e.study.speed.load.is_none() ? words::explain::given_at_critical_speed
                                     : words::explain::left_at_critical_speed,
      *given, Dimension::torque);
  const double quiet = rules::quiet_speed(p), through = e.speed ? std::min(quiet, 0.99 * std::abs(*e.speed)) : quiet;
  const auto arrives = [&](double unbalance) { return rotor_alone(e.study, unbalance, through).arrived; };
  // A torque of limited duration must bring the rotor through in time. Strong dampers take most above the critical
  // speed, where balls have left the heavy side.
  const bool with_all = passing ? arrives(p.all_unbalances()) : *given >= together && arrives(p.eccentricity);
  const bool by_itself = passing ? arrives(p.eccentricity) : *given >= alone;
  if (with_all) {
    rule.kept = true;
    rule.words = passing ? words::explain::enough_while_it_lasts : words::explain::enough_however_slowly;
  } else if (!by_itself) {
    rule.kept = false;
    rule.words = passing ? words::explain::torque_too_short : words::explain::torque_too_little;
  } else {
    rule.words = words::explain::torque_depends_on_balls;
  }
  return rule;
}

}  // namespace

std::vector<double> ball_widths(const Study& study) {
  const model::Parameters& p = study.parameters;
  const auto count = static_cast<std::size_t>(p.balls);
  std::vector<double> widths;
  if (!study.ball_details.diameter.empty() && study.scales)
    for (const double d : study.ball_details.diameter)
      widths.push_back(2.0 * std::asin(0.5 * d / study.scales->length));
  else if (p.balls_collide())
    widths.assign(count, p.contact_angle);
  else if (p.rolls)
    for (std::size_t i = 0; i < count; ++i) widths.push_back(2.0 * std::asin(p.ball_radius[i]));
  return widths;
}

std::vector<RuleOfThumb> advice(const Explanation& e) {
  std::vector<RuleOfThumb> rules{ball_mass(e), critical_speeds(e), room(e), drag(e)};
  if (e.carrying) rules.push_back(carried(e));
  rules.push_back(settling(e));
  rules.push_back(torque(e));
  return rules;
}

}  // namespace equipoise
