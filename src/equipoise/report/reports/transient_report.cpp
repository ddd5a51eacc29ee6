// Transients as text and as JSON.
#include "equipoise/report/reports/transient_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "equipoise/machine/balance/balance_grade.hpp"
#include "equipoise/machine/balance/tolerance_planes.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/report/words/reports.hpp"
#include "equipoise/report/words/text.hpp"
#include "equipoise/results/commands/left_grade.hpp"
#include "equipoise/results/types/fate.hpp"

namespace equipoise {

namespace {

using study::Dimension;

using Unit = study::ShownUnit;

Unit unit_of(const Study& study, Dimension d) { return study::shown_unit(d, study.scales); }
Unit unit_of(const Study& study, const TransientLimit& limit) { return unit_of(study, limit.told_in()); }

constexpr const char* no_bound = "?";

bool shows(const TransientFigure& f, const Study& study) { return !f.differs || f.differs(study); }

std::string number(double value, double size, const char* open) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value * size) : open;
}

// With this many starts, the least and the largest figure enclose the median with 95 % confidence: 2^(1 - n) < .05.
constexpr std::uint64_t fewest_for_figures = 6;

std::string figure_line(const TransientFigure& f, const SampleSummary& s, const Unit& unit, const char* open_word) {
  const char* open = s.open > 0 ? open_word : no_bound;
  const auto with_interval = [&](double value, double low, double high) -> std::string {
    if (std::isinf(low)) return open;
    return fmt::format("{} ({} to {})", number(value, unit.size, open), number(low, unit.size, open),
                       number(high, unit.size, open));
  };
  const std::size_t unit_width = std::max<std::size_t>(15, std::string_view(unit.name).size() + 1);
  constexpr std::string_view above = "peak displacement ";  // in the previous line
  std::string title = f.title;
  if (title.starts_with(above)) title.replace(0, above.size(), "  ");
  std::string line = fmt::format("  {:<{}}{:<{}}", title, 45 - unit_width, unit.name, unit_width);
  if (s.open == 0 && s.mean_low == s.mean_high)  // one motion
    return line + fmt::format(words::text::same_for_all, number(s.mean, unit.size, open));
  line += fmt::format("{:<36}", s.open == s.count ? open : with_interval(s.mean, s.mean_low, s.mean_high));
  for (const QuantileEstimate& q : s.quantiles) line += fmt::format("{:<36}", with_interval(q.value, q.low, q.high));
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string group_text(const TransientGroup& group, const TransientResult& r, const Study& study) {
  const std::string name = group.id ? group.name : words::text::all_outcomes;
  if (group.starts < fewest_for_figures) return fmt::format(words::text::too_few_starts, name, group.starts);
  std::string text = fmt::format("{}, {} starts\n", name, group.starts);
  for (std::size_t k = 0; k < transient_figures.size(); ++k) {
    const TransientFigure& f = transient_figures[k];
    if (!r.asks(f, study.limits) || !shows(f, study) || f.value == &TransientRow::followed_until) continue;
    const SampleSummary& s = group.figures[k];
    if (s.count == 0) continue;
    const Unit unit = unit_of(study, f.told_in());
    if (s.open == 0) {
      text += figure_line(f, s, unit, no_bound);
      continue;
    }
    const std::uint64_t for_good = group.for_good(f), later = s.open - for_good;
    text += figure_line(f, s, unit, later == 0 ? f.open[0] : for_good == 0 ? f.open[1] : words::text::no_end_seen);
    std::string words;
    if (for_good > 0) words = fmt::format(words::text::open_in, f.open[0], for_good, s.count);
    if (later > 0)
      words += fmt::format(words::text::open_when_last_followed, words.empty() ? "" : "; ", f.open[1], later, s.count);
    text += fmt::format("    {}{}\n", words, s.open < s.count ? words::text::mean_is_of_others : "");
  }
  for (std::size_t k = 0; k < transient_limits.size(); ++k) {
    if (!group.exceeded[k]) continue;
    const TransientLimit& l = transient_limits[k];
    const Share& s = *group.exceeded[k];
    const Unit unit = unit_of(study, l);
    text += fmt::format(
        "  {} above {:.4g} {}: {} ({}){}\n", l.measured, *(study.limits.*l.limit) * unit.size, unit.name,
        percent(s.share, s.count == 0 ? 0 : digits_for(s)), interval(s),
        group.id != undecided_code && (s.least < s.low || s.most > s.high) ? "; bounds " + bounds_text(s) : "");
  }
  const std::optional<double> grade = left_grade(group, study);
  if (grade) text += fmt::format(words::text::residual_unbalance, *grade);
  return text;
}

Json figure_json(const SampleSummary& s, const Unit& unit) {
  const auto of_finite = [&](double value) { return s.open < s.count ? Json(value * unit.size) : Json(); };
  Json quantiles = Json::array();
  for (std::size_t k = 0; k < s.quantiles.size(); ++k) {
    const QuantileEstimate& q = s.quantiles[k];
    quantiles.push_back(object("probability", reported_quantiles[k], "value", q.value * unit.size, "low",
                               q.low * unit.size, "high", q.high * unit.size));
  }
  return object("unit", unit.name, "count", s.count, "open", s.open, "mean", of_finite(s.mean), "mean_low",
                of_finite(s.mean_low), "mean_high", of_finite(s.mean_high), "largest", s.largest * unit.size,
                "quantiles", quantiles, "exact", s.exact);
}

// The speed that an unbalance is graded at; empty for a driven rotor whose speed was never measured.
std::optional<double> graded_speed(const TransientGroup& group, const Study& study) {
  return study.speed.driven() ? group.mean_speed : std::optional(study.speed_profile().final_speed());
}

// A quantile of a figure, or what its lack of an end is called.
std::string quantile_text(const TransientGroup& group, std::size_t k, std::size_t quantile, double size) {
  const TransientFigure& f = transient_figures[k];
  const SampleSummary& s = group.figures[k];
  if (s.count == 0) return "-";
  return number(s.quantiles[quantile].value, size, f.open[group.for_good(f) > 0 ? 0 : 1]);
}

// "Peak displacement: 1.7 times that without balls in the median, 2.9 at 90 %"; empty if balls leave nothing of it.
std::string times_words(const TransientGroup& with, const TransientGroup& bare, float TransientRow::*figure) {
  const auto times = [&](std::size_t q) {
    return with.figure(figure).quantiles[q].value / bare.figure(figure).quantiles[q].value;
  };
  const double median = times(0), most = times(1);
  if (!std::isfinite(median) || !std::isfinite(most) || most == 0.0) return "";
  return fmt::format(words::text::times_without_balls, transient_figures[figure_place(figure)].title, median, most);
}

// Whether the rotor without balls keeps the limits; empty if none is stated.
std::string limit_words(const OneBodyRuns& bare) {
  const auto &end = bare.figures.within[static_cast<std::size_t>(Within::at_end)],
             &way = bare.figures.within[static_cast<std::size_t>(Within::on_the_way)];
  if (!end || bare.figures.starts == 0) return "";
  if (bare.one)
    return fmt::format(words::text::bare_rotor_ends,
                       end->count > 0 ? words::text::within_all_limits : words::text::over_a_limit,
                       !way             ? ""
                       : way->count > 0 ? words::text::never_over_on_the_way
                                        : words::text::over_on_the_way);
  const auto share = [](const Share& s) { return percent(s.share, digits_for(s)); };
  return fmt::format(words::text::bare_runs_end_within, share(*end),
                     way ? fmt::format(words::text::bare_runs_never_over, share(*way)) : "");
}

std::string of_runs(std::uint64_t count, const OneBodyRuns& runs) {
  return runs.one ? "" : fmt::format(words::text::in_runs, count, runs.runs);
}

Json one_body_json(const OneBodyRuns& body, const Study& study) {
  const TransientGroup& g = body.figures;
  Json figures = Json::object();
  for (std::size_t k = 0; k < transient_figures.size(); ++k) {
    const TransientFigure& f = transient_figures[k];
    if (!f.of_bare_rotor || (f.needs && !(study.limits.*f.needs))) continue;
    const Unit unit = unit_of(study, f.told_in());
    // One run has no interval.
    figures[f.name] = body.one ? object("unit", unit.name, "value", g.figures[k].quantiles[0].value * unit.size)
                               : figure_json(g.figures[k], unit);
  }
  const auto told = [&](const Share& s) { return body.one ? Json(s.count > 0) : sure(s); };
  Json json = object("runs", body.runs, "one_for_all", body.one, "stalled", body.stalled, "not_steady", body.open,
                     "lost", body.lost, "figures", figures, "exceeded", by_name(g.exceeded, transient_limits, told),
                     "within", by_name(g.within, within_names, told));
  if (g.starts > 0) put_known(json, "balance_grade", left_grade(g, study));
  put_known(json, "mean_speed", g.mean_speed);
  return json;
}

// Of a rotor that tilts: where along its shaft figures are told, and in which planes its unbalance.
std::string places_words(const BasinResult& r) {
  if (!r.study.parameters.tilts()) return "";
  const char* forces =
      watched_shaft(r.study).bearings.empty() ? words::text::forces_of_supports : words::text::forces_of_bearing;
  const std::string places = r.study.bearings.empty() ? fmt::format(words::text::told_at_centre_of_mass, forces)
                                                      : fmt::format(words::text::told_at_bearings, forces);
  return places + (model::tolerance_planes(r.study.bearings) ? words::text::unbalance_in_planes
                                                             : words::text::unbalance_is_static);
}

}  // namespace

