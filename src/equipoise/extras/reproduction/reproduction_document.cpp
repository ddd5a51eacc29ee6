// The report, block by block.
#include "equipoise/extras/reproduction/reproduction_document.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include <fmt/format.h>

#include "equipoise/core/base/plural.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/extras/reproduction/reproduction_plots.hpp"
#include "equipoise/extras/reproduction/reproduction_words.hpp"
#include "equipoise/extras/words/paper_page.hpp"
#include "equipoise/report/drawing/plot_svg.hpp"
#include "equipoise/report/plots/map_drawing.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/report/words/pages.hpp"

namespace equipoise {

namespace {

using Answer = ConclusionResult::Answer;

DocumentCell text(const std::string& words, Tone tone = Tone::plain) { return {words, tone, false}; }
DocumentCell number(const std::string& words) { return {words, Tone::plain, true}; }

// A row's name, on one line where there is room.
DocumentCell label(const std::string& words) { return {words, Tone::plain, false, true}; }

DrawingRow pictured(const std::vector<Plot>& plots, const std::string& caption) {
  return drawn(plots, caption, caption, true);
}

Tone tone_of(Verdict verdict) {
  return verdict == Verdict::agrees ? Tone::good : verdict == Verdict::differs ? Tone::bad : Tone::open;
}

Tone tone_of(Answer answer) {
  constexpr std::array tones{Tone::good, Tone::bad, Tone::open, Tone::plain, Tone::plain};
  return tones[static_cast<std::size_t>(answer)];
}

void verdicts(const Reproduction& r, Document& d) {
  int agree = 0, differ = 0, rest = 0;
  DocumentTable table{
      {"table", "what", "agree", "differ", "not comparable", "p < 0.01", "by chance"}, {}, "", false, {5, 6}};
  for (const ReproducedTable& t : r.tables) {
    agree += t.agreeing;
    differ += t.differing;
    rest += t.not_comparable;
    table.rows.push_back({text(std::to_string(t.published->number)), text(t.published->title),
                          number(std::to_string(t.agreeing)), number(std::to_string(t.differing)),
                          number(std::to_string(t.not_comparable)), number(std::to_string(t.below_one_percent)),
                          number(fmt::format("{:.1f}", 0.01 * (t.agreeing + t.differing)))});
    table.rows.back()[2].tone = t.agreeing > 0 ? Tone::good : Tone::plain;
    table.rows.back()[3].tone = t.differing > 0 ? Tone::bad : Tone::plain;
    table.rows.back()[4].tone = t.not_comparable > 0 ? Tone::open : Tone::plain;
  }
  table.caption = words::paper::verdict_caption;
  if (r.tables.empty()) return;
  d.blocks.push_back(Heading{2, "Verdict", "verdict"});
  d.blocks.push_back(Paragraph{fmt::format(words::paper::verdict, agree, agree + differ, differ, differ == 1 ? "s" : "",
                                           rest, r.partial ? words::paper::verdict_partial : ""),
                               differ > 0 ? Tone::bad : Tone::good});
  d.blocks.push_back(std::move(table));
}

std::string fate_of(const ConclusionRow& row) {
  if (row.published.answer == Answer::not_asked || row.kinematic.answer == Answer::not_asked) return "one law only";
  if (row.published.answer == Answer::holds)
    return row.kinematic.answer == Answer::holds          ? "survives"
           : row.kinematic.answer == Answer::reversed     ? words::paper::opposite_by_kinematic_law
           : row.kinematic.answer == Answer::contradicted ? words::paper::rests_on_literal_angle
                                                          : words::paper::not_shown_by_kinematic_law;
  return row.kinematic.answer == Answer::holds ? words::paper::kinematic_law_only : words::paper::shown_by_neither_law;
}

void laws(const Reproduction& r, Document& d) {
  DocumentTable table{
      {words::paper::printed_numbers_say, "table", "published law", "kinematic law", "conclusion"}, {}, "", false, {1}};
  for (const ConclusionRow& row : r.conclusions) {
    if (row.published.answer == Answer::not_asked && row.kinematic.answer == Answer::not_asked) continue;
    table.rows.push_back({text(row.conclusion->text), text(std::to_string(row.conclusion->table)),
                          text(answer_text(row.published), tone_of(row.published.answer)),
                          text(answer_text(row.kinematic), tone_of(row.kinematic.answer)), text(fate_of(row))});
  }
  if (table.rows.empty()) return;
  table.caption = words::paper::laws_caption;
  d.blocks.push_back(Heading{2, words::paper::laws_title, "laws"});
  d.blocks.push_back(Paragraph{words::paper::laws_opening});
  d.blocks.push_back(std::move(table));
}

// The section on table 7: what a fit gives, and how little that proves.
void table_7_evidence(const Reproduction& r, Document& d) {
  d.blocks.push_back(Heading{3, words::paper::table_7_title, "table-7-evidence"});
  d.blocks.push_back(Paragraph{words::paper::table_7_opening});
  if (!r.table_7_lead.empty()) {
    DocumentTable table{{"T0, T1, T2", "printed", "best lead", "95 % interval"}, {}, "", false, {}};
    for (const LeadRow& row : r.table_7_lead)
      table.rows.push_back({label(row.label), number(fmt::format("{:.2f}", row.printed)),
                            number(percentage(row.balanced)), number(interval(row.balanced))});
    table.caption = fmt::format(words::paper::table_7_lead, r.table_7_lead.front().balanced.total);
    d.blocks.push_back(std::move(table));
  }
  DocumentTable table{
      {"protocol", "balanced if", "shares, %", "starts a row", "χ²", "free cells"}, {}, "", true, {3, 5}};
  for (const Table7Candidate& c : table_7_candidates())
    table.rows.push_back(
        {text(c.protocol), text(c.test),
         text(fmt::format("{:.2f}, {:.2f}, {:.2f}, {:.2f}", c.percent[0], c.percent[1], c.percent[2], c.percent[3])),
         number(std::to_string(c.starts)), number(fmt::format("{:.1f}", c.chi_squared)),
         number(std::to_string(c.free_cells))});
  table.caption = words::paper::table_7_fits;
  d.blocks.push_back(std::move(table));
}

void table_section(const Reproduction& r, const ReproducedTable& t, Document& d) {
  d.blocks.push_back(
      Heading{2, fmt::format("Table {}", t.published->number), fmt::format("table-{}", t.published->number)});
  std::string opening = fmt::format(words::paper::table_opening, t.published->title);
  opening.front() = static_cast<char>(std::toupper(opening.front()));
  d.blocks.push_back(Paragraph{opening});
  if (!t.published->unclaimed.empty())
    d.blocks.push_back(Paragraph{fmt::format("Not claimed: {}.", t.published->unclaimed), Tone::open});
  if (const auto plot = table_plot(t))
    d.blocks.push_back(pictured({*plot}, fmt::format(words::paper::table_figure, t.published->number)));
  DocumentTable table{{"row", "motion", "printed", "computed", "95 % interval", "p", "verdict"}, {}, "", false, {4, 5}};
  const bool kinematic = t.published->ramps;
  if (kinematic) {
    table.header.push_back("kinematic");
    table.header.push_back("kinematic − published (99 %)");
    table.spare.push_back(8);
  }
  for (const ReproducedRow& row : t.rows) {
    bool first = true;
    for (const ReproducedCell& c : row.cells) {
      if (is_idle(c) && c.verdict == Verdict::agrees) continue;
      const CellWords words = cell_words(row, c);
      table.rows.push_back({label(first ? row.published->label : ""), text(c.published->attractor),
                            number(words.printed), number(words.computed), number(words.interval),
                            number(words.p_value), text(name_of(c.verdict), tone_of(c.verdict))});
      if (kinematic) {
        table.rows.back().push_back(number(words.kinematic));
        const bool balanced = c.published->attractor == "balanced";
        table.rows.back().push_back(number(balanced && row.law_difference ? difference_text(*row.law_difference) : ""));
      }
      first = false;
    }
  }
  table.caption = fmt::format(words::paper::table_caption, t.agreeing, t.differing, t.not_comparable);
  for (const ReproducedRow& row : t.rows)
    if (const std::string& reason = row.cells.front().reason; !reason.empty() && reason != t.published->unclaimed)
      table.caption += fmt::format(" {} is not comparable: {}.", row.published->label, reason);
  for (const ReproducedRow& row : t.rows)
    if (!row.follow_up.empty()) table.caption += fmt::format(" {}.", row.follow_up);
  d.blocks.push_back(std::move(table));
  if (t.published->number == 7) table_7_evidence(r, d);
}

void open_questions(const Reproduction& r, Document& d) {
  if (!r.open) return;
  d.blocks.push_back(Heading{2, words::paper::questions_title, "future"});
  d.blocks.push_back(Paragraph{words::paper::questions_opening});
  const auto map = [&](const BasinSlice& m, const std::string& id, const std::string& title) {
    d.blocks.push_back(Heading{3, title, id});
    DrawingRow row = map_drawing(m);
    row.caption = fmt::format("{} × {} pixels: {}.", m.x.pixels, m.y.pixels, codes_text(m));
    d.blocks.push_back(std::move(row));
    if (std::string said = balanced_text(m); !said.empty()) d.blocks.push_back(Paragraph{std::move(said)});
  };
  map(r.open->eccentricity_and_angle, "future-eccentricity-angle", words::paper::basins_over_angle);
  map(r.open->eccentricity_and_mass, "future-eccentricity-mass", words::paper::plane_of_mass);
  d.blocks.push_back(Heading{3, words::paper::whole_state_space, "future-box"});
  d.blocks.push_back(Paragraph{words::paper::box_opening});
  d.blocks.push_back(pictured({plot_of_box(*r.open)}, words::paper::box_figure));
  DocumentTable table{{"Ω", "motion", "box, %", "95 % interval", "at rest, %", "95 % interval"}, {}, "", false, {3, 5}};
  for (const BoxShares& b : r.open->boxes)
    for (const OutcomeShare& a : b.box.attractors) {
      const auto same = [&](const OutcomeShare& other) { return other.name == a.name; };
      const auto at = std::find_if(b.rest.attractors.begin(), b.rest.attractors.end(), same);
      const Share rest = at == b.rest.attractors.end() ? wilson_share(0, b.rest.starts) : at->share;
      table.rows.push_back({number(fmt::format("{}", b.speed)), text(title_of(a)), number(percentage(a.share)),
                            number(interval(a.share)), number(percentage(rest)), number(interval(rest))});
    }
  if (!r.open->boxes.empty())
    table.caption = fmt::format("{} starts a sample; undecided: {}.", r.open->boxes.front().box.starts,
                                interval(r.open->boxes.front().box.undecided));
  d.blocks.push_back(std::move(table));
}

void figures(const Reproduction& r, Document& d) {
  if (r.figures.empty()) return;
  d.blocks.push_back(Heading{2, "Figures", "figures"});
  for (const PaperFigure& f : r.figures) {
    d.blocks.push_back(Heading{3, f.title, f.id});
    if (!f.choice.empty()) d.blocks.push_back(Paragraph{f.choice, Tone::open});
    d.blocks.push_back(pictured(figure_plots(f), f.caption));
  }
}

void ensemble_row(DocumentTable& table, const ReproducedRow& row, const std::optional<EnsembleResult>& e, bool ramps,
                  const char* law, const std::string& explorer) {
  if (!e) return;
  const auto lost = e->lost();
  DocumentCell study = text(row.published->study);
  // The same address as the explorer writes (web/src/setting/setting.ts).
  if (!explorer.empty())
    study.link = fmt::format("{}#study={}{}", explorer, row.published->study,
                             ramps ? fmt::format("&set=speed.law%3D{}", law) : "");
  table.rows.push_back({std::move(study), text(ramps ? law : "constant speed"), number(std::to_string(e->starts)),
                        number(e->starts ? interval(e->undecided) : "-"), number(std::to_string(lost)),
                        number(std::to_string(e->seed)), number(fmt::format("{:.1f}", e->cpu_seconds)),
                        text(fmt::format("equipoise basin studies/paper/{}.toml --starts {}{}", row.published->study,
                                         e->starts, ramps ? fmt::format(" --set speed.law={}", law) : ""))});
}

void settings(const Reproduction& r, const std::string& explorer, Document& d) {
  d.blocks.push_back(Heading{2, "Settings", "settings"});
  d.blocks.push_back(Paragraph{fmt::format("Made by: {}", r.command)});
  d.blocks.push_back(
      Paragraph{fmt::format(words::paper::cost_of_page, version_string, r.threads, plural(r.threads), r.cpu_target,
                            r.ensembles, r.starts, r.seconds, r.cpu_seconds, r.run_seconds, r.run_cpu_seconds)});
  d.blocks.push_back(Paragraph{words::paper::settings});
  DocumentTable table{
      {"study", "law", "starts", "undecided (95 %)", "lost", "seed", "CPU s", "command"}, {}, "", true, {4, 5}};
  table.caption = words::paper::every_ensemble;
  if (!explorer.empty()) table.caption += words::paper::links_to_explorer;
  for (const ReproducedTable& t : r.tables)
    for (const ReproducedRow& row : t.rows) {
      ensemble_row(table, row, row.by_published_law, t.published->ramps, "published", explorer);
      ensemble_row(table, row, row.by_kinematic_law, t.published->ramps, "kinematic", explorer);
    }
  if (!table.rows.empty()) d.blocks.push_back(std::move(table));
  d.blocks.push_back(Paragraph{fmt::format(words::paper::numbers_from, published_citation)});
}

}  // namespace

Document reproduction_document(const Reproduction& r, const std::string& explorer) {
  Document d{words::paper::page_title, {}};
  d.blocks.push_back(Paragraph{words::paper::page_opening});
  verdicts(r, d);
  laws(r, d);
  for (const ReproducedTable& t : r.tables) table_section(r, t, d);
  figures(r, d);
  open_questions(r, d);
  settings(r, explorer, d);
  return d;
}

}  // namespace equipoise
