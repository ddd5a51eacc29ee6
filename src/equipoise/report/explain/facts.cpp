// What follows from a study's numbers without simulation, one fact after the other.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/report/explain/explain.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/report/text/grade_text.hpp"
#include "equipoise/results/commands/left_grade.hpp"

namespace equipoise {

namespace {

constexpr char one_of_continuum[] = " (one of a continuum)";
using study::Dimension;

double in_degrees(double angle) {
  const double turn = std::fmod(angle * 180.0 / pi, 360.0);
  return turn < 0.0 ? turn + 360.0 : turn;
}

class Facts {
 public:
  Facts(const Explanation& e, const FactNumbers& numbers)
      : e_(e), numbers_(numbers), balls_(e.study.parameters.balls > 0) {}

  std::vector<Fact> list() {
    e_.tilt ? whirl(*e_.tilt) : critical_speed();
    final_speed();
    balance();
    if (e_.motion) motion(*e_.motion);
    if (e_.bare) e_.tilt ? bare_of_tilt(*e_.bare, *e_.tilt) : bare(*e_.bare);
    if (e_.reynolds)
      add("Reynolds number",
          fmt::format("{:.3g} of a ball that keeps the critical speed while the rotor runs at its final one",
                      *e_.reynolds));
    return std::move(list_);
  }

 private:
  void add(const std::string& name, std::string text) { list_.push_back({name, {std::move(text)}}); }
  // Another line about the last fact.
  void go_on(std::string text) { list_.back().lines.push_back(std::move(text)); }

  std::string one(double value, Dimension d) const { return numbers_.one(value, d); }
  std::string full(double value, Dimension d) const { return numbers_.full(value, d); }
  std::string by_direction(const std::array<double, 2>& values, Dimension d) const {
    if (values[0] == values[1]) return full(values[0], d);
    return fmt::format("x {}, y {}", full(values[0], d), full(values[1], d));
  }
  std::string each(const std::vector<double>& values, Dimension d) const {
    std::string text;
    for (std::size_t k = 0; k < values.size(); ++k)
      text += (k == 0 ? "" : k + 1 < values.size() ? ", " : " and ") + one(values[k], d);
    return text;
  }

  void whirl(const TiltExplanation& t) {
    const auto speeds = [&](const std::vector<double>& alone, const std::vector<double>& with) {
      return each(alone, Dimension::speed) + " without balls" +
             (balls_ ? fmt::format(", {} with them held", each(with, Dimension::speed)) : "");
    };
    if (!t.alone.of_both.empty()) return add("critical speed", speeds(t.alone.of_both, t.with_balls.of_both));
    add("critical speed", "forward whirl: " + speeds(t.alone.forward, t.with_balls.forward));
    go_on("backward whirl: " + speeds(t.alone.backward, t.with_balls.backward) + "; unbalance does not excite it");
    if (t.alone.forward.size() == 1)
      go_on("the gyroscopic moment of this disc leaves no second critical speed of forward whirl");
  }

  void critical_speed() {
    add("critical speed", by_direction(e_.critical_alone, Dimension::speed) +
                              (balls_ ? " without balls, " + by_direction(e_.critical_with_balls, Dimension::speed) +
                                            " with the balls in the race"
                                      : ""));
  }

  void final_speed() {
    if (!e_.speed) return add("final speed", "none: " + e_.speed_words);
    const auto& [first, second] = e_.critical_with_balls;
    add("final speed", fmt::format("{}, {:.3g} times the {}critical speed{}", one(*e_.speed, Dimension::speed),
                                   std::abs(*e_.speed) / std::max(first, second),
                                   first == second ? ""
                                   : e_.tilt       ? "highest "
                                                   : "higher ",
                                   balls_ ? " with balls" : ""));
    if (!e_.speed_words.empty()) go_on(e_.speed_words);
    if (e_.run_up) run_up(*e_.run_up);
  }

  void run_up(const RunUp& r) {
    const std::string to = one(r.speed, Dimension::speed);
    if (!r.alone) return add("run-up", fmt::format("the motor does not bring the rotor to {}, 95 % of that", to));
    add("run-up", fmt::format("{} to {}, 95 % of that, without losses; the moment of inertia of rotor and balls is {}",
                              one(*r.alone, Dimension::time), to, one(r.inertia, Dimension::inertia)));
    go_on(r.shaken
              ? fmt::format("{} with the torque that the rotor's own unbalance absorbs up to sqrt(2) critical speeds{}",
                            one(*r.shaken, Dimension::time), balls_ ? "; what the balls add to that is left out" : "")
              : fmt::format("never with the torque that the rotor's own unbalance absorbs up to sqrt(2) "
                            "critical speeds: it stalls at {}",
                            one(r.stalls_at, Dimension::speed)));
  }

  void balance() {
    add("can balance", verdict_text(e_));
    if (e_.tilt)
      planes(*e_.tilt);
    else
      go_on("unbalance " + full(e_.unbalance, Dimension::unbalance) +
            (balls_ ? fmt::format("; these balls cancel {}{}",
                                  numbers_.range(e_.least_unbalance, e_.largest_unbalance, Dimension::unbalance),
                                  e_.ball_width.empty() ? "" : " side by side")
                    : ""));
    if (e_.unbalance != e_.study.parameters.eccentricity)
      go_on(fmt::format("the rotor's own is {}; the off-centre race changes it to that at the final speed",
                        full(e_.study.parameters.eccentricity, Dimension::unbalance)));
    if (e_.sag > 0.0)
      add("static sag",
          fmt::format("{} under the weight of {}; displacements are measured from there, bearing forces include it",
                      full(e_.sag, Dimension::length), full(e_.weight(), Dimension::force)));
    if (e_.gravity_ratio)
      add("gravity", fmt::format("{:.3g} of a ball's centrifugal force at the final speed", *e_.gravity_ratio));
    if (e_.carrying) go_on(carried_text(e_.study, *e_.carrying));
    if (!e_.motion && balls_) add("approach to balance", "unknown: " + e_.no_motion);
  }

