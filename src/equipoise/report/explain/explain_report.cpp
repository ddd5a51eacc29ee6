// A study explained, as text.
#include "equipoise/report/explain/explain_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/report/answers/start_text.hpp"
#include "equipoise/report/text/carrying_text.hpp"
#include "equipoise/report/text/engineering.hpp"
#include "equipoise/report/text/grade_text.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/report/text/words.hpp"
#include "equipoise/results/commands/left_grade.hpp"

namespace equipoise {

namespace {

constexpr char final_speed_text[] = "final speed";
constexpr char times_the_critical[] = "{}, {:.3g} times the {}critical speed{}";
constexpr char and_with_balls[] = " with balls";
constexpr char balanced_angles_text[] = "balanced angles";
constexpr char one_of_continuum[] = " (one of a continuum)";
constexpr char basin_takes[] = "basin takes";

using model::Scales;
using study::Dimension;

double in_degrees(double angle) {
  const double turn = std::fmod(angle * 180.0 / pi, 360.0);
  return turn < 0.0 ? turn + 360.0 : turn;
}

// With spaces at which no line breaks; explain_text() makes them plain.
constexpr std::string_view whole_space = "\u00a0";
constexpr char beta_is[] = "beta\u00a0=\u00a0";

std::string figure_text(const ExplainedQuantity& figure, const std::optional<Scales>& scales) {
  std::string plain = fmt::format("{}{:.5g}", figure.symbol == "beta" ? beta_is : "", figure.value);
  if (!figure.dimension) return plain;
  if (*figure.dimension == Dimension::angle) return fmt::format("{:.4g} degree", figure.value * 180.0 / pi);
  if (!scales) return plain;
  return fmt::format("{} ({})",
                     engineering(figure.value * study::scale_of(*figure.dimension, *scales), *figure.dimension), plain);
}

class Text {
 public:
  Text(const Explanation& e, const TextStyle& style) : e_(e), style_(style), scales_(e.study.scales) {}

  std::string all() {
    const std::string held = release_text(e_.study);
    text_ = e_.study.name + "\n" + (held.empty() ? "" : held + "\n") + "\n";
    table();
    speeds();
    balance();
    if (e_.motion) motion(*e_.motion);
    if (e_.bare) bare(*e_.bare);
    if (e_.reynolds)
      item("Reynolds number",
           fmt::format("{:.3g} of a ball that keeps the critical speed while the rotor runs at its final one",
                       *e_.reynolds));
    rules();
    if (e_.cost) cost(*e_.cost);
    text_ += "\n";
    for (const std::string& w : e_.warnings) text_ += "warning: " + w + "\n";
    if (e_.warnings.empty()) text_ += "no warnings\n";
    return text_;
  }

 private:
  static constexpr int label_width = 22;

  std::string physical(double value, Dimension d) const { return engineering(value * study::scale_of(d, *scales_), d); }
  // In both forms if there are scales, else dimensionless.
  std::string both(double value, Dimension d) const {
    return scales_ ? fmt::format("{} ({:.5g})", physical(value, d), value) : fmt::format("{:.5g}", value);
  }
  // One end of a range: nothing, too, is in the other end's unit.
  std::string end_of(double value, double other, Dimension d) const {
    if (!scales_ || value != 0.0) return both(value, d);
    return fmt::format("0 {} (0)", engineering_unit(other * study::scale_of(d, *scales_), d).name);
  }
  std::string either(double value, Dimension d) const {
    return scales_ ? physical(value, d) : fmt::format("{:.5g}", value);
  }
  void item(const std::string& label, const std::string& words) {
    text_ += fmt::format("{:<{}}{}\n", label, label_width, words);
  }
  std::string by_direction(const std::array<double, 2>& values, Dimension d) const {
    if (values[0] == values[1]) return both(values[0], d);
    return fmt::format("x {}, y {}", both(values[0], d), both(values[1], d));
  }