bool tells_without_balls(const BasinResult& r) {
  return r.transients && r.without_balls && !r.transients->groups.empty() &&
         r.transients->groups.front().starts >= fewest_for_figures;
}

DocumentTable bare_table(const BasinResult& r) {
  const OneBodyRuns& bare = r.without_balls->bare;
  DocumentTable table{{"", bare.one ? words::text::one_run : "median"}};
  if (!bare.one) table.header.emplace_back("90 % below");
  for (std::size_t k = 0; k < transient_figures.size(); ++k) {
    const TransientFigure& f = transient_figures[k];
    if (!f.of_bare_rotor || !shows(f, r.study) || (f.needs && !(r.study.limits.*f.needs))) continue;
    const Unit unit = unit_of(r.study, f.told_in());
    table.rows.push_back(
        row_of("ln", {fmt::format("{}, {}", f.title, unit.name), quantile_text(bare.figures, k, 0, unit.size)}));
    if (!bare.one) table.rows.back().push_back(number_cell(quantile_text(bare.figures, k, 1, unit.size)));
  }
  return table;
}

std::string bare_words(const BasinResult& r) {
  const OneBodyRuns& bare = r.without_balls->bare;
  if (bare.one) return words::reports::one_run_tells_all;
  return fmt::format(words::reports::runs_draw_the_rest, bare.runs);
}

