// Tables about the machine, and words about the run.
#include "equipoise/report/html/page_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/plural.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/report/answers/quantities.hpp"
#include "equipoise/report/explain/explain_report.hpp"
#include "equipoise/results/commands/left_grade.hpp"
#include "equipoise/study/sampling/sampling.hpp"
#include "equipoise/study/echo/physical_echo.hpp"
#include "equipoise/report/text/grade_text.hpp"
#include "equipoise/report/answers/start_text.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/report/text/words.hpp"

namespace equipoise {

namespace {
using study::Dimension;

// "angle-grinder" from "studies/angle-grinder.toml"; the same for files of results.
std::string stem_of(const std::string& name) {
  const std::size_t folder = name.find_last_of('/');
  std::string stem = folder == std::string::npos ? name : name.substr(folder + 1);
  for (const std::string_view ending : {".toml", ".nc"})
    if (stem.ends_with(ending)) stem.erase(stem.size() - ending.size());
  return stem.empty() ? "study" : stem;
}

// A rule of thumb's figures in one line.
std::string figures_words(const RuleOfThumb& rule, const Study& study) {
  const PageQuantities shown(study);
  std::string text;
  for (std::size_t k = 0; k < rule.figures.size(); ++k) {
    const ExplainedQuantity& f = rule.figures[k];
    if (k + 1 < rule.figures.size() && rule.figures[k + 1].name == f.name)
      continue;  // drag: the machine's own figure
                 // follows
    const std::string value = !f.dimension                       ? page_number(f.value)
                              : *f.dimension == Dimension::angle ? page_number(f.value * 180.0 / pi) + "°"
                                                                 : shown.text(f.value, *f.dimension);
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", f.name, value);
  }
  return text;
}

DocumentTable advice_table(const Explanation& e) {
  DocumentTable table{{"rule of thumb", "an estimate by a formula", "figures"},
                      {},
                      "docs/explanation/rules-of-thumb.md derives these formulas and says how often each is right.",
                      false,
                      {2}};
  for (const RuleOfThumb& rule : e.advice)
    table.rows.push_back({{rule.name, Tone::plain, false, true},
                          {rule.words, !rule.kept   ? Tone::plain
                                       : *rule.kept ? Tone::good
                                                    : Tone::open},
                          {figures_words(rule, e.study)}});
  return table;
}

// What follows from a study without simulation.
class Derived {
 public:
  explicit Derived(const Explanation& explanation) : e_(explanation), study_(e_.study), shown_(e_.study) {}

  std::vector<std::array<std::string, 2>> rows() const {
    std::vector<std::array<std::string, 2>> rows{
        {"critical speed", speeds()}, {"unbalance", unbalance()}, {"can balance", verdict_text(e_)}};
    if (e_.bare)
      rows.push_back(
          {words::text::without_balls,
           fmt::format(
               fmt::runtime(e_.tilt
                                ? "shakes by {} at the centre of mass at the final speed, {} on all supports together"
                                : "shakes by {} at the final speed, {} on the supports"),
               by_direction(e_.bare->displacement, Dimension::length), by_direction(e_.bare->force, Dimension::force)) +
               (e_.tilt && !e_.tilt->at_bearings.empty()
                    ? "; " + fmt::format("{} at the bearings, at the farthest",
                                         list(e_.tilt->at_bearings, Dimension::length))
                    : "") +
               (e_.tilt && !e_.tilt->forces.empty()
                    ? "; " + fmt::format(words::reports::forces_at_bearings, list(e_.tilt->forces, Dimension::force))
                    : "")});
    if (e_.motion)
      rows.push_back({"approach to balance",
                      (e_.motion->stable ? fmt::format("stable, slowest time constant {}",
                                                       shown_.text(-1.0 / e_.motion->slowest_rate, Dimension::time))
                                         : "not stable by linear theory") +
                          (e_.motion->less.empty() ? "" : ", " + e_.motion->less)});
    return rows;
  }