  void table() {
    DocumentTable quantities{{"symbol", "quantity", "physical", "dimensionless"}};
    if (!scales_) quantities.header.erase(quantities.header.begin() + 2);
    for (const auto& q : e_.quantities) {
      if (!scales_ && (q.symbol == "M" || q.symbol == "R" || q.symbol == "omega_c" || q.symbol == "1/omega_c"))
        continue;  // the units themselves
      const std::string number = fmt::format("{:.6g}", q.value);
      std::vector<std::string> row{q.symbol, q.name, number};
      if (scales_)
        row.insert(row.begin() + 2, !q.dimension                       ? number
                                    : *q.dimension == Dimension::angle ? number + " rad"
                                                                       : physical(q.value, *q.dimension));
      quantities.rows.push_back(row_of(scales_ ? "ttnn" : "ttn", row));
    }
    if (scales_) quantities.spare = {3};
    text_ += table_text(quantities, style_) + "\n";
  }

  std::string list(const std::vector<double>& values, Dimension d) const {
    std::string text;
    for (std::size_t k = 0; k < values.size(); ++k)
      text += (k == 0 ? "" : k + 1 < values.size() ? ", " : " and ") + either(values[k], d);
    return text;
  }

  void whirl(const TiltExplanation& t) {
    const bool balls = e_.study.parameters.balls > 0;
    const char* label = "critical speed";
    const auto line = [&](const char* words, const std::vector<double>& alone, const std::vector<double>& with) {
      const std::string held = fmt::format(", {} with them held", list(with, Dimension::speed));
      item(label, fmt::format(fmt::runtime(words), list(alone, Dimension::speed), balls ? held : ""));
      label = "";
    };
    if (!t.alone.of_both.empty()) return line("{} without balls{}", t.alone.of_both, t.with_balls.of_both);
    line(words::reports::forward_whirl, t.alone.forward, t.with_balls.forward);
    line("backward whirl: {} without balls{}; unbalance does not excite it", t.alone.backward, t.with_balls.backward);
    if (t.alone.forward.size() == 1) item("", words::reports::one_forward_whirl);
  }

  void final_speed_of_tilt() {
    if (!e_.speed) return item(final_speed_text, "none: " + e_.speed_words);
    item(final_speed_text, fmt::format(times_the_critical, either(*e_.speed, Dimension::speed),
                                       std::abs(*e_.speed) / e_.critical_with_balls[1],
                                       e_.critical_with_balls[0] == e_.critical_with_balls[1] ? "" : "highest ",
                                       e_.study.parameters.balls > 0 ? and_with_balls : ""));
    if (!e_.speed_words.empty()) item("", e_.speed_words);
  }

  void speeds() {
    if (e_.tilt) {
      whirl(*e_.tilt);
      return final_speed_of_tilt();
    }
    const bool balls = e_.study.parameters.balls > 0;
    item("critical speed", by_direction(e_.critical_alone, Dimension::speed) +
                               (balls ? " without balls, " + by_direction(e_.critical_with_balls, Dimension::speed) +
                                            " with the balls in the race"
                                      : ""));
    if (!e_.speed) return item(final_speed_text, "none: " + e_.speed_words);
    const double highest = std::max(e_.critical_with_balls[0], e_.critical_with_balls[1]);
    item(final_speed_text,
         fmt::format(times_the_critical, either(*e_.speed, Dimension::speed), std::abs(*e_.speed) / highest,
                     e_.critical_alone[0] == e_.critical_alone[1] ? "" : "higher ", balls ? and_with_balls : ""));
    if (!e_.speed_words.empty()) item("", e_.speed_words);
    if (e_.run_up) run_up(*e_.run_up);
  }

  void cost(const BasinCost& c) {
    constexpr double microseconds = 1e6;
    if (!c.search_ended || c.measured == 0)
      return item(basin_takes, fmt::format("more than {:.2g} s of CPU: {} had not ended by then", c.total(),
                                           c.search_ended ? "the first starts" : "the search for attractors"));
    item(basin_takes, fmt::format("about {:.2g} s of CPU: {:.2g} s for the search for attractors, "
                                  "{:.2g} us for each of {} starts, measured on {}",
                                  c.total(), c.search, microseconds * c.a_start, c.starts, c.measured));
  }