DocumentTable without_balls_table(const BasinResult& r) {
  const TransientGroup &with = r.transients->groups.front(), &bare = r.without_balls->bare.figures,
                       &held = r.without_balls->held.figures;
  DocumentTable table{
      {"", words::text::no_balls, words::text::balls_held_title, words::text::with_balls, "90 % below"}};
  for (std::size_t k = 0; k < transient_figures.size(); ++k) {
    const TransientFigure& f = transient_figures[k];
    if (!f.of_bare_rotor || !shows(f, r.study) || !r.transients->asks(f, r.study.limits)) continue;
    const Unit unit = unit_of(r.study, f.told_in());
    table.rows.push_back(row_of("lnnnn", {fmt::format("{}, {}", f.title, unit.name),
                                          quantile_text(bare, k, 0, unit.size), quantile_text(held, k, 0, unit.size),
                                          quantile_text(with, k, 0, unit.size), quantile_text(with, k, 1, unit.size)}));
    const auto& cells = table.rows.back();
    if (std::all_of(cells.begin() + 1, cells.end(), [](const DocumentCell& c) { return c.text == "0"; }))
      table.rows.pop_back();
    if (f.value != &TransientRow::residual_unbalance || !is_graded(r.study)) continue;
    // A mean speed says nothing where some rotors stall.
    const auto grade = [&](const TransientGroup& g, bool some_stall, std::size_t quantile) -> std::string {
      const std::optional<double> speed = some_stall ? std::nullopt : graded_speed(g, r.study);
      if (!speed || g.figures[k].count == 0) return "-";
      return fmt::format("{:.4g}", model::balance_grade(g.figures[k].quantiles[quantile].value * r.study.scales->length,
                                                        *speed * r.study.scales->frequency));
    };
    const OneBodyRuns &none = r.without_balls->bare, &fixed = r.without_balls->held;
    const bool stall = r.stalled && r.stalled->count > 0;
    table.rows.push_back(
        row_of("lnnnn", {words::text::e_omega, grade(bare, none.stalled > 0 && !none.one, 0),
                         grade(held, fixed.stalled > 0, 0), grade(with, stall, 0), grade(with, stall, 1)}));
  }
  table.caption =
      fmt::format(words::text::columns_mean,
                  r.without_balls->bare.one ? words::text::one_run
                                            : fmt::format(words::text::median_of_runs, r.without_balls->bare.runs),
                  r.without_balls->held.runs);
  return table;
}