 private:
  std::string by_direction(const std::array<double, 2>& v, Dimension d) const {
    return v[0] == v[1] ? shown_.text(v[0], d) : fmt::format("x {}, y {}", shown_.text(v[0], d), shown_.text(v[1], d));
  }

  std::string list(const std::vector<double>& values, Dimension d) const {
    std::string text;
    for (std::size_t k = 0; k < values.size(); ++k)
      text += (k == 0 ? "" : k + 1 < values.size() ? ", " : " and ") + shown_.text(values[k], d);
    return text;
  }

  std::string speeds_of_tilt(const TiltExplanation& t) const {
    const auto line = [&](const char* words, const std::vector<double>& alone, const std::vector<double>& with) {
      const std::string held = study_.parameters.balls > 0
                                   ? fmt::format(", {} with them held", list(with, Dimension::speed))
                                   : std::string();
      return fmt::format(fmt::runtime(words), list(alone, Dimension::speed), held);
    };
    std::string text = t.alone.of_both.empty()
                           ? line(words::reports::forward_whirl, t.alone.forward, t.with_balls.forward)
                           : line("{} without balls{}", t.alone.of_both, t.with_balls.of_both);
    if (t.alone.of_both.empty() && t.alone.forward.size() == 1)
      text += std::string("; ") + words::reports::one_forward_whirl;
    if (e_.speed)
      text += fmt::format("; final speed {}, {:.3g} times the highest", shown_.text(*e_.speed, Dimension::speed),
                          std::fabs(*e_.speed) / e_.critical_with_balls[1]);
    return text;
  }

  std::string unbalance_of_tilt(const TiltExplanation& t) const {
    std::string text = fmt::format(words::reports::static_and_couple, shown_.text(e_.unbalance, Dimension::unbalance),
                                   shown_.text(t.couple, Dimension::inertia));
    for (const ExplainedPlane& plane : t.planes)
      text += "; " + fmt::format(words::reports::plane_cancels, shown_.text(plane.at, Dimension::length),
                                 shown_.text(plane.unbalance, Dimension::unbalance),
                                 shown_.text(plane.least, Dimension::unbalance),
                                 shown_.text(plane.most, Dimension::unbalance));
    return text + grade_without_balls();
  }

  std::string speeds() const {
    if (e_.tilt) return speeds_of_tilt(*e_.tilt);
    std::string text = by_direction(e_.critical_alone, Dimension::speed);
    if (study_.parameters.balls > 0)
      text += " without balls, " + by_direction(e_.critical_with_balls, Dimension::speed) + " with them";
    if (e_.speed)
      text += fmt::format("; final speed {}, {:.3g} times {}", shown_.text(*e_.speed, Dimension::speed),
                          std::fabs(*e_.speed) / std::max(e_.critical_with_balls[0], e_.critical_with_balls[1]),
                          e_.critical_with_balls[0] == e_.critical_with_balls[1] ? "that" : "the higher");
    return text;
  }

  std::string unbalance() const {
    if (e_.tilt) return unbalance_of_tilt(*e_.tilt);
    std::string text = shown_.text(study_.parameters.eccentricity, Dimension::unbalance);
    if (e_.unbalance != study_.parameters.eccentricity)
      text += fmt::format(words::study_check::with_the_race, shown_.text(e_.unbalance, Dimension::unbalance));
    if (study_.parameters.balls > 0)
      text += fmt::format("; the balls can cancel {}{}",
                          shown_.range(e_.least_unbalance, e_.largest_unbalance, Dimension::unbalance),
                          e_.ball_width.empty() ? "" : " side by side");
    return text + grade_without_balls();
  }

  std::string grade_without_balls() const {
    const auto grade = e_.speed ? own_balance_grade(study_, *e_.speed) : std::nullopt;
    return grade ? fmt::format("; {} without balls", grade_text(*grade)) : "";
  }

