// Transients in tables and as JSON.
#include "equipoise/report/reports/transient_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "equipoise/machine/balance/tolerance_planes.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/results/commands/left_grade.hpp"
#include "equipoise/results/types/outcome.hpp"

namespace equipoise {

namespace {

constexpr char one_run[] = "one run";

using study::Dimension;

using Unit = study::ShownUnit;

Unit unit_of(const Study& study, const TransientLimit& limit) { return unit_of(study, limit.told_in()); }

constexpr const char* no_bound = "?";

bool shows(const TransientFigure& f, const Study& study) { return !f.differs || f.differs(study); }

std::string number(double value, double size, const char* open) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value * size) : open;
}

// With this many starts, the least and the largest figure enclose the median with 95 % confidence: 2^(1 - n) < .05.
constexpr std::uint64_t fewest_for_figures = 6;

// Mean and quantiles with their intervals; `open_word`: what figures without an end are called.
std::vector<DocumentCell> figure_row(const TransientFigure& f, const SampleSummary& s, const Unit& unit,
                                     const char* open_word) {
  const char* open = s.open > 0 ? open_word : no_bound;
  const auto with_interval = [&](double value, double low, double high) -> DocumentCell {
    if (std::isinf(low)) return {open};
    return {fmt::format("{} ({} to {})", number(value, unit.size, open), number(low, unit.size, open),
                        number(high, unit.size, open))};
  };
  std::vector<DocumentCell> row{label_cell(fmt::format("{}, {}", f.title, unit.name))};
  if (s.open == 0 && s.mean_low == s.mean_high) {  // one motion
    row.push_back({number(s.mean, unit.size, open) + ", the same for all starts"});
    row.resize(2 + s.quantiles.size());
    return row;
  }
  row.push_back(s.open == s.count ? DocumentCell{open} : with_interval(s.mean, s.mean_low, s.mean_high));
  for (const QuantileEstimate& q : s.quantiles) row.push_back(with_interval(q.value, q.low, q.high));
  return row;
}

void add_group(Document& document, const TransientGroup& group, const TransientResult& r, const Study& study) {
  const std::string name = group.id ? group.name : "all outcomes";
  if (group.starts < fewest_for_figures)
    return document.add(Paragraph{fmt::format("{}: too few starts ({}) for figures", name, group.starts)});
  DocumentTable table{{fmt::format("{}, {} starts", name, group.starts), "mean", "median", "90 % of starts below",
                       "99 % of starts below"},
                      {},
                      "With 95 % intervals."};
  for (std::size_t k = 0; k < transient_figures.size(); ++k) {
    const TransientFigure& f = transient_figures[k];
    if (!r.asks(f, study.limits) || !shows(f, study) || f.value == &TransientRow::followed_until) continue;
    const SampleSummary& s = group.figures[k];
    if (s.count == 0) continue;
    const std::uint64_t for_good = group.for_good(f), later = s.open - for_good;
    table.rows.push_back(figure_row(f, s, unit_of(study, f.told_in()),
                                    s.open == 0     ? no_bound
                                    : later == 0    ? f.open[0]
                                    : for_good == 0 ? f.open[1]
                                                    : "no end seen"));
    if (for_good > 0) table.caption += fmt::format(" {}: {} of {} starts.", f.open[0], for_good, s.count);
    if (later > 0) table.caption += fmt::format(" {} when last followed: {} of {} starts.", f.open[1], later, s.count);
    if (s.open > 0 && s.open < s.count) table.caption += " The mean is of the others.";
  }
  document.add(std::move(table));
  for (std::size_t k = 0; k < transient_limits.size(); ++k) {
    if (!group.exceeded[k]) continue;
    const TransientLimit& l = transient_limits[k];
    const Share& s = *group.exceeded[k];
    const Unit unit = unit_of(study, l);
    document.add(Paragraph{fmt::format(
        "{} above {:.4g} {}: {} ({}){}", l.measured, *(study.limits.*l.limit) * unit.size, unit.name, share_text(s),
        interval(s),
        group.id != undecided_code && (s.least < s.low || s.most > s.high) ? "; bounds " + bounds_text(s) : "")});
  }
  if (const std::optional<double> grade = left_grade(group, study))
    document.add(Paragraph{fmt::format(
        "residual unbalance at the final speed: e omega = {:.3g} mm/s (as ISO 21940-11 grades it)", *grade)});
}