  void run_up(const RunUp& r) {
    const std::string to = either(r.speed, Dimension::speed);
    item("run-up",
         r.alone ? fmt::format("{} to {}, 95 % of that, without losses; the moment of inertia of rotor and balls is {}",
                               either(*r.alone, Dimension::time), to, either(r.inertia, Dimension::inertia))
                 : fmt::format("the motor does not bring the rotor to {}, 95 % of that", to));
    if (!r.alone) return;
    item("", r.shaken ? fmt::format(
                            "{} with the torque that the rotor's own unbalance absorbs up to sqrt(2) critical speeds{}",
                            either(*r.shaken, Dimension::time),
                            e_.study.parameters.balls > 0 ? "; what the balls add to that is left out" : "")
                      : fmt::format("never with the torque that the rotor's own unbalance absorbs up to sqrt(2) "
                                    "critical speeds: it stalls at {}",
                                    either(r.stalls_at, Dimension::speed)));
  }

  void balance() {
    item("can balance", verdict_text(e_));
    if (e_.tilt)
      planes(*e_.tilt);
    else if (e_.study.parameters.balls == 0)
      item("", fmt::format("unbalance {}", both(e_.unbalance, Dimension::unbalance)));
    else
      item("",
           fmt::format("unbalance {}; these balls cancel from {} to {}{}", both(e_.unbalance, Dimension::unbalance),
                       end_of(e_.least_unbalance, e_.largest_unbalance, Dimension::unbalance),
                       both(e_.largest_unbalance, Dimension::unbalance), e_.ball_width.empty() ? "" : " side by side"));
    if (e_.unbalance != e_.study.parameters.eccentricity)
      item("", fmt::format("the rotor's own is {}; the off-centre race changes it to that at the final speed",
                           both(e_.study.parameters.eccentricity, Dimension::unbalance)));
    if (e_.sag > 0.0)
      item("static sag",
           fmt::format("{} under the weight of {}; displacements are measured from there, bearing forces include it",
                       both(e_.sag, Dimension::length), both(e_.weight(), Dimension::force)));
    if (e_.gravity_ratio)
      item("gravity", fmt::format("{:.3g} of a ball's centrifugal force at the final speed", *e_.gravity_ratio));
    if (e_.carrying) item("", carried_text(e_.study, *e_.carrying));
    if (!e_.motion && e_.study.parameters.balls > 0) item("approach to balance", "unknown: " + e_.no_motion);
  }

  void planes(const TiltExplanation& t) {
    item("", fmt::format(words::reports::static_and_couple, both(e_.unbalance, Dimension::unbalance),
                         both(t.couple, Dimension::inertia)));
    for (const ExplainedPlane& plane : t.planes)
      item("",
           fmt::format(words::reports::plane_cancels, both(plane.at, Dimension::length),
                       both(plane.unbalance, Dimension::unbalance),
                       end_of(plane.least, plane.most, Dimension::unbalance), both(plane.most, Dimension::unbalance)));
  }

  std::string states_of_tilt(bool family) const {
    if (family) return one_of_continuum;
    const std::size_t states = e_.balanced.angles.size();
    return states > 1 ? fmt::format(" (one of {} states)", states) : "";
  }

