// A study explained, as text and as JSON.
#include "equipoise/report/explain/explain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/report/text/quantities.hpp"
#include "equipoise/report/text/grade_text.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/results/commands/left_grade.hpp"

namespace equipoise {

namespace {

constexpr char basin_takes[] = "basin takes";

using model::Scales;
using study::Dimension;

std::string figure_text(const ExplainedQuantity& figure, const std::optional<Scales>& scales) {
  std::string plain = fmt::format("{}{:.5g}", figure.symbol == "beta" ? "beta = " : "", figure.value);
  if (!figure.dimension) return plain;
  if (*figure.dimension == Dimension::angle) return fmt::format("{:.4g} degree", figure.value * 180.0 / pi);
  if (!scales) return plain;
  return fmt::format("{} ({})", engineering(scales, figure.value, *figure.dimension), plain);
}

class Text {
 public:
  Text(const Explanation& e, const TextStyle& style) : e_(e), style_(style), scales_(e.study.scales) {}

  std::string all() {
    const std::string held = release_text(e_.study);
    text_ = e_.study.name + "\n" + (held.empty() ? "" : held + "\n") + "\n";
    const FactNumbers numbers{[this](double value, Dimension d) { return either(value, d); },
                              [this](double value, Dimension d) { return both(value, d); },
                              [this](double low, double high, Dimension d) { return range(low, high, d); }};
    for (const Fact& fact : facts(e_, numbers)) {
      for (const std::string& line : fact.lines) item(&line == &fact.lines.front() ? fact.name : "", line);
      if (e_.motion && fact.name == "approach to balance") eigenvalues(*e_.motion);
    }
    if (e_.cost) cost(*e_.cost);
    text_ += "\n";
    for (const std::string& w : e_.warnings) text_ += "warning: " + w + "\n";
    if (e_.warnings.empty()) text_ += "no warnings\n";
    rules();
    table();
    return text_;
  }

 private:
  static constexpr int label_width = 22;

  std::string either(double value, Dimension d) const { return engineering(scales_, value, d); }
  // In both forms if there are scales, else dimensionless.
  std::string both(double value, Dimension d) const {
    return scales_ ? fmt::format("{} ({:.5g})", either(value, d), value) : either(value, d);
  }
  // A low end of 0 is in the high end's unit.
  std::string range(double low, double high, Dimension d) const {
    const std::string from =
        scales_ && low == 0.0 ? fmt::format("0 {} (0)", engineering_unit(high * study::scale_of(d, *scales_), d).name)
                              : both(low, d);
    return fmt::format("from {} to {}", from, both(high, d));
  }
  void item(const std::string& label, const std::string& words) {
    text_ += fmt::format("{:<{}}{}\n", label, label_width, words);
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
                                                                       : either(q.value, *q.dimension));
      quantities.rows.push_back(row_of(scales_ ? "ttnn" : "ttn", row));
    }
    if (scales_) quantities.spare = {3};
    text_ += "\n" + table_text(quantities, style_);
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

