// Warnings compare numbers that explain() has.
#include "equipoise/report/explain/parts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/classification/start_runs/undecided.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/report/explain/drag_scan.hpp"
#include "equipoise/report/text/carrying_text.hpp"
#include "equipoise/report/text/engineering.hpp"
#include "equipoise/report/words/warnings.hpp"
#include "equipoise/simulation/spin_up/spin_up.hpp"

namespace equipoise {

namespace {
using study::Dimension;

constexpr double root_two = 1.4142135623730951;
constexpr double rounding = 1e-9;

class Warnings {
 public:
  explicit Warnings(Explanation& e) : e_(e), p_(e.study.parameters) {
    e.tilt ? whirl(*e.tilt) : speed();
    e.tilt ? planes(*e.tilt) : unbalance({e.unbalance, e.least_unbalance, e.largest_unbalance}, p_.balls == 1);
    sag();
    if (e.motion) motion(*e.motion);
    if (e.speeds_up) warn(words::warnings::speeds_up_without_end, e.speed_words);
    torque();
    if (e.run_up) run_up(*e.run_up);
    if (p_.balls == 0) return;
    patience();
    if (!e.tilt) release();  // which no motor has
    room();
    if (e.gravity_ratio && *e.gravity_ratio >= 1.0) warn(words::warnings::weight_beats_rotation);
    if (std::string hanging = hanging_text(e.study); !hanging.empty()) e.warnings.push_back(std::move(hanging));
    contact();
    if (!p_.balls_collide() && p_.restitution != model::Parameters{}.restitution)
      warn(words::warnings::restitution_without_contact);
    if (p_.total_mass() >= 1.0) warn(words::warnings::balls_heavier_than_rotor);
    if (e.reynolds && *e.reynolds > 1.0) warn(words::warnings::high_reynolds_number, *e.reynolds);
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
    if (w < lowest && p_.balls > 0) warn(words::warnings::below_critical_speed);
    if (w >= 0.9 * lowest && w <= 1.1 * highest)
      warn(words::warnings::near_critical_speed);
    else if (w >= lowest && w < root_two * highest)
      warn(words::warnings::little_isolation, p_.balls > 0 ? words::warnings::often_unstable_too : "");
  }

  // Of a rotor that tilts, which has no one speed above which it is quiet.
  void whirl(const TiltExplanation& t) {
    if (!e_.speed) return;
    const double w = std::abs(*e_.speed), lowest = e_.critical_with_balls[0], highest = e_.critical_alone[1];
    const bool balls = p_.balls > 0;
    bool near = false;
    for (const model::WhirlSpeeds* speeds : {&t.alone, &t.with_balls})
      for (const double critical : speeds->excited()) near = near || std::abs(w - critical) <= 0.1 * critical;
    if (balls && w < lowest) warn(words::warnings::below_critical_speed);
    if (near)
      warn(words::warnings::near_critical_speed);
    else if (w >= lowest && w < highest)
      warn(words::warnings::between_critical_speeds, text(highest, Dimension::speed),
           balls ? words::warnings::adds_to_whirl : "");
    else if (w >= lowest && w < root_two * highest)
      warn(words::warnings::little_isolation_of_tilt, text(highest, Dimension::speed),
           balls ? words::warnings::often_unstable_too : "");
  }

  void contact() {
    const std::vector<double>& widths = e_.ball_width;
    if (p_.balls_collide() || p_.balls < 2 || widths.empty()) return;
    const bool alike = std::all_of(widths.begin(), widths.end(), [&](double w) { return w == widths.front(); });
    warn(words::warnings::balls_pass_through, alike ? "" : words::warnings::equal_diameters_needed_too);
  }

  void sag() {
    double most = e_.sag;
    std::string where;
    if (e_.tilt && p_.gravity != 0.0)
      for (const double at : e_.study.bearings)
        if (const double there = std::abs(model::static_sag(p_) + at * model::static_slope(p_)); there > most) {
          most = there;
          where = fmt::format(words::warnings::at_bearing, text(at, Dimension::length));
        }
    const std::string sag = text(most, Dimension::length) + where;
    // Springs would have to be longer than the rotor is wide: stiffness, mass or their units are wrong.
    if (most > 1.0) warn(words::warnings::sags_beyond_race, sag, text(1.0, Dimension::length));
  }

