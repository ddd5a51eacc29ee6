// The reproduced paper as text for the terminal and as JSON, and the words that its page shares.
#include "equipoise/extras/reproduction/reproduction_document.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/plural.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/results/types/fate.hpp"

namespace equipoise {

std::string percentage(const Share& s) {
  const double value = 100.0 * s.share;
  const int digits = s.count == 0 || value >= 0.1 ? 2 : value >= 0.01 ? 3 : value >= 0.001 ? 4 : 5;
  return fmt::format("{:.{}f}", value, digits);
}

CellWords cell_words(const ReproducedRow& row, const ReproducedCell& cell) {
  const double printed = 100.0 * cell.published->share.share, p = cell.p_value;
  CellWords words{fmt::format("{:.{}f}", printed, printed > 0.0 && printed < 0.01 ? 3 : 2), "-", "-", "-", ""};
  if (cell.published->fraction) words.printed = fmt::format("{:.2g}*", printed);
  if (row.by_published_law && row.by_published_law->starts > 0) {
    words.computed = percentage(cell.computed);
    words.interval = interval(cell.computed);
    words.p_value = p < 1e-12 ? "< 1e-12" : p < 1e-4 ? fmt::format("{:.0e}", p) : fmt::format("{:.4f}", p);
  }
  if (row.by_kinematic_law && row.by_kinematic_law->starts > 0)
    words.kinematic = percentage(row.by_kinematic_law->share_of(cell.published->attractor));
  return words;
}

bool is_idle(const ReproducedCell& c) {
  return c.published->share.share == 0.0 && c.computed.count == 0 && c.published->attractor != "balanced";
}

std::string difference_text(const ShareDifference& d) {
  return fmt::format("{:+.2f} ({:+.2f} to {:+.2f})", 100.0 * d.difference, 100.0 * d.low, 100.0 * d.high);
}

std::string answer_text(const ConclusionResult& c) {
  if (c.differences.empty()) return name_of(c.answer);
  const auto [least, most] =
      std::minmax_element(c.differences.begin(), c.differences.end(),
                          [](const auto& a, const auto& b) { return a.difference < b.difference; });
  if (c.differences.size() == 1) return fmt::format("{}: {}", name_of(c.answer), difference_text(*least));
  return fmt::format("{}: from {} to {}", name_of(c.answer), difference_text(*least), difference_text(*most));
}

CellCounts all_cells(const Reproduction& r) {
  CellCounts all;
  for (const ReproducedTable& t : r.tables) {
    all.agreeing += t.agreeing;
    all.differing += t.differing;
    all.not_comparable += t.not_comparable;
  }
  return all;
}

std::string codes_text(const BasinSlice& map) {
  std::vector<OutcomeShare> codes = map.codes;
  std::stable_sort(codes.begin(), codes.end(),
                   [](const OutcomeShare& a, const OutcomeShare& b) { return a.share.count > b.share.count; });
  std::string list;
  for (const OutcomeShare& c : codes)
    if (c.share.count > 0)
      list += fmt::format("{}{} {:.1f} %", list.empty() ? "" : ", ", title_of(c), 100.0 * c.share.share);
  return list;
}

namespace {

// "at lambda from 0.002 to 0.026 and from 0.09 to 0.1": the stretches of columns of which `holds` is true.
std::string at_eccentricities(const SliceAxis& x, const std::function<bool(int)>& holds) {
  std::string text;
  for (int k = 0; k < x.pixels; ++k) {
    if (!holds(k)) continue;
    const int first = k;
    while (k + 1 < x.pixels && holds(k + 1)) ++k;
    text += fmt::format("{}{:.3g} to {:.3g}", text.empty() ? "at λ from " : " and from ", x.centre(first), x.centre(k));
  }
  return text.empty() ? "at no λ" : text;
}

std::string balanced_by_angle(const BasinSlice& map) {
  const auto at_least = [&](int least) {
    return at_eccentricities(map.x, [&map, least](int column) {
      int balanced = 0;
      for (int row = 0; row < map.y.pixels; ++row) balanced += map.code[map.at(column, row)] == balanced_id;
      return balanced >= least;
    });
  };
  return fmt::format("All starts balance {}, some {}. The balls can cancel λ up to {:.3g}.", at_least(map.y.pixels),
                     at_least(1), map.study.parameters.total_mass());
}

// How much of what all balls together can cancel is balanced, and whether anything balances beyond.
std::string balanced_by_mass(const BasinSlice& map) {
  const int balls = map.study.parameters.balls;
  std::vector<std::pair<double, double>> ends;  // as a part of what they can cancel; mu
  int again = 0;
  for (int row = 0; row < map.y.pixels; ++row) {
    // An undecided pixel ends no stretch.
    const auto code = [&](int column) { return map.code[map.at(column, row)]; };
    int last = -1;
    bool ended = false, returns = false;
    for (int column = 0; column < map.x.pixels; ++column) {
      const bool balanced = code(column) == balanced_id;
      returns = returns || (ended && balanced);
      if (balanced && !ended) last = column;
      ended = ended || (last >= 0 && !balanced && code(column) != undecided_code);
    }
    if (!ended) continue;
    ends.emplace_back(map.x.centre(last) / (balls * map.y.centre(row)), map.y.centre(row));
    again += returns;
  }
  if (ends.empty()) return "No row of one μ shows where balance ends.";
  const auto [least, most] = std::minmax_element(ends.begin(), ends.end());
  return fmt::format(
      "As λ grows starts cease to balance at {:.2f} (μ = {:.3g}) to {:.2f} (μ = {:.3g}) of the {} μ that the balls can "
      "cancel; in {} of {} rows some balance again beyond.",
      least->first, least->second, most->first, most->second, balls, again, ends.size());
}

}  // namespace

std::string balanced_text(const BasinSlice& map) {
  if (!map.complete) return "";
  return map.y.angle() ? balanced_by_angle(map) : balanced_by_mass(map);
}

namespace {

Json with_share(Json json, const Share& share) {
  json.update(Json(share));
  return json;
}

Json ensemble_json(const EnsembleResult& e) {
  const auto outcome = [](const OutcomeShare& line) {
    return with_share(object("name", line.name, "alias", line.alias), line.share);
  };
  return object("starts", e.starts, "seed", e.study.sampling.seed, "complete", !e.partial, "outcomes",
                list_of(e.attractors, outcome), "undecided", e.undecided, "diverged", e.diverged, "failed", e.failed,
                "seconds", e.seconds, "cpu_seconds", e.cpu_seconds);
}

Json row_json(const ReproducedRow& row) {
  const auto cell = [](const ReproducedCell& c) {
    return object("attractor", c.published->attractor, "printed", c.published->printed, "published",
                  c.published->share.share, "published_starts", c.published->share.starts, "computed", c.computed,
                  "p_value", c.p_value, "verdict", name_of(c.verdict), "reason", c.reason);
  };
  const auto ensemble = [](const std::optional<EnsembleResult>& e) { return e ? ensemble_json(*e) : Json(); };
  return object("row", row.published->label, "study", row.published->study + ".toml", "slip", row.published->slip,
                "follow_up", row.follow_up, "cells", list_of(row.cells, cell), "published_law",
                ensemble(row.by_published_law), "kinematic_law", ensemble(row.by_kinematic_law),
                "kinematic_minus_published", row.law_difference);
}

Json table_json(const ReproducedTable& t) {
  return object("table", t.published->number, "title", t.published->title, "agrees", t.agreeing, "differs", t.differing,
                "not_comparable", t.not_comparable, "p_value_limit", t.single_limit, "rows", list_of(t.rows, row_json));
}

Json plane_json(const BasinSlice& map) {
  const auto code = [](const OutcomeShare& c) { return with_share(object("name", c.name, "alias", c.alias), c.share); };
  return object("x", map.x.key, "y", map.y.key, "pixels", std::array{map.x.pixels, map.y.pixels}, "outcomes",
                list_of(map.codes, code));
}

Json open_json(const OpenQuestions& open) {
  const auto box = [](const BoxShares& b) {
    return object("speed", b.speed, "box", Json::parse(basin_json(b.box)), "rest", Json::parse(basin_json(b.rest)));
  };
  return object("maps", std::array{plane_json(open.eccentricity_and_angle), plane_json(open.eccentricity_and_mass)},
                "boxes", list_of(open.boxes, box));
}

// Columns of a table's text. Verdicts, and shares under the other law without a column, stand below a narrow line.
struct CellColumns {
  std::size_t label = 26, printed = 9, computed = 9, interval = 20;
  bool kinematic = true, below = false;

