// Each rule of thumb applied to a study, next to what linear theory gives.
#include "equipoise/report/explain/parts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <string>

#include <fmt/format.h>

#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/report/explain/rules_of_thumb.hpp"
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
  double stiffness = rules::ball_stiffness(parameters, speed, angles.data());

  DragScan scan() const { return {parameters, speed, angles, family}; }
  bool above_resonance() const { return speed > highest(rules::critical_speeds(parameters)); }
};

std::optional<NearBalance> near_balance(const Explanation& e, std::string& why_not) {
  const model::Parameters& own = e.study.parameters;
  if (!e.speed)
    why_not = e.speed_words;
  else if (std::abs(*e.speed) <= lowest(e.critical_with_balls))
    why_not = "at or below the critical speed balls gather on the heavy side, whatever their drag";
  if (!why_not.empty()) return std::nullopt;
  const double speed = std::abs(*e.speed);
  const model::Parameters p = model::centred_twin(model::weakened(own, 0.0), speed).parameters;
  const model::BalancedStates states = model::balanced_states(p);
  const auto angles = balanced_angles(states, p);
  if (!angles) {
    why_not = states.reason.empty() ? "no balanced state was found" : states.reason;
    return std::nullopt;
  }
  std::string less;
  if (own.gravity != 0.0) less += "; without gravity";
  if (!own.isotropic()) less += "; with the mean of x and y";
  if (!own.race_is_centred()) less += "; with a centred race";
  return NearBalance{p, speed, *angles, states.kind == model::BalancedStates::Kind::continuum, less};
}

RuleOfThumb ball_mass(const Explanation& e) {
  const model::Parameters& p = e.study.parameters;
  RuleOfThumb rule{"ball_mass", "ball mass", "lambda <= mu sin(n delta/2)/sin(delta/2), of points n mu",
                   "Rules of thumb, Ball mass; Equations, Existence"};
  const double lambda = e.unbalance;
  rule.kept = e.balanced.kind != model::BalancedStates::Kind::none;
  rule.words = *rule.kept ? "the balls can cancel the unbalance" : e.balanced.reason;
  add(rule, "", "most that they cancel side by side", e.largest_unbalance, Dimension::unbalance);
  add(rule, "", "least that they cancel", e.least_unbalance, Dimension::unbalance);
  add(rule, "", "unbalance", lambda, Dimension::unbalance);
  if (p.balls == 2 && p.equal_balls() && lambda > 0.0)
    add(rule, "", "mass of each ball that settles fastest, lambda/sqrt(2)", lambda / std::sqrt(2.0), Dimension::mass);
  return rule;
}

RuleOfThumb critical_speeds(const Explanation& e) {
  const model::Parameters& p = e.study.parameters;
  RuleOfThumb rule{"critical_speed", "critical speed", "Omega >= sqrt(2) sqrt(kappa/(1 + N))",
                   "Rules of thumb, Critical speeds; Equations, Clamped balls"};
  const std::array<double, 2>& critical = e.critical_with_balls;
  const bool one = p.isotropic();
  for (int d = 0; d < (one ? 1 : 2); ++d) {
    const std::string direction = one ? "" : d == 0 ? ", x" : ", y";
    add(rule, "", "critical speed with the balls" + direction, critical[static_cast<std::size_t>(d)], Dimension::speed);
    if (const auto peak = rules::speed_of_largest_vibration(p, d))
      add(rule, "", "largest vibration" + direction + ", of held balls", *peak, Dimension::speed);
  }
  if (p.gravity > 0.0)
    add(rule, "", "their weight makes balls vibrate twice per turn, resonance at", 0.5 * lowest(critical),
        Dimension::speed);
  const double least = rules::quiet_speed(p);
  add(rule, "", "run above", least, Dimension::speed);
  if (!e.speed) {
    rule.words = e.speed_words;
    return rule;
  }
  rule.kept = std::abs(*e.speed) >= least;
  rule.words = *rule.kept ? "far enough above resonance" : "near or below resonance";
  if (!one && std::abs(*e.speed) > lowest(critical) && std::abs(*e.speed) < highest(critical))
    rule.words = "between the critical speeds of x and y, where balls have no side to gather on";
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
  RuleOfThumb rule{"room", "room in the race", "sum of 2 asin(d_i/(2 R)) <= 2 pi",
                   "Rules of thumb, Room in the race; Equations, Contact"};
  if (width.empty()) {
    rule.words = "the study does not give the balls' size";
    return rule;
  }
  const double all = std::accumulate(width.begin(), width.end(), 0.0),
               widest = *std::max_element(width.begin(), width.end());
  rule.kept = all <= two_pi;
  rule.words = *rule.kept ? "the balls fit into the race" : "the balls do not fit into the race";
  add(rule, "", "angle between touching balls, 2 asin(d/(2 R))", widest, Dimension::angle);
  add(rule, "", "balls of this size that fit", std::floor(two_pi / widest * (1.0 + 1e-12)), std::nullopt);
  add(rule, "", "part of the race that they fill", all / two_pi, std::nullopt);
  // Three balls or more have many balanced states, some of them with room whenever rule ball_mass holds.
  const auto spacing = spacing_in_balance(e);
  if (!spacing) return rule;
  add(rule, "", "angle between them in balance", *spacing, Dimension::angle);
  if (*spacing < 0.5 * (width[0] + width[1])) {
    rule.kept = false;
    rule.words = "in balance the balls would overlap";
  }
  return rule;
}