  void rules() {
    if (e_.advice.empty()) return;
    text_ +=
        "\nRules of thumb: estimates by formulas; the documentation, \"Rules of thumb\", shows how often each is "
        "right\n";
    for (const RuleOfThumb& rule : e_.advice) {
      const char* verdict = !rule.kept ? "" : *rule.kept ? "OK: " : "FAILS: ";
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

// Writes each value with its SI value and unit, if there are scales; what is not there is null.
struct InBothForms {
  const std::optional<model::Scales>& scales;

  template <class Part>
  Json operator()(const std::optional<Part>& part) const {
    return part ? (*this)(*part) : Json();
  }
  Json operator()(double value, Dimension d) const {
    Json json = object("dimensionless", value);
    if (scales) put(json, "si", value * study::scale_of(d, *scales), "unit", study::words(d).si);
    return json;
  }
  Json operator()(const std::optional<double>& value, Dimension d) const { return value ? (*this)(*value, d) : Json(); }
  template <class List>
  requires requires(const List& l) { l.size(); }
  Json operator()(const List& values, Dimension d) const {
    return list_of(values, [&](double value) { return (*this)(value, d); });
  }
  Json operator()(const ExplainedQuantity& q) const {
    Json row = object("symbol", q.symbol, "name", q.name);
    row.update(q.dimension ? (*this)(q.value, *q.dimension) : object("dimensionless", q.value));
    return row;
  }
  Json operator()(const model::WhirlSpeeds& w) const {
    if (!w.of_both.empty()) return object("of_both", (*this)(w.of_both, Dimension::speed));
    return object("forward", (*this)(w.forward, Dimension::speed), "backward", (*this)(w.backward, Dimension::speed));
  }
  Json operator()(const RunUp& r) const {
    const InBothForms& both = *this;
    return object("speed", both(r.speed, Dimension::speed), "inertia", both(r.inertia, Dimension::inertia),
                  "without_losses", both(r.alone, Dimension::time), "with_own_unbalance",
                  both(r.shaken, Dimension::time), "stalls_at",
                  r.shaken ? Json() : both(r.stalls_at, Dimension::speed));
  }
  Json operator()(const model::Carrying& c) const {
    return object("first_from", (*this)(c.first, Dimension::speed), "all_from", (*this)(c.all, Dimension::speed),
                  "may_hang", c.may_hang());
  }
  Json operator()(const BareVibration& v) const {
    return object("displacement", (*this)(v.displacement, Dimension::length), "force",
                  (*this)(v.force, Dimension::force));
  }
  Json operator()(const ExplainedPlane& p) const {
    const InBothForms& both = *this;
    return object("at", both(p.at, Dimension::length), "unbalance", both(p.unbalance, Dimension::unbalance),
                  "least_unbalance", both(p.least, Dimension::unbalance), "largest_unbalance",
                  both(p.most, Dimension::unbalance), "reason", p.why_not);
  }
  Json operator()(const TiltExplanation& t) const {
    const InBothForms& both = *this;
    return object("whirl", both(t.alone), "whirl_with_balls", both(t.with_balls), "couple_unbalance",
                  both(t.couple, Dimension::inertia), "planes", list_of(t.planes, both), "displacement_at_bearings",
                  both(t.at_bearings, Dimension::length), "force_at_bearings", both(t.forces, Dimension::force));
  }
  Json operator()(const RuleOfThumb& r) const {
    return object("id", r.id, "name", r.name, "kept", r.kept, "words", r.words, "figures", list_of(r.figures, *this),
                  "formula", r.formula, "source", r.source);
  }
};

Json motion_of(const BalancedMotion& m, const InBothForms& both, int balls) {
  const auto time = [&](bool there, double value) { return there ? both(value, Dimension::time) : Json(); };
  Json json = object("stable", m.stable, "angles", leading(m.angles, balls), "time_constant",
                     time(m.stable, -1.0 / m.slowest_rate), "drag_sensitivity", m.drag_sensitivity, "left_out", m.less,
                     "strobe", time(m.section_period > 0.0, m.section_period), "displacement_left",
                     both(m.left, Dimension::length));
  put_known(json, "slowest_rate_if_sliding", m.slowest_if_sliding);
  put(json, "eigenvalues", list_of(m.eigenvalues, complex_pair));
  return json;
}

}  // namespace

std::string explain_text(const Explanation& e, const TextStyle& style) {
  constexpr std::size_t labels = 22;
  return lines_filled(Text(e, style).all(), style, labels);
}

void to_json(Json& json, const BasinCost& cost) {
  json = object("cpu_seconds", cost.total(), "search", cost.search, "search_ended", cost.search_ended, "a_start",
                cost.a_start, "starts", cost.starts, "measured", cost.measured);
}

std::string json_text(const Explanation& e) {
  const InBothForms both{e.study.scales};
  const auto unbalance = [&](double value) { return both(value, Dimension::unbalance); };
  Json json = object("quantities", list_of(e.quantities, both), "critical_speed",
                     both(e.critical_alone, Dimension::speed), "critical_speed_with_balls",
                     both(e.critical_with_balls, Dimension::speed), "final_speed", both(e.speed, Dimension::speed),
                     "final_speed_reason", e.speed_words, "run_up", both(e.run_up), "cost", e.cost);
  put(json, "can_balance", e.balanced.kind != model::BalancedStates::Kind::none, "reason", e.balanced.reason,
      "static_sag", both(e.sag, Dimension::length), "weight", both(e.weight(), Dimension::force), "gravity_ratio",
      e.gravity_ratio, "carried_round", both(e.carrying), "own_unbalance", unbalance(e.study.parameters.eccentricity),
      "unbalance", unbalance(e.unbalance), "least_unbalance", unbalance(e.least_unbalance), "largest_unbalance",
      unbalance(e.largest_unbalance), "balanced",
      e.motion ? motion_of(*e.motion, both, e.study.parameters.balls) : Json(), "not_linearised", e.no_motion,
      "without_balls", both(e.bare));
  const auto grade = e.speed ? own_balance_grade(e.study, *e.speed) : std::nullopt;
  put(json, "balance_grade", grade ? Json(BalanceGrade{*grade}) : Json());
  if (e.tilt) put(json, "tilt", both(*e.tilt));
  put(json, "reynolds_number", e.reynolds, "advice", list_of(e.advice, both), "warnings", e.warnings, "study", e.study,
      "study_name", e.study.name, "version", version_string);
  return json.dump(2) + "\n";
}

}  // namespace equipoise