  void motion(const BalancedMotion& m) {
    std::string angles;
    for (int i = 0; i < e_.study.parameters.balls; ++i)
      angles += fmt::format("{}{:.1f}", i ? ", " : "", in_degrees(m.angles[static_cast<std::size_t>(i)]));
    const bool family = e_.balanced.kind == model::BalancedStates::Kind::continuum;
    if (e_.tilt)
      item(balanced_angles_text,
           fmt::format(fmt::runtime(e_.study.parameters.tilt.couple() > 0.0 ? "{} degree from the couple unbalance{}"
                                                                            : "{} degree from the rotor's angle 0{}"),
                       angles, states_of_tilt(family)));
    else
      item(balanced_angles_text, fmt::format("{} degree from the heavy side{}", angles,
                                             family                          ? one_of_continuum
                                             : e_.balanced.angles.size() > 1 ? " (and their mirror image)"
                                                                             : ""));
    const std::string where =
        (e_.study.speed.driven() ? " at constant speed" : "") + (m.less.empty() ? "" : ", " + m.less);
    const char* more_drag = m.more_drag() > 0 ? "shorter" : m.more_drag() < 0 ? "longer" : "hardly changed";
    item("approach to balance", m.stable ? fmt::format("stable{}; slowest time constant {}, {} with more drag", where,
                                                       either(-1.0 / m.slowest_rate, Dimension::time), more_drag)
                                : m.grows()
                                    ? fmt::format("NOT stable{}: largest growth rate {:.3g}", where, m.slowest_rate)
                                    : fmt::format("NOT stable{}: the largest rate is within 1e-9 of 0", where));
    if (m.left)
      item("", fmt::format("the balls rock as the rotor turns: the centre of the race keeps moving, by up to {}",
                           both(*m.left, Dimension::length)));
    if (m.slowest_if_sliding) item("", "if the balls slid instead of rolled: " + slowest(*m.slowest_if_sliding));
    eigenvalues(m);
  }

  void eigenvalues(const BalancedMotion& m) {
    // Rounding turns a real double eigenvalue into a pair, which is no oscillation.
    double largest = 0.0;
    for (const auto& v : m.eigenvalues) largest = std::max(largest, std::abs(v));
    const auto paired = [&](const std::complex<double>& v) {
      return std::abs(v.imag()) > 1e-7 * largest;  // the square root of a rounding
    };
    const auto swings = [&](const std::complex<double>& v) { return m.section_period == 0.0 && paired(v); };
    std::vector<std::array<std::string, 3>> rows{{m.section_period > 0.0 ? "rate, by multipliers" : "eigenvalue",
                                                  "time constant",
                                                  scales_ && m.section_period == 0.0 ? "oscillation" : ""}};
    for (const auto& v : m.eigenvalues) {
      if (paired(v) && v.imag() < 0.0) continue;  // the conjugate stands for both
      rows.push_back(
          {swings(v) ? fmt::format("{:.5g} +- {:.5g} i", v.real(), v.imag()) : fmt::format("{:.5g}", v.real()),
           v.real() < -least_rate  ? either(-1.0 / v.real(), Dimension::time)
           : v.real() > least_rate ? "grows"
                                   : "stays",
           scales_ && swings(v) ? fmt::format("{:.4g} Hz", v.imag() * scales_->frequency / (2.0 * pi)) : ""});
    }
    std::size_t first = 25, second = 18;  // wider for longer entries, with two spaces after each
    for (const auto& row : rows) {
      first = std::max(first, row[0].size() + 2);
      second = std::max(second, row[1].size() + 2);
    }
    for (const auto& row : rows) {
      std::string line = fmt::format("{:<{}}{:<{}}{}", row[0], first, row[1], second, row[2]);
      line.erase(line.find_last_not_of(' ') + 1);
      item("", line);
    }
  }

  std::string slowest(double rate) const {
    return rate < 0.0 ? either(-1.0 / rate, Dimension::time) : fmt::format("growth rate {:.3g}", rate);
  }

  void bare_of_tilt(const BareVibration& v, const TiltExplanation& t) {
    item(words::text::without_balls, by_direction(v.displacement, Dimension::length) +
                                         " amplitude of the shaft at the centre of mass, at the final speed");
    if (!t.at_bearings.empty())
      item("", fmt::format("{} at the bearings, at the farthest", list(t.at_bearings, Dimension::length)));
    if (!t.forces.empty()) item("", fmt::format(words::reports::forces_at_bearings, list(t.forces, Dimension::force)));
    item("", by_direction(v.force, Dimension::force) + " amplitude of the force on all supports together" +
                 (t.forces.empty() ? ", in which a couple does not show" : ""));
    quality(
        "; in the worse of the outermost bearings' planes, each by its share, as ISO 21940-11 grades it: a figure, not "
        "a certification");
  }