void add_drag(RuleOfThumb& rule, const Explanation& e, const std::string& name, double beta) {
  add(rule, "beta", name, beta, std::nullopt);
  if (e.study.scales && e.study.parameters.equal_balls())
    add(rule, "D", name, beta * e.study.parameters.mass[0], Dimension::gain);
}

RuleOfThumb drag(const Explanation& e) {
  RuleOfThumb rule{"drag", "ball drag",
                   "beta_s/2 <= beta <= 2 beta_s, beta_s = 2 sqrt(s k_b); beta >= N omega^3/(zeta (Omega - omega))",
                   "Rules of thumb, Ball drag; Equations, Linearisation"};
  const auto near = near_balance(e, rule.words);
  if (!near) return rule;
  const double own = rules::mean_drag(near->parameters);
  if (near->stiffness <= 0.0) {
    rule.words = near->above_resonance() ? "nothing brings the balls of this balanced state back: all lie on one line"
                                         : "between the critical speeds nothing brings the balls back";
    return rule;
  }
  const double best = rules::settling_drag(near->parameters, near->stiffness);
  double from = rules::least_of_settling_drag * best, to = rules::most_of_settling_drag * best;
  const double by_rule[]{from, to};
  bool unstable = false;
  if (own > 0.0) {
    // Drags a thousand times less and more than either: no one has a wider choice.
    const double low = std::min(best, own) / (1e3 * own), high = std::max(best, own) * 1e3 / own;
    const DragScan scan = near->scan();
    if (const auto range = scan.range(rules::settling_share, low, high)) {
      from = range->low * own;
      to = range->high * own;
      add_drag(rule, e, "from (linear theory)", from);
      add_drag(rule, e, "fastest (linear theory)", range->best * own);
      add_drag(rule, e, "to (linear theory)", to);
    } else {
      unstable = true;
    }
  }
  add_drag(rule, e, "from", by_rule[0]);
  add_drag(rule, e, "to", by_rule[1]);
  rule.kept = own >= from && own <= to && !unstable;
  rule.words = unstable     ? "by linear theory no drag makes balance stable"
               : own < from ? "too little: balance settles at less than a quarter of its fastest rate, or is unstable"
               : own > to   ? "too much: the balls creep into balance at less than a quarter of the fastest rate"
                            : "balance settles at a quarter of its fastest rate or more";
  rule.words += near->less;
  // Linear theory leaves less out.
  if (rule.kept == true && e.motion && !e.motion->stable) {
    rule.kept = false;
    rule.words += ", with which it is unstable";
  }
  const double against = rules::drag_against_capture(e.study.parameters, near->speed);
  add_drag(rule, e, "below it balls may lag at the critical speed", against);
  if (own < against) rule.words += "; on the way up they may lag behind at the critical speed";
  return rule;
}

RuleOfThumb carried(const Explanation& e) {
  RuleOfThumb rule{"carried", "balls carried round",
                   "beta Omega >= G; of n that touch: n beta Omega >= G sin(n delta/2)/sin(delta/2)",
                   "Rules of thumb, Carried round"};
  const model::Carrying& c = *e.carrying;
  rule.kept = !c.may_hang();
  rule.words = c.reached >= c.all ? "drag carries balls round against their weight, from rest also"
               : c.turning
                   ? "drag is too little to carry balls round from rest, but they are released so fast that none falls"
                   : "balls that hang below the shaft stay there: drag is too little against their weight";
  add(rule, "", "carries all from", c.all, Dimension::speed);
  add_drag(rule, e, "least at the final speed, of balls that do not touch", e.study.parameters.gravity / c.reached);
  return rule;
}