  CellColumns(const ReproducedTable& t, const TextStyle& style) {
    if (style.width == 0) return;
    label = 0;
    for (const ReproducedRow& row : t.rows) label = std::max(label, row.published->label.size() + 2);
    printed = 7, computed = 8, interval = 19;
    kinematic = t.published->ramps && line("", "", "", "", "", "", "").size() <= style.width;
    below = true;
  }
  std::string line(const std::string& row, const std::string& motion, const std::string& print, const std::string& own,
                   const std::string& between, const std::string& p, const std::string& other) const {
    return fmt::format("{:<{}}{:<9}{:>{}} {:>{}}  {:<{}}{:>8}{:>{}}", row, label, motion, print, printed, own, computed,
                       between, interval, p, kinematic ? other : "", kinematic ? 10 : 0);
  }
};

// "differs", "not comparable: the printed row sums to 100.07".
std::string verdict_text(const ReproducedCell& cell) {
  if (cell.reason.empty()) return name_of(cell.verdict);
  return fmt::format("{}: {}", name_of(cell.verdict), cell.reason);
}

std::string cell_line(const ReproducedRow& row, const ReproducedCell& c, bool first, const CellColumns& columns,
                      const TextStyle& style) {
  const CellWords cell = cell_words(row, c);
  const std::string line = columns.line(first ? row.published->label : "", c.published->attractor, cell.printed,
                                        cell.computed, cell.interval, cell.p_value, cell.kinematic);
  const std::string verdict = c.verdict == Verdict::agrees ? "" : verdict_text(c);
  if (!columns.below) return fmt::format("{}  {}\n", line, verdict);
  std::string below = columns.kinematic || !row.by_kinematic_law ? "" : fmt::format("kinematic law {}", cell.kinematic);
  if (!verdict.empty()) below += (below.empty() ? "" : "; ") + verdict;
  return line + "\n" + (below.empty() ? "" : filled(std::string(columns.label, ' '), below, style));
}

std::string table_text(const ReproducedTable& t, const TextStyle& style) {
  std::string text = fmt::format("Table {}: {}\n", t.published->number, t.published->title);
  const CellColumns columns(t, style);
  text += columns.line("row", "motion", "printed", "computed", "95 % interval", "p",
                       t.published->ramps ? "kinematic" : "") +
          "\n";
  std::uint64_t undecided = 0, lost = 0, starts = 0;
  for (const ReproducedRow& row : t.rows) {
    bool first = true;
    for (const ReproducedCell& c : row.cells) {
      if (is_idle(c)) continue;
      text += cell_line(row, c, first, columns, style);
      first = false;
    }
    row.for_each_law([&](const EnsembleResult& e, model::SpeedLaw) {
      undecided += e.undecided.count;
      lost += e.lost();
      starts += e.starts;
    });
  }
  text += fmt::format(
      "{} cells agree, {} differ{}, {} not comparable; {} of the judged below p = 0.01 ({:.1f} expected by chance). {} "
      "starts, {} undecided, {} lost.\n\n",
      t.agreeing, t.differing, t.differing == 1 ? "s" : "", t.not_comparable, t.below_one_percent,
      0.01 * (t.agreeing + t.differing), starts, undecided, lost);
  return text;
}

// One line per table: cells agreeing, differing, not comparable.
std::string summary_text(const Reproduction& r) {
  const auto line = [](const std::string& name, const auto& agree, const auto& differ, const auto& rest) {
    return fmt::format("{:<10}{:>8}{:>9}{:>16}\n", name, agree, differ, rest);
  };
  std::string text = line("", "agree", "differ", "not comparable");
  for (const ReproducedTable& t : r.tables)
    text += line(fmt::format("table {}", t.published->number), t.agreeing, t.differing, t.not_comparable);
  const CellCounts all = all_cells(r);
  text += line("all", all.agreeing, all.differing, all.not_comparable);
  return text + "Judged jointly over each table at 99 % by the errors of both samples, under the published law.\n";
}

std::string lead_text(const Reproduction& r) {
  if (r.table_7_lead.empty()) return "";
  std::string text =
      "Table 7, the best lead (docs/evidence/table-7.md; fitted to the printed shares, not claimed): kinematic law, "
      "balls released at 2.2, balanced if r < 0.00134 from t = 630 to 730\n";
  for (const LeadReading& lead : r.table_7_lead)
    text += fmt::format("  {:<22}{:>9.2f} {:>9}  {:<20}\n", lead.row.label(), lead.row.printed,
                        percentage(lead.balanced), interval(lead.balanced));
  return text + "\n";
}

std::string open_text(const OpenQuestions& open) {
  std::string text = "Open questions: balanced share of starts in a box of the whole state space, and at rest\n";
  for (const BoxShares& b : open.boxes) {
    const Share box = b.box.attractors.front().share, rest = b.rest.attractors.front().share;
    text += fmt::format("  Omega {:<4} box {:>6} ({}), at rest {:>6} ({})\n", b.speed, percentage(box), interval(box),
                        percentage(rest), interval(rest));
  }
  for (const auto& [name, map] :
       {std::pair{"(lambda, phi_1)", &open.eccentricity_and_angle}, {"(lambda, mu)", &open.eccentricity_and_mass}}) {
    text += fmt::format("  plane {}, {} x {} pixels: {}\n", name, map->x.pixels, map->y.pixels, codes_text(*map));
    if (const std::string said = balanced_text(*map); !said.empty()) text += fmt::format("    {}\n", said);
  }
  return text + "\n";
}

std::string conclusions_text(const Reproduction& r) {
  std::string text;
  for (const ConclusionRow& row : r.conclusions) {
    if (!row.asked()) continue;
    text += fmt::format("  {} (table {}).\n    published law: {}; kinematic law: {}\n", row.conclusion->text,
                        row.conclusion->table, answer_text(row.published), answer_text(row.kinematic));
  }
  return text.empty() ? ""
                      : fmt::format(
                            "What the printed numbers say, asked of both speed laws (differences of balanced shares in "
                            "points, 99 %, common starts):\n{}\n",
                            text);
}

}  // namespace

bool Reproduction::differs() const { return all_cells(*this).differing > 0; }

std::string reproduction_text(const Reproduction& r, const TextStyle& style) {
  std::string text;
  for (const ReproducedTable& t : r.tables) text += table_text(t, style);
  text += lead_text(r) + conclusions_text(r);
  if (r.open) text += open_text(*r.open);
  if (!r.tables.empty()) {
    text += summary_text(r);
    text += fmt::format("{} ensembles, {} starts: {:.0f} s, {:.0f} s CPU on {} thread{} ({}).\n", r.ensembles, r.starts,
                        r.seconds, r.cpu_seconds, r.threads, plural(r.threads), r.cpu_target);
  }
  text += fmt::format("This run, all else included: {:.0f} s, {:.0f} s CPU; equipoise {}\n", r.run_seconds,
                      r.run_cpu_seconds, version_string);
  for (const Picture& p : r.pictures) text += fmt::format("{}: {}\n", p.title, p.path);
  if (r.partial) text += "PARTIAL: stopped before all was done.\n";
  return style.width > 0 ? lines_filled(text, style) : text;
}

std::string reproduction_json(const Reproduction& r) {
  const auto answer = [](const ConclusionResult& c) {
    return object("answer", name_of(c.answer), "differences", c.differences);
  };
  const auto conclusion = [&](const ConclusionRow& c) {
    return object("conclusion", c.conclusion->text, "table", c.conclusion->table, "published_law", answer(c.published),
                  "kinematic_law", answer(c.kinematic));
  };
  const auto lead = [](const LeadReading& reading) {
    return with_share(object("row", reading.row.label(), "printed", reading.row.printed), reading.balanced);
  };
  const auto picture = [](const Picture& p) { return object("id", p.id, "title", p.title, "path", p.path); };
  return object("command", r.command, "version", version_string, "citation", published_citation, "partial", r.partial,
                "differs", r.differs(), "tables", list_of(r.tables, table_json), "table_7_lead",
                list_of(r.table_7_lead, lead), "conclusions", list_of(r.conclusions, conclusion), "open_questions",
                r.open ? open_json(*r.open) : Json(), "pictures", list_of(r.pictures, picture), "run_seconds",
                r.run_seconds, "run_cpu_seconds", r.run_cpu_seconds, "ensembles", r.ensembles, "starts", r.starts,
                "seconds", r.seconds, "cpu_seconds", r.cpu_seconds, "threads", r.threads, "cpu_target", r.cpu_target)
             .dump(2) +
         "\n";
}

}  // namespace equipoise
