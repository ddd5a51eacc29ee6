// Warnings compare numbers that explain() has.
#include "equipoise/report/explain/parts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/classification/start_runs/undecided.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/report/text/quantities.hpp"
#include "equipoise/simulation/spin_up/spin_up.hpp"

namespace equipoise {

namespace {

using study::Dimension;

constexpr double root_two = 1.4142135623730951;
constexpr double rounding = 1e-9;

class Warnings {
 public:
  Warnings(Explanation& e, const StopFlag* stop) : e_(e), p_(e.study.parameters) {
    speed();
    e.tilt ? planes(*e.tilt) : unbalance({e.unbalance, e.least_unbalance, e.largest_unbalance}, p_.balls == 1);
    sag();
    if (e.motion) motion(*e.motion);
    if (e.speeds_up) warn("{}; in balance the rotor speeds up without end", e.speed_words);
    torque();
    if (e.run_up) run_up(*e.run_up);
    if (p_.balls == 0) return;
    patience();
    if (!e.tilt) release(stop);  // which no motor has
    room();
    if (e.gravity_ratio && *e.gravity_ratio >= 1.0)
      warn("at the final speed the weight of a ball exceeds its centrifugal force: it falls off the top of the race");
    if (std::string hanging = hanging_text(e.study); !hanging.empty()) e.warnings.push_back(std::move(hanging));
    contact();
    if (!p_.balls_collide() && p_.restitution != model::Parameters{}.restitution)
      warn("balancer.restitution has no effect: balls of no contact_angle pass each other");
    if (p_.total_mass() >= 1.0) warn("the balls together are heavier than the rotor");
    if (e.reynolds && *e.reynolds > 1.0)
      warn(
          "the Reynolds number of a ball that slips is {:.3g}: Stokes' drag holds below about 1, so only near balance, "
          "where balls creep, and is too small before",
          *e.reynolds);
  }

 private:
  template <class... T>
  void warn(fmt::format_string<T...> format, T&&... values) {
    e_.warnings.push_back(fmt::format(format, std::forward<T>(values)...));
  }

  void speed() {
    if (!e_.speed) return;
    const double w = std::abs(*e_.speed);
    const double lowest = std::min(e_.critical_with_balls[0], e_.critical_with_balls[1]);
    const double highest = std::max(e_.critical_alone[0], e_.critical_alone[1]);
    const bool balls = p_.balls > 0;
    const char* unstable = balls ? ", and balance is often unstable" : "";
    if (balls && w < lowest)
      warn(
          "the final speed is below the critical speed: there balls gather on the heavy side and add to the unbalance");
    if (near_critical(w, lowest, highest))
      warn("the final speed is within 10 % of a critical speed: vibration is near its largest");
    else if (!e_.tilt && w >= lowest && w < root_two * highest)
      warn(
          "the final speed is less than sqrt(2) times the critical speed: vibration without balls exceeds twice the "
          "eccentricity unless damping is strong{}",
          unstable);
    else if (w >= lowest && w < highest)
      warn(
          "the final speed lies between critical speeds, below the highest, {}: whirl of that kind is not yet passed{}",
          text(highest, Dimension::speed),
          balls ? ", there balls gather on the heavy side, and balance is often unstable" : "");
    else if (w >= lowest && w < root_two * highest)
      warn(
          "the final speed is less than sqrt(2) times the highest critical speed, {}: without balls, whirl of that "
          "kind is more than twice as wide as at high speeds, if the unbalance excites it and damping is not strong{}",
          text(highest, Dimension::speed), unstable);
  }

  // A tilting rotor has quiet ranges between its critical speeds.
  bool near_critical(double w, double lowest, double highest) const {
    if (!e_.tilt) return w >= 0.9 * lowest && w <= 1.1 * highest;
    bool near = false;
    for (const model::WhirlSpeeds* speeds : {&e_.tilt->alone, &e_.tilt->with_balls})
      for (const double critical : speeds->excited()) near = near || std::abs(w - critical) <= 0.1 * critical;
    return near;
  }