  std::string text(double value, Dimension d) const {
    return e_.study.scales ? engineering(value * study::scale_of(d, *e_.study.scales), d)
                           : fmt::format("{:.5g}", value);
  }

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
        say(fmt::format(words::warnings::one_ball_cancels_one, text(s.most, Dimension::unbalance),
                        text(s.own, Dimension::unbalance)));
      return;
    }
    const char* these = e_.ball_width.empty() ? words::warnings::balls_together : words::warnings::balls_side_by_side;
    if (s.own > s.most)
      say(fmt::format(words::warnings::unbalance_too_large, s.own / s.most, these));
    else if (s.own < s.least)
      say(words::warnings::unbalance_too_small);
    else if (s.own > (1.0 - near) * s.most)
      say(fmt::format(words::warnings::unbalance_near_most, these));
    else if (s.own < (1.0 + near) * s.least)
      say(words::warnings::unbalance_near_least);
  }

  // Of a rotor that tilts each plane has its share; balls in planes without one cannot cancel static and couple.
  void planes(const TiltExplanation& t) {
    if (p_.balls == 0) return;
    if (t.planes.empty() && e_.balanced.kind == model::BalancedStates::Kind::none)
      warn(words::warnings::balance_impossible, e_.balanced.reason);
    for (const ExplainedPlane& plane : t.planes)
      unbalance({plane.unbalance, plane.least, plane.most}, plane.least == plane.most,
                fmt::format(words::warnings::of_plane, text(plane.at, Dimension::length)));
  }

  void motion(const BalancedMotion& m) {
    const std::string less = m.place(e_.balanced);
    if (!m.stable) {
      if (m.slowest_rate <= least_rate)
        warn(words::warnings::not_linearly_stable, less);
      else
        warn(words::warnings::unstable, less, m.drag_sensitivity < 0.0 ? "more" : "less");
      return;
    }
    const double constant = -1.0 / m.slowest_rate;
    constexpr double patience = 1000.0;
    if (constant > patience)
      warn(words::warnings::settles_slowly, less, remedy(m));
    else if (e_.spin_up && constant > *e_.spin_up)
      warn(words::warnings::slower_than_run_up, less, remedy(m));
    if (const RuleOfThumb* drag = rule("drag"); drag && drag->kept == false && m.more_drag() < 0)
      warn(words::warnings::overdamped, less, remedy(m));
  }

  static const char* remedy(const BalancedMotion& m) {
    return m.more_drag() > 0   ? words::warnings::more_drag_too
           : m.more_drag() < 0 ? words::warnings::less_drag_too
                               : words::warnings::drag_hardly_matters_too;
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
      warn(words::warnings::motor_may_be_too_weak, torque->words);
    else if (!torque->kept)
      warn(words::warnings::torque_may_not_suffice, torque->words);
  }

  void run_up(const RunUp& r) {
    const double horizon = choose_horizon(e_.study).time;
    if (r.alone && *r.alone - r.last_piece > horizon)
      warn(words::warnings::long_run_up, text(*r.alone, Dimension::time), text(r.speed, Dimension::speed),
           text(horizon, Dimension::time));
  }

  void patience() {
    const StartCost cost = start_cost(e_.study);
    const char* key = cost.by_drag ? "balancer.drag" : "rotor.damping";
    if (!cost.bearable()) warn(words::warnings::stiff, key, cost.cause, cost.steps, cost.allowed);
    const Horizon horizon = choose_horizon(e_.study);
    if (!horizon.long_enough()) warn(words::warnings::may_stay_undecided, slowness_text(horizon), horizon.time);
  }

  // Whether a motor reaches the release speed depends on where the balls are held: some starts are tried.
  void release() {
    const Study& study = e_.study;
    if (!study.speed.driven() || !study.release.speed) return;
    constexpr std::size_t tried = 8;
    SpunUp starts;
    if (!make_spin_up(with_horizon(study), nullptr)->make(study.sampling.seed, 0, tried, starts)) return;
    std::vector<UndecidedEnd> clamped;
    for (std::size_t i = 0; i < starts.size(); ++i)
      if (starts.is_over(i) && !starts.nearest.empty() && std::isfinite(starts.nearest[i]))
        clamped.push_back({.what = Restlessness::clamped, .reached = starts.nearest[i], .asked = *study.release.speed});
    if (!clamped.empty()) warn(words::warnings::balls_never_let_go, tried, clamped.size(), clamped_text(clamped));
  }

  void room() {
    const std::vector<double>& widths = e_.ball_width;
    const double angle = std::accumulate(widths.begin(), widths.end(), 0.0);
    if (angle > 2.0 * pi) warn(words::warnings::too_many_balls, p_.balls, 100.0 * 2.0 * pi / angle);
  }

  Explanation& e_;
  const model::Parameters& p_;
};

}  // namespace

void add_warnings(Explanation& e) { Warnings{e}; }

}  // namespace equipoise