std::vector<std::string> without_balls_words(const BasinResult& r) {
  std::vector<std::string> words;
  const auto say = [&](std::string sentence) {
    if (sentence.empty()) return;
    if (sentence[0] >= 'a' && sentence[0] <= 'z') sentence[0] = static_cast<char>(sentence[0] - 'a' + 'A');
    words.push_back(sentence + ".");
  };
  say(places_words(r));
  if (tells_without_balls(r))
    for (const auto figure : {&TransientRow::peak_radial, &TransientRow::rms_velocity})
      say(times_words(r.transients->groups.front(), r.without_balls->bare.figures, figure));
  say(limit_words(r.without_balls->bare));
  const auto tell = [&](const OneBodyRuns& body, const char* how) {
    if (body.stalled > 0)
      say(fmt::format(words::text::motor_fails, how, of_runs(body.stalled, body),
                      body.one && body.figures.mean_speed
                          ? words::text::it_ends_at + rotor_speed_text(r.study, *body.figures.mean_speed)
                          : ""));
    if (body.open > 0) say(fmt::format(words::text::no_steady_motion, how, of_runs(body.open, body)));
    if (body.lost > 0) say(fmt::format(words::text::motion_lost, how, of_runs(body.lost, body)));
  };
  tell(r.without_balls->bare, words::text::without_balls);
  tell(r.without_balls->held, words::text::with_balls_held);
  return words;
}

Json without_balls_json(const WithoutBalls& without, const Study& study) {
  Json json = object("no_balls", one_body_json(without.bare, study));
  if (without.held.runs > 0) put(json, "balls_held", one_body_json(without.held, study));
  return json;
}

DocumentTable limits_table(const TransientGroup& group, const Study& study) {
  DocumentTable table{{"starts", "share", "95 % interval"}};
  const auto opens = [](const std::optional<Share>& s) { return s && (s->least < s->low || s->most > s->high); };
  const bool open = std::any_of(group.within.begin(), group.within.end(), opens);
  if (open) table.header.emplace_back("bounds");
  for (std::size_t k = 0; k < within_titles.size(); ++k) {
    if (!group.within[k]) continue;
    const Share& s = *group.within[k];
    table.rows.push_back({{within_titles[k], Tone::plain, false, true}, share_cell(s), number_cell(interval(s))});
    if (open) table.rows.back().push_back(number_cell(bounds_text(s)));
  }
  if (table.rows.empty()) return table;
  const auto add = [&](const char* name, double limit, const Unit& unit) {
    table.caption +=
        fmt::format("{}{} {:.4g} {}", table.caption.empty() ? "Limits: " : ", ", name, limit * unit.size, unit.name);
  };
  for (const TransientLimit& l : transient_limits)
    if (const auto& limit = study.limits.*l.limit) add(l.name, *limit, unit_of(study, l));
  if (study.limits.settled) add("settled", *study.limits.settled, unit_of(study, Dimension::length));
  table.caption += ".";
  if (study.limits.force) table.caption += words::text::forces_are_rms;
  return table;
}

std::string clearance_words(const TransientGroup& group, const Study& study) {
  if (!study.limits.clearance) return "";
  std::size_t k = 0;
  while (transient_limits[k].limit != &Limits::clearance) ++k;
  if (!group.exceeded[k] || group.starts < fewest_for_figures) return "";
  const Unit unit = unit_of(study, Dimension::length);
  const auto share = [](const Share& s) {
    return fmt::format(words::text::of_starts, percent(s.share, s.count == 0 ? 0 : digits_for(s)), interval(s));
  };
  const SampleSummary& end = group.figure(&TransientRow::peak_radial_at_end);
  const auto width = [&](double radius) { return fmt::format("{:.4g}", 2.0 * radius * unit.size); };
  return fmt::format(words::text::housing_hit, *study.limits.clearance * unit.size, unit.name,
                     share(*group.exceeded[k]), share(*group.exceeded_at_end[k]), width(end.quantiles[0].value),
                     unit.name, width(end.quantiles[1].value), unit.name, width(*study.limits.clearance), unit.name);
}