  void planes(const TiltExplanation& t) {
    go_on(fmt::format("static unbalance {}, couple unbalance {}", full(e_.unbalance, Dimension::unbalance),
                      full(t.couple, Dimension::inertia)));
    for (const ExplainedPlane& plane : t.planes)
      go_on(fmt::format("plane at {}: unbalance {}; its balls cancel {}", full(plane.at, Dimension::length),
                        full(plane.unbalance, Dimension::unbalance),
                        numbers_.range(plane.least, plane.most, Dimension::unbalance)));
  }

  std::string other_states() const {
    if (e_.balanced.kind == model::BalancedStates::Kind::continuum) return one_of_continuum;
    const std::size_t states = e_.balanced.angles.size();
    return states < 2 ? "" : e_.tilt ? fmt::format(" (one of {} states)", states) : " (and their mirror image)";
  }

  void motion(const BalancedMotion& m) {
    std::string angles;
    for (int i = 0; i < e_.study.parameters.balls; ++i)
      angles += fmt::format("{}{:.1f}", i ? ", " : "", in_degrees(m.angles[static_cast<std::size_t>(i)]));
    const char* from = !e_.tilt                                  ? "the heavy side"
                       : e_.study.parameters.tilt.couple() > 0.0 ? "the couple unbalance"
                                                                 : "the rotor's angle 0";
    add("balanced angles", fmt::format("{} degree from {}{}", angles, from, other_states()));
    const std::string where =
        (e_.study.speed.driven() ? " at constant speed" : "") + (m.less.empty() ? "" : ", " + m.less);
    const char* more_drag = m.more_drag() > 0 ? "shorter" : m.more_drag() < 0 ? "longer" : "hardly changed";
    add("approach to balance", m.stable ? fmt::format("stable{}; slowest time constant {}, {} with more drag", where,
                                                      one(-1.0 / m.slowest_rate, Dimension::time), more_drag)
                               : m.grows()
                                   ? fmt::format("NOT stable{}: largest growth rate {:.3g}", where, m.slowest_rate)
                                   : fmt::format("NOT stable{}: the largest rate is within 1e-9 of 0", where));
    if (m.left)
      go_on(fmt::format("the balls rock as the rotor turns: the centre of the race keeps moving, by up to {}",
                        full(*m.left, Dimension::length)));
    if (const auto& rate = m.slowest_if_sliding)
      go_on("if the balls slid instead of rolled: " +
            (*rate < 0.0 ? one(-1.0 / *rate, Dimension::time) : fmt::format("growth rate {:.3g}", *rate)));
  }

  void bare_of_tilt(const BareVibration& v, const TiltExplanation& t) {
    add("without balls", by_direction(v.displacement, Dimension::length) +
                             " amplitude of the shaft at the centre of mass, at the final speed");
    if (!t.at_bearings.empty())
      go_on(fmt::format("{} at the bearings, at the largest", each(t.at_bearings, Dimension::length)));
    if (!t.forces.empty())
      go_on(fmt::format("{} of force at the bearings, at the largest", each(t.forces, Dimension::force)));
    go_on(by_direction(v.force, Dimension::force) + " amplitude of the force on all supports together" +
          (t.forces.empty() ? ", in which a couple does not show" : ""));
    quality(
        "; in the worse of the outermost bearings' planes, each by its share, as ISO 21940-11 grades it: a figure, not "
        "a certification");
  }

  void bare(const BareVibration& v) {
    const double w = std::abs(*e_.speed);
    add("without balls", by_direction(v.displacement, Dimension::length) + " amplitude at the final speed");
    const std::array<double, 2> rms{v.displacement[0] * w / std::sqrt(2.0), v.displacement[1] * w / std::sqrt(2.0)};
    go_on(by_direction(rms, Dimension::velocity) + " rms velocity in one direction");
    go_on(by_direction(v.force, Dimension::force) + " amplitude of the force on the supports");
    quality("; eps omega in mm/s as ISO 21940-11 grades it: a figure, not a certification");
  }

  // `how`: what it is of. For a tilting rotor without two bearings, why there is none.
  void quality(const char* how) {
    if (!e_.study.scales) return;
    const auto grade = own_balance_grade(e_.study, *e_.speed);
    add("balance quality", grade ? grade_text(*grade) + how
                                 : "none: ISO 21940-11 judges a tilting rotor in the planes of two "
                                   "bearings; state rotor.tilt.bearings or rotor.tilt.bearings_at");
  }

  const Explanation& e_;
  const FactNumbers& numbers_;
  const bool balls_;
  std::vector<Fact> list_;
};

}  // namespace

std::string verdict_text(const Explanation& e) {
  if (e.balanced.kind == model::BalancedStates::Kind::none) return "no: " + e.balanced.reason;
  if (e.motion && !e.motion->stable)
    return "yes, but balance is not stable at the final speed" + e.motion->place(e.balanced);
  if (!e.motion) return "the balls have the mass and the room, but " + e.no_motion;
  return e.study.parameters.gravity > 0.0 ? "yes, apart from what gravity adds" : "yes";
}

std::vector<Fact> facts(const Explanation& e, const FactNumbers& numbers) { return Facts(e, numbers).list(); }

}  // namespace equipoise
