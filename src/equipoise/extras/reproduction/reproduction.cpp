// The reproduced paper as text for the terminal and as JSON.
#include "equipoise/extras/reproduction/reproduction.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "equipoise/core/base/plural.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/extras/reproduction/reproduction_document.hpp"
#include "equipoise/report/reports/basin_report.hpp"
#include "equipoise/report/text/text.hpp"

namespace equipoise {

namespace {

using Json = nlohmann::ordered_json;

Json with_share(Json json, const Share& share) {
  json.update(share_json(share));
  return json;
}

Json ensemble_json(const std::optional<EnsembleResult>& e) {
  if (!e) return nullptr;
  Json outcomes = Json::array();
  for (const OutcomeShare& line : e->attractors)
    outcomes.push_back(with_share({{"name", line.name}, {"alias", line.alias}}, line.share));
  return {{"starts", e->starts},
          {"seed", e->study.sampling.seed},
          {"complete", !e->partial},
          {"outcomes", outcomes},
          {"undecided", share_json(e->undecided)},
          {"diverged", share_json(e->diverged)},
          {"failed", share_json(e->failed)},
          {"seconds", e->seconds},
          {"cpu_seconds", e->cpu_seconds}};
}

Json difference_json(const ShareDifference& d) {
  return {{"difference", d.difference}, {"low", d.low}, {"high", d.high}};
}

Json cell_json(const ReproducedCell& c) {
  return {{"attractor", c.published->attractor},   {"printed", c.published->printed},
          {"published", c.published->share.share}, {"published_starts", c.published->share.starts},
          {"computed", share_json(c.computed)},    {"p_value", c.p_value},
          {"verdict", name_of(c.verdict)},         {"reason", c.reason}};
}

Json table_json(const ReproducedTable& t) {
  Json rows = Json::array();
  for (const ReproducedRow& row : t.rows) {
    Json cells = Json::array();
    for (const ReproducedCell& c : row.cells) cells.push_back(cell_json(c));
    rows.push_back(
        {{"row", row.published->label},
         {"study", row.published->study + ".toml"},
         {"slip", row.published->slip},
         {"follow_up", row.follow_up},
         {"cells", cells},
         {"published_law", ensemble_json(row.by_published_law)},
         {"kinematic_law", ensemble_json(row.by_kinematic_law)},
         {"kinematic_minus_published", row.law_difference ? difference_json(*row.law_difference) : Json(nullptr)}});
  }
  return {{"table", t.published->number},
          {"title", t.published->title},
          {"agrees", t.agreeing},
          {"differs", t.differing},
          {"not_comparable", t.not_comparable},
          {"p_value_limit", t.single_limit},
          {"rows", rows}};
}

Json map_json(const BasinSlice& map) {
  Json codes = Json::array();
  for (const OutcomeShare& c : map.codes) codes.push_back(with_share({{"name", c.name}, {"alias", c.alias}}, c.share));
  return {{"x", map.x.key}, {"y", map.y.key}, {"pixels", {map.x.pixels, map.y.pixels}}, {"outcomes", codes}};
}

Json open_json(const OpenQuestions& open) {
  Json boxes = Json::array();
  for (const BoxShares& b : open.boxes)
    boxes.push_back(
        {{"speed", b.speed}, {"box", Json::parse(basin_json(b.box))}, {"rest", Json::parse(basin_json(b.rest))}});
  return {{"maps", {map_json(open.eccentricity_and_angle), map_json(open.eccentricity_and_mass)}}, {"boxes", boxes}};
}

Json answer_json(const ConclusionResult& c) {
  Json differences = Json::array();
  for (const ShareDifference& d : c.differences) differences.push_back(difference_json(d));
  return {{"answer", name_of(c.answer)}, {"differences", differences}};
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
  Json tables = Json::array(), conclusions = Json::array(), pictures = Json::array();
  for (const ReproducedTable& t : r.tables) tables.push_back(table_json(t));
  for (const ConclusionRow& c : r.conclusions)
    conclusions.push_back({{"conclusion", c.conclusion->text},
                           {"table", c.conclusion->table},
                           {"published_law", answer_json(c.published)},
                           {"kinematic_law", answer_json(c.kinematic)}});
  for (const Picture& p : r.pictures) pictures.push_back({{"id", p.id}, {"title", p.title}, {"path", p.path}});
  Json lead = Json::array();
  for (const LeadReading& reading : r.table_7_lead)
    lead.push_back(with_share({{"row", reading.row.label()}, {"printed", reading.row.printed}}, reading.balanced));
  const Json json{{"command", r.command},
                  {"version", version_string},
                  {"citation", published_citation},
                  {"partial", r.partial},
                  {"differs", r.differs()},
                  {"tables", tables},
                  {"table_7_lead", lead},
                  {"conclusions", conclusions},
                  {"open_questions", r.open ? open_json(*r.open) : Json(nullptr)},
                  {"pictures", pictures},
                  {"run_seconds", r.run_seconds},
                  {"run_cpu_seconds", r.run_cpu_seconds},
                  {"ensembles", r.ensembles},
                  {"starts", r.starts},
                  {"seconds", r.seconds},
                  {"cpu_seconds", r.cpu_seconds},
                  {"threads", r.threads},
                  {"cpu_target", r.cpu_target}};
  return json.dump(2) + "\n";
}

}  // namespace equipoise