  void contact() {
    const std::vector<double>& widths = e_.ball_width;
    if (p_.balls_collide() || p_.balls < 2 || widths.empty()) return;
    const bool alike = std::all_of(widths.begin(), widths.end(), [&](double w) { return w == widths.front(); });
    warn(
        "balls pass through each other in this study, which real balls do not: probabilities and vibration may "
        "differ{}",
        alike ? "" : "; contact needs balls of one balancer.ball_diameter");
  }

  void sag() {
    double most = e_.sag;
    std::string where;
    if (e_.tilt && p_.gravity != 0.0)
      for (const double at : e_.study.bearings)
        if (const double there = std::abs(model::static_sag(p_) + at * model::static_slope(p_)); there > most) {
          most = there;
          where = fmt::format(" at the bearing at {}", text(at, Dimension::length));
        }
    const std::string sag = text(most, Dimension::length) + where;
    // Springs would have to be longer than the rotor is wide: stiffness, mass or their units are wrong.
    if (most > 1.0)
      warn("the rotor sags by {} under its weight, more than the race's radius, {}: no suspension is as soft as that",
           sag, text(1.0, Dimension::length));
  }

  std::string text(double value, Dimension d) const { return engineering(e_.study.scales, value, d); }

  struct Share {
    double own = 0.0, least = 0.0, most = 0.0;  // unbalance, and what balls cancel
  };

  // Of the balls of one race; `where` stands before each warning.
  void unbalance(const Share& s, bool one_ball, const std::string& where = "") {
    constexpr double near = 0.1;
    if (s.most == 0.0) return;  // the balls do not fit into the race: room() says so
    const auto say = [&](const std::string& words) { e_.warnings.push_back(where + words); };
    if (one_ball) {
      // Equal by values from a file, which a tilt's sums round.
      if (std::abs(s.own - s.most) > (e_.tilt ? rounding * s.most : 0.0))
        say(fmt::format("one ball cancels {} and no other unbalance; this one is {}",
                        text(s.most, Dimension::unbalance), text(s.own, Dimension::unbalance)));
      return;
    }
    const char* these = e_.ball_width.empty() ? "all balls together" : "all balls side by side";
    if (s.own > s.most)
      say(fmt::format("the unbalance is {:.3g} times what {} can cancel", s.own / s.most, these));
    else if (s.own < s.least)
      say("the unbalance is below the least that these balls can balance: they would add one of their own");
    else if (s.own > (1.0 - near) * s.most)
      say(fmt::format("the unbalance is within 10 % of the most that {} can cancel", these));
    else if (s.own < (1.0 + near) * s.least)
      say("the unbalance is within 10 % of the least that these balls can balance");
  }

  // Of a tilting rotor each plane has its share; balls in planes without one cannot cancel static and couple.
  void planes(const TiltExplanation& t) {
    if (p_.balls == 0) return;
    if (t.planes.empty() && e_.balanced.kind == model::BalancedStates::Kind::none)
      warn("balance is impossible: {}", e_.balanced.reason);
    for (const ExplainedPlane& plane : t.planes)
      unbalance({plane.unbalance, plane.least, plane.most}, plane.least == plane.most,
                fmt::format("plane at {}: ", text(plane.at, Dimension::length)));
  }

  void motion(const BalancedMotion& m) {
    const std::string less = m.place(e_.balanced);
    if (!m.stable) {
      if (m.slowest_rate <= least_rate)
        warn("balance is not linearly stable at the final speed{}: its largest rate is within 1e-9 of 0", less);
      else
        warn("balance is unstable at the final speed{}: the balls do not stay there; {} drag makes it less so", less,
             m.drag_sensitivity < 0.0 ? "more" : "less");
      return;
    }
    const double constant = -1.0 / m.slowest_rate;
    constexpr double patience = 1000.0;
    if (constant > patience)
      warn("balance settles slowly, in more than 1000 units of time{}{}", less, remedy(m));
    else if (e_.spin_up && constant > *e_.spin_up)
      warn("balance settles more slowly than the rotor spins up{}{}", less, remedy(m));
    if (const RuleOfThumb* drag = rule("drag"); drag && drag->kept == false && m.more_drag() < 0)
      warn("the balls are overdamped{}{}", less, remedy(m));
  }