RuleOfThumb settling(const Explanation& e) {
  RuleOfThumb rule{"settling", "settling near balance",
                   "slower decay of s q'' + beta q' + k_b q = 0 and (1 + N) r'' + zeta r' + kappa r = 0",
                   "Rules of thumb, Settling; Equations, Linearisation"};
  const auto near = near_balance(e, rule.words);
  if (!near) return rule;
  const double time = rules::settling_time(near->parameters, std::max(near->stiffness, 0.0));
  // Linear theory may leave less out than the rule.
  const bool knows_more = e.motion && e.motion->less.empty() && !near->less.empty();
  rule.words = "a deviation falls to 1/e" + (knows_more ? "; the rule " + near->less.substr(2) : near->less);
  if (!std::isfinite(time))
    rule.words =
        near->stiffness > 0.0 ? "without drag or without damping nothing settles" : "nothing brings the balls back";
  if (e.study.parameters.balls_stick()) rule.words += "; friction stops the balls short of it";
  add(rule, "", "by the rule", time, Dimension::time);
  const double rate = e.motion ? e.motion->slowest_rate : near->scan().slowest(1.0);
  if (rate < -least_rate)
    add(rule, "", "by linear theory", -1.0 / rate, Dimension::time);
  else
    rule.words += rate > least_rate ? "; linear theory: not at all, balance is unstable"
                                    : "; linear theory: the largest rate is within 1e-9 of 0";
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
  const double given = t.gain * (study.motor().aim.final_speed() - speed);
  return t.limit ? std::min(given, *t.limit) : given;
}

RuleOfThumb torque(const Explanation& e) {
  const model::Parameters& p = e.study.parameters;
  RuleOfThumb rule{"torque", "motor torque",
                   "tau(omega) >= (lambda + N)^2 omega^3/zeta, half of it where x and y differ",
                   "Rules of thumb, Torque; [Som], [Kon]"};
  const double critical = highest(e.critical_with_balls), first = lowest(e.critical_with_balls);
  const auto need = [&](double unbalance) {
    return std::max(rules::shaking_torque(p, unbalance, first), rules::shaking_torque(p, unbalance, critical));
  };
  const double alone = need(p.eccentricity), together = need(p.all_unbalances());
  if (e.speed && std::abs(*e.speed) <= first) {
    rule.words = "the final speed is below the critical speed";
    return rule;
  }
  if (e.study.speed.driven() && std::abs(e.study.speed.initial) > critical) {
    rule.words = "the rotor is above the critical speed from the beginning";
    return rule;
  }
  if (!std::isfinite(together)) {
    rule.words = "without damping no torque holds against resonance: only a fast run-up passes";
    return rule;
  }
  add(rule, "tau", "taken at resonance with all balls on the heavy side", together, Dimension::torque);
  add(rule, "tau", "taken at resonance by the rotor's own unbalance", alone, Dimension::torque);
  if (!e.study.speed.driven()) {
    rule.words =
        "the study prescribes the speed; a motor would need this much, in addition to what speeds the rotor up";
    return rule;
  }
  const auto given = torque_at(e.study, critical);
  if (!given) {
    rule.kept = true;
    rule.words = "the motor's integral part has no limit";
    return rule;
  }
  const TorqueSetting& motor = e.study.speed.torque;
  const bool passing = motor.kind == model::MotorLaw::Kind::table || motor.until;
  add(rule, "tau",
      passing                        ? "largest torque of the motor"
      : e.study.speed.load.is_none() ? "given by the motor at the critical speed"
                                     : "left by motor and load at the critical speed",
      *given, Dimension::torque);
  const double quiet = rules::quiet_speed(p), through = e.speed ? std::min(quiet, 0.99 * std::abs(*e.speed)) : quiet;
  const auto arrives = [&](double unbalance) { return rotor_alone(e.study, unbalance, through).arrived; };
  // A torque of limited duration must bring the rotor through in time. Strong dampers take most above the critical
  // speed, where balls have left the heavy side.
  const bool with_all = passing ? arrives(p.all_unbalances()) : *given >= together && arrives(p.eccentricity);
  const bool by_itself = passing ? arrives(p.eccentricity) : *given >= alone;
  if (with_all) {
    rule.kept = true;
    rule.words = passing ? "enough while it lasts, wherever the balls are"
                         : "enough however slowly it passes, wherever the balls are";
  } else if (!by_itself) {
    rule.kept = false;
    rule.words =
        passing ? "too little or too short: the rotor's own unbalance stops it"
                : "less than the rotor's own unbalance takes: without balls it stalls unless it comes with momentum";
  } else {
    rule.words = "whether it is enough depends on where the balls are";
  }
  return rule;
}

}  // namespace

std::vector<double> ball_widths(const Study& study) {
  const model::Parameters& p = study.parameters;
  const auto count = static_cast<std::size_t>(p.balls);
  std::vector<double> widths;
  if (const std::span<const double> diameters = study.ball_diameters(); !diameters.empty() && study.scales)
    for (const double d : diameters) widths.push_back(2.0 * std::asin(0.5 * d / study.scales->length));
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