std::optional<double> left_grade(const TransientGroup& group, const Study& study) {
  if (!is_graded(study)) return std::nullopt;
  const double mean = group.figure(&TransientRow::residual_unbalance).mean;
  const std::optional<double> speed = graded_speed(group, study);
  if (!speed) return std::nullopt;
  return model::balance_grade(mean * study.scales->length, *speed * study.scales->frequency);
}

std::string transient_text(const TransientResult& r, const Study& study) {
  const Unit length = unit_of(study, Dimension::length), time = unit_of(study, Dimension::time),
             force = unit_of(study, Dimension::force);
  std::string text = fmt::format("  {:<45}{:<36}{:<36}{:<36}{}\n", words::text::transients_title, "mean", "median",
                                 words::text::below_90_title, words::text::below_99_title);
  for (const TransientGroup& group : r.groups)
    // A single outcome says everything.
    if (group.starts > 0 && !(!group.id && r.groups.size() == 2)) text += group_text(group, r, study);
  if (r.settings.watches_settling())
    text += fmt::format(words::text::settled_means, r.settings.settled * length.size, length.name);
  const bool undecided =
      std::any_of(r.groups.begin(), r.groups.end(), [](const auto& g) { return g.id == undecided_code; });
  text += fmt::format(
      words::text::at_the_end_means,
      undecided ? fmt::format(words::text::window_of_undecided, r.settings.window * time.size, time.name) : "");
  text += has_directions(study) ? words::text::rms_velocity_of_both : words::text::rms_velocity_means;
  const double sag = -model::static_sag(study.parameters);
  if (sag != 0.0)
    text += fmt::format(words::text::measured_from_rest, sag * length.size, length.name,
                        model::total_weight(study.parameters) * force.size, force.name);
  if (r.lost > 0) text += fmt::format(words::text::lost_left_out, r.lost);
  return text + "\n";
}

Json transient_json(const TransientResult& r, const Study& study) {
  const Unit length = unit_of(study, Dimension::length), time = unit_of(study, Dimension::time);
  Json units, limits = Json::object();
  for (const TransientLimit& l : transient_limits) {
    units[l.name] = unit_of(study, l).name;
    if (const auto& limit = study.limits.*l.limit) limits[l.name] = *limit * unit_of(study, l).size;
  }
  put(units, "time", time.name, "energy", unit_of(study, Dimension::energy).name);
  if (r.settings.watches_settling()) put(limits, "settled", r.settings.settled * length.size);
  Json json = object("units", units, "window", r.settings.window * time.size, "static_sag",
                     (0.0 - model::static_sag(study.parameters)) * length.size, "weight",
                     (0.0 + model::total_weight(study.parameters)) * unit_of(study, Dimension::force).size);
  const WatchedShaft& shaft = r.settings.shaft;
  if (study.parameters.tilts())
    put(json, "places", std::array{shaft.places[0] * length.size, shaft.places[1] * length.size}, "force_of",
        shaft.bearings.empty() ? "supports" : "bearing");
  const auto group_json = [&](const TransientGroup& group) {
    Json one = object("name", group.name, "id", group.id, "starts", group.starts);
    for (std::size_t k = 0; k < transient_figures.size(); ++k) {
      const TransientFigure& f = transient_figures[k];
      if (!r.asks(f, study.limits)) continue;
      Json& figure = one["figures"][f.name] = figure_json(group.figures[k], unit_of(study, f.told_in()));
      if (f.needs) put(figure, "for_good", group.for_good(f));
    }
    put(one, "exceeded", by_name(group.exceeded, transient_limits, sure), "exceeded_at_end",
        by_name(group.exceeded_at_end, transient_limits, sure), "within", by_name(group.within, within_names, sure));
    put_known(one, "balance_grade", left_grade(group, study), "mean_speed", group.mean_speed);
    return one;
  };
  put(json, "limits", limits, "lost", r.lost, "groups", list_of(r.groups, group_json));
  return json;
}

}  // namespace equipoise