  const Explanation& e_;
  const Study& study_;
  const PageQuantities shown_;
};

}  // namespace

Document page_with(const Study& study, const std::string& answer, const std::optional<Notice>& verdict) {
  Document document;
  document.title = "Ball balancer: " + stem_of(study.name);
  document.sheet = true;
  if (verdict) document.blocks.push_back(*verdict);
  document.blocks.push_back(Paragraph{answer, Tone::plain, true});
  if (std::string held = release_text(study); !held.empty()) {
    held.front() = 'B';
    document.blocks.push_back(Paragraph{held + "."});
  }
  return document;
}

void add_missing_cells(Document& document, std::size_t done, std::size_t cells) {
  if (done < cells)
    document.blocks.push_back(
        Paragraph{fmt::format("{} of {} cells are done; the rest is missing.", done, cells), Tone::bad});
}

std::string starts_words(const Study& study, const std::vector<std::string>& drawn) {
  const auto method = static_cast<std::size_t>(study.sampling.method.value_or(SamplingMethod::random));
  const std::vector<std::string> instead = drawn_instead(study);
  return fmt::format("at {} ball angles{}{}, seed {}{}", sampling_method_names[method],
                     study.sampling.box.empty() ? "" : " and in the box of initial states",
                     drawn.empty() ? "" : fmt::format(", with {} drawn anew for each", fmt::join(drawn, ", ")),
                     study.sampling.seed,
                     instead.empty() ? "" : fmt::format(" (not from {} of the study)", fmt::join(instead, ", ")));
}

std::string model_words(const Study& study, const RunWords& run) {
  std::string text;
  if (!study.speed.driven() && study.speed.profile != Profile::constant)
    text = fmt::format(" Speed law: {}.", name_of(study.speed.law));
  text += fmt::format(
      " Intervals hold with 95 % confidence. The model: {}, docs/explanation/equations.md. equipoise {}, {}",
      study.parameters.tilts() ? "a rigid rotor that tilts" : "a rotor in a plane", version_string, run.cpu_target);
  constexpr double shown = 0.05;
  if (run.seconds >= shown)
    text += fmt::format(", {} thread{}, {:.1f} s ({:.1f} s CPU)", run.threads, plural(run.threads), run.seconds,
                        run.cpu_seconds);
  return text;
}

void add_machine(Document& document, const GivenMachine& machine, const std::string& given, bool fold) {
  const auto add = [&](Block block) { document.blocks.push_back(std::move(block)); };
  if (!machine.assumed.empty()) {
    add(Heading{2, "What was assumed", ""});
    add(ItemList{machine.assumed});
    if (!machine.matters_most.empty()) add(Paragraph{"What matters most: " + machine.matters_most + "."});
  }
  add(Heading{2, "The machine", ""});
  DocumentTable table{{"given", given}};
  for (const GivenTable& of : machine.given) {
    std::string text;
    for (const auto& [key, value] : of.keys) text += fmt::format("{}{} {}", text.empty() ? "" : "; ", key, value);
    table.rows.push_back({{of.name, Tone::plain, false, true}, {text}});
  }
  add(std::move(table));
  DocumentTable facts{{"follows", "without any simulation"}};
  for (const auto& [name, text] : Derived(machine.explanation).rows())
    facts.rows.push_back({{name, Tone::plain, false, true}, {text}});
  add(std::move(facts));
  DocumentTable rules = advice_table(machine.explanation);
  rules.folded = fold;
  if (fold) rules.caption = "Rules of thumb: " + rules.caption;
  if (!rules.rows.empty()) add(std::move(rules));
  for (const std::string& warning : machine.explanation.warnings)
    add(Paragraph{"Beware: " + warning + ".", Tone::open});
}

void add_study(Document& document, const Study& study) {
  if (study.scales) document.blocks.push_back(Listing{"The study in full, in physical units", to_physical_toml(study)});
  document.blocks.push_back(
      Listing{study.scales ? "The same without dimensions, as it was computed" : "The study in full", to_toml(study)});
}

}  // namespace equipoise
