// Things, verdicts and margins in words.
#include "equipoise/report/answers/design_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "equipoise/core/base/read_number.hpp"
#include "equipoise/report/decision/verdict.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/results/columns/transient_figures.hpp"

namespace equipoise {

namespace {

constexpr char no_end[] = "no end";

constexpr std::string_view all_kept = "All requirements are kept: ";

// Things that are chosen, and their values after them.
struct Thing {
  const char* key;
  const char* name;    // "ball diameter"
  const char* before;  // its value follows: "balls released at "
};
constexpr std::array<Thing, 12> known_things{{{"balancer.balls", "number of balls", ""},
                                              {"balancer.ball_diameter", "ball diameter", ""},
                                              {"balancer.mass", "mass of a ball", ""},
                                              {"balancer.oil.grade", "oil", ""},
                                              {"balancer.oil_viscosity", "oil's viscosity", "oil of "},
                                              {"balancer.drag", "drag", "drag "},
                                              {"balancer.race_radius", "race radius", "race radius "},
                                              {"rotor.damping_ratio", "damping ratio", "damping ratio "},
                                              {"rotor.stiffness", "stiffness", "stiffness "},
                                              {"release.speed", "speed of release", "balls released at "},
                                              {"release.time", "time of release", "balls released after "},
                                              {"speed", "run-up", "run-up "}}};

// Shares and times of the starts; quantiles are named by transient_figures.
constexpr std::array<std::pair<const char*, const char*>, 7> known_figures{{
    {"balanced", "starts that balance"},
    {"passed", "starts that pass resonance"},
    {"limits_kept", "starts within all limits"},
    {"limits_kept_at_end", "starts within all limits at the end"},
    {"limits_kept_on_the_way", "starts never over a limit on the way"},
    {"undecided", "undecided starts"},
    {"time_to_balance", "time to balance"},
}};

const Thing* known_thing(const std::string& key) {
  const auto at = std::find_if(known_things.begin(), known_things.end(), [&](const Thing& t) { return key == t.key; });
  return at == known_things.end() ? nullptr : &*at;
}

// "12 mm" of balls whose size the study states.
std::string own_size(const Study& study) {
  const model::Parameters& p = study.parameters;
  if (!study.scales || !p.equal_balls() || !(p.ball_radius[0] > 0.0)) return "";
  return fmt::format("{:.6g} mm", 2e3 * p.ball_radius[0] * study.scales->length);
}

// "4 balls of 12 mm"
std::string balls_chosen(const Study& study, const std::vector<DesignSetting>& settings) {
  const auto of = [&](const char* key) {
    for (const DesignSetting& s : settings)
      if (s.key == key) return setting_text(s.value);
    return std::string();
  };
  std::string number = of("balancer.balls"), size = of("balancer.ball_diameter");
  if (number.empty() && size.empty() && of("balancer.mass").empty()) return "";
  if (number.empty()) number = fmt::format("{}", study.parameters.balls);
  if (size.empty() && !of("balancer.mass").empty()) size = of("balancer.mass") + (study.scales ? "" : " (mass)");
  if (size.empty()) size = own_size(study);
  return fmt::format("{} ball{}{}{}", number, number == "1" ? "" : "s", size.empty() ? "" : " of ", size);
}

std::string shown(const DesignMargin& m, double value) { return fmt::format("{}{:.4g}", m.prefix, value); }

// "ball diameter 10 to 15 mm"; a value that failed nowhere in the range tried is left out.
std::string margins_words(const DesignResult& r) {
  constexpr std::size_t most_told = 3;
  std::string words;
  std::size_t told = 0;
  for (const DesignMargin& m : r.margins) {
    if (!has_ends(m) || (m.fails_below.empty() && m.fails_above.empty())) continue;
    const std::string unit = m.unit.empty() ? "" : " " + m.unit;
    if (told++ == most_told) return words + "; and others below";
    words += fmt::format("{}{} ", words.empty() ? "" : "; ", thing_of(m.key));
    if (m.keeps_from == m.keeps_to && !m.fails_below.empty() && !m.fails_above.empty())
      words += fmt::format("{}{} only", shown(m, m.value), unit);
    else if (m.fails_above.empty())
      words += fmt::format("{}{} or more", shown(m, m.keeps_from), unit);
    else if (m.fails_below.empty())
      words += fmt::format("{}{} or less", shown(m, m.keeps_to), unit);
    else
      words += fmt::format("{} to {}{}", shown(m, m.keeps_from), shown(m, m.keeps_to), unit);
  }
  return words;
}

// Whether the study as it is meets all requirements, and the chosen design is not certainly better.
bool as_good_before(const DesignResult& r, const DesignSample& now) {
  if (!r.before || r.before->figures.empty() || !r.feasible) return false;
  for (const DesignLimit& limit : r.limits) {
    const DesignEstimate& e = r.before->figures[limit.figure];
    if ((limit.below && !(e.high <= *limit.below)) || (limit.above && !(e.low >= *limit.above))) return false;
  }
  return std::none_of(r.objectives.begin(), r.objectives.end(), [&](std::size_t k) {
    const DesignEstimate &is = now.figures[k], &was = r.before->figures[k];
    return std::isnan(was.value) || (r.figures[k].up ? is.low > was.high : is.high < was.low);
  });
}

}  // namespace

bool keeps(const DesignLimit& limit, double value) {
  return !(limit.below && !(value < *limit.below)) && !(limit.above && !(value > *limit.above));
}

bool has_ends(const DesignMargin& m) {
  return m.keeps_from != m.keeps_to || !m.fails_below.empty() || !m.fails_above.empty();
}

bool surely_keeps(const DesignLimit& limit, const DesignEstimate& e) {
  return keeps(limit, e.low) && keeps(limit, e.high);
}

std::string figure_words(const DesignFigure& figure, bool brief) {
  const std::size_t dot = figure.name.find('.');
  const std::string column = figure.name.substr(0, dot);
  std::string words;
  for (const auto& [name, meaning] : known_figures)
    if (column == name) words = meaning;
  for (const TransientFigure& f : transient_figures)
    if (column == f.name) words = f.title;
  if (words.empty()) return figure.name;
  if (dot == std::string::npos) return words;
  const double percents = 100.0 * number_in(figure.name.substr(dot + 1));
  return fmt::format("{}, {:.6g} %{}", words, percents, brief ? "" : " of starts below");
}

std::string limit_text(const DesignFigure& figure, const DesignLimit& limit) {
  std::string text;
  if (limit.below) text = "below " + estimate_text(figure, *limit.below);
  if (limit.above) text += (text.empty() ? "above " : " and above ") + estimate_text(figure, *limit.above);
  return text;
}

std::string estimate_text(const DesignFigure& figure, double value) {
  if (std::isnan(value)) return "not stated";
  if (!std::isfinite(value)) return no_end;
  if (figure.share) return fmt::format("{:.4g} %", 100.0 * value);
  return fmt::format("{:.4g}{}", value, figure.unit.empty() ? "" : " " + figure.unit);
}

std::string estimate_with_interval(const DesignFigure& figure, const DesignEstimate& e) {
  if (e.low == e.high || std::isnan(e.value)) return estimate_text(figure, e.value);
  if (figure.share) {
    Share share;  // the fewest starts that distinguish none, some and all
    share.total = 2;
    share.count = e.value <= 0.0 ? 0 : e.value >= 1.0 ? 2 : 1;
    share.low = e.low;
    share.high = e.high;
    return fmt::format("{} ({})", percent(e.value, digits_for(share)), interval(share));
  }
  const std::string high = std::isfinite(e.high) ? fmt::format("{:.3g}", e.high) : no_end;
  return fmt::format("{} ({:.3g} to {})", estimate_text(figure, e.value), e.low, high);
}

std::string setting_text(const StudyValue& value) {
  if (const auto* text = value.string()) return *text;
  if (const auto* whole = value.integer()) return fmt::format("{}", *whole);
  if (const auto* truth = value.boolean()) return *truth ? "true" : "false";
  const StudyValue *times = value.find("times"), *speeds = value.find("speeds");
  if (!times || !speeds) return fmt::format("{:.6g}", value.number());
  std::string text;
  for (std::size_t k = 0; k < times->array()->size(); ++k)
    text += fmt::format("{}{} at {}", k > 0 ? ", " : "", setting_text((*speeds->array())[k]),
                        setting_text((*times->array())[k]));
  return text;
}

std::string margin_name(const std::string& key) {
  const std::string_view times = "speed.times[", speeds = "speed.speeds[";
  const auto place = [&](std::string_view of) { return key.substr(of.size(), key.size() - of.size() - 1); };
  if (key.starts_with(times)) return "time of point " + place(times);
  if (key.starts_with(speeds)) return "speed of point " + place(speeds);
  return key;
}

std::string design_answer(const DesignResult& r) {
  if (!r.chosen || r.front[*r.chosen].best_known().figures.empty())
    return r.partial ? "PARTIAL: stopped before any candidate was known." : "No candidate was found.";
  const DesignCandidate& best = r.front[*r.chosen];
  const DesignSample& sample = best.best_known();
  std::string text;
  for (const std::size_t k : r.objectives)
    text += fmt::format("{}{} {}", text.empty() ? "" : "; ", figure_words(r.figures[k]),
                        estimate_with_interval(r.figures[k], sample.figures[k]));
  std::string before;
  if (r.before && !r.before->figures.empty() && !best.as_it_is)
    before = fmt::format(
        "; as it is {}{}", r.objectives.size() > 1 ? figure_words(r.figures[r.objectives.front()]) + " " : "",
        estimate_with_interval(r.figures[r.objectives.front()], r.before->figures[r.objectives.front()]));
  if (r.feasible) return fmt::format("{}{}{}.", r.limits.empty() ? "" : all_kept, text, before);
  std::string missed;
  for (const DesignLimit& limit : r.limits) {
    const DesignEstimate& e = sample.figures[limit.figure];
    if (surely_keeps(limit, e)) continue;
    missed += fmt::format("{}{} must be {} and is {}{}", missed.empty() ? "" : "; ",
                          figure_words(r.figures[limit.figure], true), limit_text(r.figures[limit.figure], limit),
                          keeps(limit, e.value) ? "likely, but not shown: " : "at best ",
                          estimate_with_interval(r.figures[limit.figure], e));
  }
  return fmt::format("No candidate keeps all requirements: {}. The nearest has {}{}.", missed, text, before);
}

std::string thing_of(const std::string& key) {
  if (const Thing* thing = known_thing(key)) return thing->name;
  std::string name = margin_name(key);
  if (name != key) return name;
  name = key.substr(key.rfind('.') + 1);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string things_chosen(const Study& study, const std::vector<DesignSetting>& settings) {
  std::string words = balls_chosen(study, settings);
  for (const DesignSetting& s : settings) {
    if (s.key == "balancer.balls" || s.key == "balancer.ball_diameter" || s.key == "balancer.mass") continue;
    if (setting_text(s.value) == design_as_given) continue;  // the study states none
    const Thing* thing = known_thing(s.key);
    words += fmt::format("{}{}{}", words.empty() ? "" : ", ", thing ? thing->before : thing_of(s.key) + " ",
                         setting_text(s.value));
  }
  return words;
}

DesignVerdict design_verdict(const DesignResult& r) {
  if (r.leave_out)
    return {fmt::format(leave_balancer_out, below_resonance_words(r.study)), by_linear_theory,
            "There is nothing to choose."};
  DesignVerdict verdict;
  const std::string partial = r.partial ? "PARTIAL: " : "";
  if (!r.chosen || r.front[*r.chosen].best_known().figures.empty())
    return {design_answer(r), "No candidate was followed to its end.",
            "Not known. A longer --within, or fewer values to choose from, may show more."};
  const DesignCandidate& best = r.front[*r.chosen];
  const DesignSample& now = best.best_known();
  const std::string things = best.as_it_is ? design_as_given : things_chosen(r.study, best.settings);
  const bool alone = r.limits.empty();
  if (best.as_it_is && r.partial && r.candidates == 1)
    verdict.words = fmt::format("{}{}No other design was tried in the time. Allow more, or lower design.starts.",
                                partial, r.feasible && !alone ? "Leave it as it is: it keeps all requirements. " : "");
  else if (best.as_it_is ? r.feasible : as_good_before(r, now))
    verdict.words = fmt::format("{}Leave it as it is: {}nothing found is shown to be better.{}", partial,
                                alone ? "" : "it keeps all requirements, and ",
                                best.as_it_is ? "" : fmt::format(" Best found: {}.", things));
  else if (r.feasible)
    verdict.words = fmt::format("{}{}{}.", partial, things, alone ? "" : ": all requirements are kept");
  else
    verdict.words = fmt::format("{}Nothing tried is shown to keep all requirements; nearest: {}.", partial, things);
  verdict.because = design_answer(r);
  if (verdict.because.starts_with(all_kept)) verdict.because.erase(0, all_kept.size());  // the verdict says so
  if (r.margins.empty()) {
    verdict.margins = best.as_it_is && !r.partial
                          ? "The study states none of these numbers, so that none was changed alone."
                          : "Tolerances were not worked out: time ran out.";
  } else {
    const std::string words = margins_words(r);
    verdict.margins = words.empty() ? "Each number was changed alone: no value tried fails what the design keeps."
                                    : words + (alone ? ": shown to be no worse." : ": requirements kept.");
  }
  return verdict;
}

}  // namespace equipoise