Json with_unit(const SampleSummary& s, const Unit& unit) {
  const auto of_finite = [&](double value) { return s.open < s.count ? Json(value * unit.size) : Json(); };
  Json quantiles = Json::array();
  for (std::size_t k = 0; k < s.quantiles.size(); ++k) {
    quantiles.push_back(object("probability", reported_quantiles[k]));
    quantiles.back().update(Json(times(s.quantiles[k], unit.size)));
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
  return fmt::format("{}: {:.3g} times that without balls in the median, {:.3g} at 90 %",
                     transient_figures[figure_place(figure)].title, median, most);
}

std::string of_runs(std::uint64_t count, const OneBodyRuns& runs) {
  return runs.one ? "" : fmt::format(" in {} of {} runs", count, runs.runs);
}

// For a tilting rotor: where along its shaft figures are taken, and in which planes its unbalance.
std::string places_words(const BasinResult& r) {
  if (!r.study.parameters.tilts()) return "";
  const char* forces =
      watched_shaft(r.study).bearings.empty() ? "all supports together" : "the bearing that takes most";
  const std::string places = r.study.bearings.empty()
                                 ? fmt::format(
                                       "No bearings are stated: displacements and velocities are those of the shaft at "
                                       "the centre of mass; forces are those of {}",
                                       forces)
                                 : fmt::format(
                                       "displacements and velocities are those of the outermost bearing that has more "
                                       "of them; forces are those of {}",
                                       forces);
  return places + (model::tolerance_planes(r.study.bearings)
                       ? "; the residual unbalance is that in the plane of the outermost bearing that has more of it "
                         "for its share of what the rotor may have, as ISO 21940-11 shares it out"
                       : "; the residual unbalance is the static one alone, which has no balance quality grade: ISO "
                         "21940-11 judges a tilting rotor in the planes of two bearings, and two are not stated");
}

}  // namespace

std::array<const char*, 2> phase_words(const Study& study) {
  const SpeedSetting& s = study.speed;
  const bool up = !s.driven() && (s.profile == Profile::hill ||
                                  (s.profile == Profile::ramp && std::fabs(s.final) > std::fabs(s.initial)));
  return {runs_up(study) ? "during start-up" : "before settling", up ? "at full speed" : "once settled"};
}

std::string figure_name(float TransientRow::*figure) {
  const std::string title = transient_figures[figure_place(figure)].title;
  return title.substr(0, title.find(" at the end"));
}

std::string bare_limit_words(const OneBodyRuns& bare, const Study& study) {
  const auto &end = bare.figures.within[static_cast<std::size_t>(Within::at_end)],
             &way = bare.figures.within[static_cast<std::size_t>(Within::on_the_way)];
  const auto& kept = bare.figures.kept();
  if (!kept || kept->total == 0) return "";
  if (!bare.one)
    return fmt::format("Without balls {} of runs stay within every limit ({})", share_text(*kept), interval(*kept));
  const bool over_end = end && end->count == 0, over_way = way && way->count == 0;
  if (!over_end && !over_way) return "Without balls the rotor meets every limit";
  const auto [before, after] = phase_words(study);
  std::string words = fmt::format("Without balls the rotor exceeds a limit {}{}", over_way ? before : after,
                                  over_way && over_end ? fmt::format(" and {}", after) : "");
  if (end && way && over_end != over_way) words += fmt::format(", but not {}", over_way ? after : before);
  return words;
}

bool tells_without_balls(const BasinResult& r) {
  return r.transients && r.without_balls && !r.transients->groups.empty() &&
         r.transients->groups.front().starts >= fewest_for_figures;
}

DocumentTable bare_table(const BasinResult& r) {
  const OneBodyRuns& bare = r.without_balls->bare;
  DocumentTable table{{"", bare.one ? one_run : "median"}};
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
  if (bare.one) return "There are no balls: nothing is random, so one run is enough.";
  return fmt::format("There are no balls: {} runs draw the uncertain values.", bare.runs);
}