  static const char* remedy(const BalancedMotion& m) {
    return m.more_drag() > 0   ? "; more drag would bring balance sooner"
           : m.more_drag() < 0 ? "; less drag would bring balance sooner"
                               : "; the balls' drag hardly changes that";
  }

  const RuleOfThumb* rule(const char* id) const {
    const auto found = std::find_if(e_.advice.begin(), e_.advice.end(), [&](const auto& r) { return r.id == id; });
    return found == e_.advice.end() ? nullptr : &*found;
  }

  void torque() {
    const RuleOfThumb* torque = rule("torque");
    constexpr std::size_t with_the_motors = 3;  // figures: what is taken, by two unbalances, and what is given
    if (!e_.study.speed.driven() || !torque || torque->figures.size() < with_the_motors) return;
    if (torque->kept == false)
      warn("the motor may be too weak for the critical speed: {}", torque->words);
    else if (!torque->kept)
      warn("the motor's torque may not suffice at the critical speed: {}", torque->words);
  }

  void run_up(const RunUp& r) {
    const double horizon = choose_horizon(e_.study).time;
    if (r.alone && *r.alone - r.last_piece > horizon)
      warn(
          "without any losses the motor takes {} to bring the rotor to {}, longer than starts are followed, {}: they "
          "may stay undecided",
          text(*r.alone, Dimension::time), text(r.speed, Dimension::speed), text(horizon, Dimension::time));
  }

  void patience() {
    const StartCost cost = start_cost(e_.study);
    const char* key = cost.by_drag ? "balancer.drag" : "rotor.damping";
    if (!cost.bearable())
      warn("stiff: with {} = {:.4g} a start takes about {:.1g} steps; basin and attractors refuse above {:.3g}", key,
           cost.cause, cost.steps, cost.allowed);
    const Horizon horizon = choose_horizon(e_.study);
    if (!horizon.long_enough())
      warn("{}: of starts that are followed for {:.6g} many may stay undecided", slowness_text(horizon), horizon.time);
  }

  // Whether a motor reaches the release speed depends on where the balls are held: some starts are tried.
  void release(const StopFlag* stop) {
    const Study& study = e_.study;
    if (!study.speed.driven() || !study.release.speed) return;
    if (is_too_stiff(p_, *study.release.speed))
      return warn("the supports are too stiff to try here whether the motor reaches the speed of release");
    constexpr std::size_t tried = 8;
    SpunUp starts;
    if (!make_spin_up(with_horizon(study), stop)->make(study.sampling.seed, 0, tried, starts)) return;
    std::vector<UndecidedEnd> clamped;
    for (std::size_t i = 0; i < starts.size(); ++i)
      if (starts.is_over(i) && !starts.nearest.empty() && std::isfinite(starts.nearest[i]))
        clamped.push_back({.what = Restlessness::clamped, .reached = starts.nearest[i], .asked = *study.release.speed});
    if (!clamped.empty())
      warn("of {} starts tried {} never let their balls go: {}", tried, clamped.size(), clamped_text(clamped));
  }

  void room() {
    const std::vector<double>& widths = e_.ball_width;
    const double angle = std::accumulate(widths.begin(), widths.end(), 0.0);
    if (angle > 2.0 * pi)
      warn("{} balls of this size do not fit into the race: there is room for {:.0f} % of them", p_.balls,
           100.0 * 2.0 * pi / angle);
  }

  Explanation& e_;
  const model::Parameters& p_;
};

}  // namespace

void add_warnings(Explanation& e, const StopFlag* stop) { Warnings{e, stop}; }

}  // namespace equipoise