  // `how`: what it is of. Of a rotor that tilts without two bearings, why there is none.
  void quality(const char* how) {
    if (!scales_) return;
    const auto grade = own_balance_grade(e_.study, *e_.speed);
    item("balance quality", grade ? grade_text(*grade) + how
                                  : "none: ISO 21940-11 judges a rotor that tilts in the planes of two "
                                    "bearings; state rotor.tilt.bearings or rotor.tilt.bearings_at");
  }

  void bare(const BareVibration& v) {
    if (e_.tilt) return bare_of_tilt(v, *e_.tilt);
    const double w = std::abs(*e_.speed);
    item(words::text::without_balls, by_direction(v.displacement, Dimension::length) + " amplitude at the final speed");
    const std::array<double, 2> rms{v.displacement[0] * w / std::sqrt(2.0), v.displacement[1] * w / std::sqrt(2.0)};
    item("", by_direction(rms, Dimension::velocity) + " rms velocity in one direction");
    item("", by_direction(v.force, Dimension::force) + " amplitude of the force on the supports");
    quality("; eps omega in mm/s as ISO 21940-11 grades it: a figure, not a certification");
  }

  void rules() {
    if (e_.advice.empty()) return;
    text_ +=
        "\nRules of thumb: estimates by formulas; docs/explanation/rules-of-thumb.md derives them and says how often "
        "each is right\n";
    for (const RuleOfThumb& rule : e_.advice) {
      const char* verdict = !rule.kept ? "" : *rule.kept ? "kept: " : "NOT kept: ";
      item(rule.name, verdict + rule.words);
      std::vector<std::array<std::string, 2>> figures;
      std::size_t name = 0, number = 0;
      for (std::size_t k = 0; k < rule.figures.size(); ++k) {
        const ExplainedQuantity& f = rule.figures[k];
        std::string text = figure_text(f, scales_);
        const bool second_form = k + 1 < rule.figures.size() && rule.figures[k + 1].name == f.name;
        if (second_form) text += ", " + figure_text(rule.figures[++k], scales_);
        name = std::max(name, f.name.size());
        number = std::max(number, text.size());
        figures.push_back({f.name, text});
      }
      const bool beside = style_.width == 0 || label_width + name + 2 + number <= style_.width;
      for (const auto& [label, text] : figures)
        item("", beside ? fmt::format("{:<{}}  {}", label, name, text) : fmt::format("{}: {}", label, text));
      item("", fmt::format("rule: {} [{}]", rule.formula, rule.source));
    }
  }

  const Explanation& e_;
  const TextStyle& style_;
  const std::optional<Scales>& scales_;
  std::string text_;
};

}  // namespace

std::string verdict_text(const Explanation& e) {
  if (e.balanced.kind == model::BalancedStates::Kind::none) return "no: " + e.balanced.reason;
  if (e.motion && !e.motion->stable)
    return "yes, but balance is not stable at the final speed" + e.motion->place(e.balanced);
  if (!e.motion) return "the balls have the mass and the room, but " + e.no_motion;
  return e.study.parameters.gravity > 0.0 ? "yes, apart from what gravity adds" : "yes";
}

std::string explain_text(const Explanation& e, const TextStyle& style) {
  constexpr std::size_t labels = 22;
  const std::string lines = lines_filled(Text(e, style).all(), style, labels);
  std::string text;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const bool whole = lines.compare(k, whole_space.size(), whole_space) == 0;
    if (whole) k += whole_space.size() - 1;
    if (lines[k] == '\n') text.resize(text.find_last_not_of(' ') + 1);
    text += whole ? ' ' : lines[k];
  }
  return text;
}

}  // namespace equipoise