DocumentTable way_table(const BasinResult& r) {
  const TransientGroup& with = r.transients->groups.front();
  const WithoutBalls* none = tells_without_balls(r) ? &*r.without_balls : nullptr;
  const Limits& limits = r.study.limits;
  const auto limit_of = [&](const TransientFigure& f) {
    return std::find_if(transient_limits.begin(), transient_limits.end(),
                        [&](const TransientLimit& l) { return l.value == f.value && !l.by_speed && limits.*l.limit; });
  };
  const bool limited = std::any_of(transient_figures.begin(), transient_figures.end(),
                                   [&](const auto& f) { return limit_of(f) != transient_limits.end(); });
  DocumentTable table{{""}};
  if (none) table.header = {"", "no balls", "balls held"};
  table.header.insert(table.header.end(), {"with balls", "90 % below", "99 % below"});
  const std::size_t numbers = table.header.size();
  if (limited) table.header.insert(table.header.end(), {"limit", "exceeded by"}), table.spare = {numbers, numbers + 1};
  table.spare.push_back(numbers - 1);
  const auto add = [&](const std::string& title, const std::vector<std::string>& figures) {
    std::vector<DocumentCell>& row = table.rows.emplace_back();
    row.push_back(label_cell(title));
    for (const std::string& text : figures) row.push_back(number_cell(text));
    while (row.size() < table.header.size()) row.push_back(number_cell("-"));
  };
  for (std::size_t k = 0; k < transient_figures.size(); ++k) {
    const TransientFigure& f = transient_figures[k];
    if (!(f.of_bare_rotor || f.on_page) || !shows(f, r.study) || !r.transients->asks(f, limits)) continue;
    const Unit unit = unit_of(r.study, f.told_in());
    std::vector<std::string> figures;
    const auto told = [&](const TransientGroup& group, std::size_t quantile) {
      figures.push_back(quantile_text(group, k, quantile, unit.size));
    };
    if (none) {
      for (const OneBodyRuns* body : {&none->bare, &none->held}) {
        if (f.of_bare_rotor)
          told(body->figures, 0);
        else
          figures.emplace_back("-");
      }
    }
    for (std::size_t quantile = 0; quantile < 3; ++quantile) told(with, quantile);
    const auto limit = limit_of(f);
    if (limit != transient_limits.end()) {
      figures.push_back(fmt::format("{:.4g}", *(limits.*limit->limit) * unit.size));
      const auto& exceeded = with.exceeded[static_cast<std::size_t>(limit - transient_limits.begin())];
      figures.push_back(exceeded ? share_with_interval(*exceeded) : "-");
    } else if (std::all_of(figures.begin(), figures.end(), [](const std::string& text) { return text == "0"; })) {
      continue;
    }
    add(fmt::format("{}, {}", f.title, unit.name), figures);
    if (!none || f.value != &TransientRow::residual_unbalance || !is_graded(r.study)) continue;
    // A mean speed says nothing where some rotors stall.
    const auto grade = [&](const TransientGroup& g, bool some_stall, std::size_t quantile) -> std::string {
      const std::optional<double> speed = some_stall ? std::nullopt : graded_speed(g, r.study);
      if (!speed || g.figures[k].count == 0) return "-";
      return fmt::format("{:.4g}", grade_at(g.figures[k].quantiles[quantile].value, *speed, r.study));
    };
    const bool stall = r.stalled && r.stalled->count > 0;
    add("e omega of that, mm/s", {grade(none->bare.figures, none->bare.stalled > 0 && !none->bare.one, 0),
                                  grade(none->held.figures, none->held.stalled > 0, 0), grade(with, stall, 0),
                                  grade(with, stall, 1), grade(with, stall, 2)});
  }
  if (none)
    table.caption =
        fmt::format("No balls: {}. Balls held where they start: median of {}. With balls: median.",
                    none->bare.one ? one_run : fmt::format("median of {} runs", none->bare.runs), none->held.runs);
  else
    table.caption = "With balls: median.";
  const Unit length = unit_of(r.study, Dimension::length);
  if (limits.settled)
    table.caption += fmt::format(" Settled: displacement below {:.4g} {}.", *limits.settled * length.size, length.name);
  if (const double sag = -model::static_sag(r.study.parameters); sag != 0.0)
    table.caption += fmt::format(
        " Displacements are measured from where the rotor rests, {:.4g} {} below its unloaded springs; forces include "
        "its weight.",
        sag * length.size, length.name);
  return table;
}

std::vector<std::string> not_steady_words(const OneBodyRuns& body, const char* how, const Study& study) {
  std::vector<std::string> words;
  if (body.stalled > 0)
    words.push_back(
        fmt::format("{} the motor does not bring the rotor up to speed{}{}.", how, of_runs(body.stalled, body),
                    body.one && body.figures.mean_speed
                        ? ": it ends at " + engineering(study.scales, *body.figures.mean_speed, study::Dimension::speed)
                        : ""));
  if (body.open > 0)
    words.push_back(
        fmt::format("{} the rotor never settles into a steady motion{}: figures at the end are the last seen.", how,
                    of_runs(body.open, body)));
  if (body.lost > 0) words.push_back(fmt::format("{} the rotor's motion is lost{}.", how, of_runs(body.lost, body)));
  return words;
}

std::vector<std::string> without_balls_words(const BasinResult& r) {
  std::vector<std::string> words;
  const auto say = [&](const std::string& sentence) {
    if (!sentence.empty()) words.push_back(capitalised(sentence) + ".");
  };
  say(places_words(r));
  if (tells_without_balls(r))
    for (const auto figure : {&TransientRow::peak_radial, &TransientRow::rms_velocity})
      say(times_words(r.transients->groups.front(), r.without_balls->bare.figures, figure));
  say(bare_limit_words(r.without_balls->bare, r.study));
  for (const auto& [body, how] :
       {std::pair{&r.without_balls->bare, "Without balls"}, {&r.without_balls->held, "With balls held"}})
    for (std::string& sentence : not_steady_words(*body, how, r.study)) words.push_back(std::move(sentence));
  return words;
}

void to_json(Json& json, const PartOf<OneBodyRuns, Study>& of) {
  const auto& [body, study] = of;
  const TransientGroup& g = body.figures;
  Json figures = Json::object();
  for (std::size_t k = 0; k < transient_figures.size(); ++k) {
    const TransientFigure& f = transient_figures[k];
    if (!f.of_bare_rotor || (f.needs && !(study.limits.*f.needs))) continue;
    const Unit unit = unit_of(study, f.told_in());
    // One run has no interval.
    figures[f.name] = body.one ? object("unit", unit.name, "value", g.figures[k].quantiles[0].value * unit.size)
                               : with_unit(g.figures[k], unit);
  }
  const auto told = [one = body.one](const Share& s) { return one ? Json(s.count > 0) : sure(s); };
  json = object("runs", body.runs, "one_for_all", body.one, "stalled", body.stalled, "not_steady", body.open, "lost",
                body.lost, "figures", figures, "within", by_name(g.within, within_names, told), "exceeded",
                by_name(g.exceeded, transient_limits, told));
  if (g.starts > 0) put_known(json, "balance_grade", left_grade(g, study));
  put_known(json, "mean_speed", g.mean_speed);
}

void to_json(Json& json, const PartOf<WithoutBalls, Study>& of) {
  json = object("no_balls", PartOf{of.part.bare, of.whole});
  if (of.part.held.runs > 0) put(json, "balls_held", PartOf{of.part.held, of.whole});
}

namespace {

// Starts within all limits, a row each of Within; without rows if no limit is stated.
DocumentTable limits_table(const TransientGroup& group, const Study& study) {
  DocumentTable table{{"starts", "share", "95 % interval"}};
  const auto opens = [](const std::optional<Share>& s) { return s && (s->least < s->low || s->most > s->high); };
  const bool open = std::any_of(group.within.begin(), group.within.end(), opens);
  if (open) table.header.emplace_back("bounds");
  for (std::size_t k = 0; k < within_titles.size(); ++k) {
    if (!group.within[k]) continue;
    const Share& s = *group.within[k];
    table.rows.push_back({label_cell(within_titles[k]), share_cell(s), number_cell(interval(s))});
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
  if (study.limits.force) table.caption += " Forces at the end are RMS values.";
  return table;
}

}  // namespace

std::vector<Block> limits_blocks(const TransientGroup& group, const Study& study) {
  std::vector<Block> blocks;
  if (DocumentTable table = limits_table(group, study); !table.rows.empty()) blocks.push_back(std::move(table));
  if (const std::string words = clearance_words(group, study); !words.empty()) blocks.push_back(Paragraph{words});
  return blocks;
}

std::string clearance_words(const TransientGroup& group, const Study& study) {
  if (!study.limits.clearance) return "";
  std::size_t k = 0;
  while (transient_limits[k].limit != &Limits::clearance) ++k;
  if (!group.exceeded[k] || group.starts < fewest_for_figures) return "";
  const Unit unit = unit_of(study, Dimension::length);
  const auto share = [](const Share& s) { return fmt::format("{} of starts ({})", share_text(s), interval(s)); };
  const SampleSummary& end = group.figure(&TransientRow::peak_radial_at_end);
  const auto width = [&](double radius) { return fmt::format("{:.4g}", 2.0 * radius * unit.size); };
  return fmt::format(
      "The housing, {:.4g} {} away, is hit on the way by {}, in the end by {}. In the end the centre's path is at most "
      "{} {} wide in the median and {} {} in 90 % of starts, between walls {} {} apart.",
      *study.limits.clearance * unit.size, unit.name, share(*group.exceeded[k]), share(*group.exceeded_at_end[k]),
      width(end.quantiles[0].value), unit.name, width(end.quantiles[1].value), unit.name,
      width(*study.limits.clearance), unit.name);
}

std::optional<double> left_grade(const TransientGroup& group, const Study& study) {
  if (!is_graded(study)) return std::nullopt;
  const double mean = group.figure(&TransientRow::residual_unbalance).mean;
  const std::optional<double> speed = graded_speed(group, study);
  if (!speed) return std::nullopt;
  return grade_at(mean, *speed, study);
}

void add_transients(Document& document, const TransientResult& r, const Study& study) {
  const Unit length = unit_of(study, Dimension::length), time = unit_of(study, Dimension::time),
             force = unit_of(study, Dimension::force);
  for (const TransientGroup& group : r.groups)
    // A single outcome says everything.
    if (group.starts > 0 && !(!group.id && r.groups.size() == 2)) add_group(document, group, r, study);
  const bool undecided =
      std::any_of(r.groups.begin(), r.groups.end(), [](const auto& g) { return g.id == undecided_code; });
  document.add(Paragraph{fmt::format("\"At the end\": in the steady motion that a start ends in{}.",
                                     undecided ? fmt::format("; of an undecided start in its last window of {:.4g} {}",
                                                             r.settings.window * time.size, time.name)
                                               : "")});
  document.add(
      Paragraph{has_directions(study)
                    ? "RMS velocity: of both directions together; \"one direction\" is X or Y, whichever has more."
                    : "RMS velocity: of both directions together; one alone has about 0.71 of it."});
  const double sag = -model::static_sag(study.parameters);
  if (sag != 0.0)
    document.add(Paragraph{fmt::format(
        "Displacements are measured from where the rotor rests, {:.4g} {} below its unloaded springs; bearing forces "
        "include its weight, {:.4g} {}; dynamic forces are without what carries it there.",
        sag * length.size, length.name, model::total_weight(study.parameters) * force.size, force.name)});
  if (r.lost > 0) document.add(Paragraph{fmt::format("{} starts diverged or failed and are left out here.", r.lost)});
}

void to_json(Json& json, const PartOf<TransientGroup, PartOf<TransientResult, Study>>& of) {
  const TransientGroup& group = of.part;
  const auto& [r, study] = of.whole;
  json = object("name", group.name, "id", group.id, "starts", group.starts);
  for (std::size_t k = 0; k < transient_figures.size(); ++k) {
    const TransientFigure& f = transient_figures[k];
    if (!r.asks(f, study.limits)) continue;
    Json& figure = json["figures"][f.name] = with_unit(group.figures[k], unit_of(study, f.told_in()));
    if (f.needs) put(figure, "for_good", group.for_good(f));
  }
  put(json, "exceeded", by_name(group.exceeded, transient_limits, sure), "within",
      by_name(group.within, within_names, sure), "exceeded_at_end",
      by_name(group.exceeded_at_end, transient_limits, sure));
  put_known(json, "balance_grade", left_grade(group, study), "mean_speed", group.mean_speed);
}

void to_json(Json& json, const PartOf<TransientResult, Study>& of) {
  const auto& [r, study] = of;
  const Unit length = unit_of(study, Dimension::length), time = unit_of(study, Dimension::time);
  Json units, limits = Json::object();
  for (const TransientLimit& l : transient_limits) {
    units[l.name] = unit_of(study, l).name;
    if (const auto& limit = study.limits.*l.limit) limits[l.name] = *limit * unit_of(study, l).size;
  }
  put(units, "time", time.name, "energy", unit_of(study, Dimension::energy).name);
  if (r.settings.watches_settling()) put(limits, "settled", r.settings.settled * length.size);
  json = object("units", units, "window", r.settings.window * time.size, "static_sag",
                (0.0 - model::static_sag(study.parameters)) * length.size, "weight",
                (0.0 + model::total_weight(study.parameters)) * unit_of(study, Dimension::force).size);
  const WatchedShaft& shaft = r.settings.shaft;
  if (study.parameters.tilts())
    put(json, "places", std::array{shaft.places[0] * length.size, shaft.places[1] * length.size}, "force_of",
        shaft.bearings.empty() ? "supports" : "bearing");
  put(json, "limits", limits, "lost", r.lost, "groups", PartOf{r.groups, of});
}

}  // namespace equipoise
