// Rows computed one after another, each judged by both sides' errors.
#include "equipoise/extras/publications/publication_verdicts.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/extras/words/publications.hpp"

namespace equipoise {

namespace {

constexpr std::size_t width = 80;

std::string name_of_source(KnownBy known_by) { return known_by_names[static_cast<std::size_t>(known_by)]; }

std::string with_error(const Estimate& e, const char* unit) {
  std::string text = fmt::format("{:.5g}", e.value);
  if (e.error >= 100.0)
    text += fmt::format(" ± {:.0f}", e.error);
  else if (e.error > 0.0)
    text += e.error < 1.0 ? fmt::format(" ± {:.1g}", e.error) : fmt::format(" ± {:.2g}", e.error);
  return *unit ? text + " " + unit : text;
}

// Words into lines of at most 80 columns, each after this many blanks.
std::string filled(const std::string& text, std::size_t indent) {
  std::string lines, line;
  const auto flush = [&] {
    lines += std::string(indent, ' ') + line + "\n";
    line.clear();
  };
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (!line.empty() && indent + line.size() + 1 + word.size() > width) flush();
    line += (line.empty() ? "" : " ") + word;
    begin = end + 1;
  }
  if (!line.empty()) flush();
  return lines;
}

std::string settings_text(const PublicationRow& row) {
  std::string settings = fmt::format("{}", fmt::join(row.settings, ", "));
  if (!row.study) return settings;
  return settings.empty() ? row.study : row.study + (": " + settings);
}

std::string row_text(const JudgedRow& r) {
  const PublicationRow& row = *r.row;
  std::string heading = fmt::format("{}: {}", row.place, row.quantity);
  if (const std::string settings = settings_text(row); !settings.empty()) heading += " (" + settings + ")";
  std::string text = filled(heading, 2);
  const bool computed = r.verdict != RowVerdict::not_computed;
  text += fmt::format("    {:<9}{:<23}{:<5}{:<23}{}\n", name_of_source(row.known_by), with_error(r.published, row.unit),
                      computed ? "here" : "", computed ? with_error(r.computed, row.unit) : "", name_of(r.verdict));
  if (r.verdict == RowVerdict::explained || !computed) text += filled(row.reason, 6);
  return text;
}

std::string tally(const JudgedPublications& r) {
  const int agree = r.count(RowVerdict::agrees), explained = r.count(RowVerdict::explained);
  const int differ = r.count(RowVerdict::differs) + explained;
  const std::string known = differ == 0           ? ""
                            : explained == differ ? words::publications::all_explained
                                                  : fmt::format(words::publications::some_explained, explained);
  std::string text =
      fmt::format(words::publications::tally, agree, agree + differ, differ, known, r.count(RowVerdict::not_computed));
  if (!r.partial) return text;
  std::size_t judged = 0, all = 0;
  for (const JudgedPublication& p : r.list) judged += p.rows.size(), all += p.publication->rows.size();
  return text + fmt::format(words::publications::partial, all - judged, all);
}

}  // namespace

int JudgedPublications::count(RowVerdict verdict) const {
  int sum = 0;
  for (const JudgedPublication& p : list)
    sum += static_cast<int>(
        std::count_if(p.rows.begin(), p.rows.end(), [&](const JudgedRow& r) { return r.verdict == verdict; }));
  return sum;
}

RowVerdict judged(const Estimate& published, const Estimate& computed, const PublicationRow& row) {
  if (std::fabs(published.value - computed.value) <= published.error + computed.error) return RowVerdict::agrees;
  return *row.reason ? RowVerdict::explained : RowVerdict::differs;
}

JudgedPublications judge_publications(const std::vector<std::string>& names, const RunOptions& options) {
  JudgedPublications result;
  Progress progress;
  for (const std::string& name : names) {
    const Publication* publication = find_publication(name);
    if (!publication) {
      std::vector<std::string> known;
      for (const Publication& p : publications()) known.emplace_back(p.name);
      throw InputError("reproduce", "", name, fmt::format(words::publications::unknown, fmt::join(known, ", ")));
    }
    result.list.push_back({publication, {}});
    progress.total += publication->rows.size();
  }
  for (JudgedPublication& p : result.list)
    for (const PublicationRow& row : p.publication->rows) {
      progress.what = fmt::format("{}, {}", p.publication->name, row.place);
      if (options.progress) options.progress(progress);
      JudgedRow r{&row, row.published, {}, RowVerdict::not_computed};
      if (row.computed) {
        const Study study = study_of(*p.publication, row);
        if (row.formula) r.published = row.formula(study);
        r.computed = row.computed(study, options);
        if (is_set(options.stop)) {
          result.partial = true;
          return result;
        }
        r.verdict = judged(r.published, r.computed, row);
      }
      p.rows.push_back(r);
      ++progress.done;
    }
  if (options.progress) options.progress(progress);
  return result;
}

std::string publications_text(const JudgedPublications& r) {
  std::string text;
  for (const JudgedPublication& p : r.list) {
    text += fmt::format("{} ({})\n", p.publication->title, p.publication->name);
    text += filled(fmt::format(words::publications::seen, p.publication->seen), 2);
    for (const JudgedRow& row : p.rows) text += row_text(row);
    text += "\n";
  }
  return text + filled(tally(r), 0);
}

std::string publications_json(const JudgedPublications& r) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  const auto estimate = [](const Estimate& e) { return Json{{"value", e.value}, {"error", e.error}}; };
  for (const JudgedPublication& p : r.list) {
    Json symbols = Json::array(), rows = Json::array();
    for (const SymbolMapping& s : p.publication->symbols) symbols.push_back({{"theirs", s.theirs}, {"ours", s.ours}});
    for (const JudgedRow& row : p.rows)
      rows.push_back({{"place", row.row->place},
                      {"quantity", row.row->quantity},
                      {"unit", row.row->unit},
                      {"known_by", name_of_source(row.row->known_by)},
                      {"study", row.row->study ? row.row->study : p.publication->study},
                      {"settings", row.row->settings},
                      {"published", estimate(row.published)},
                      {"computed", row.verdict == RowVerdict::not_computed ? Json(nullptr) : estimate(row.computed)},
                      {"verdict", name_of(row.verdict)},
                      {"reason", row.row->reason}});
    list.push_back({{"name", p.publication->name},
                    {"title", p.publication->title},
                    {"citation", p.publication->citation},
                    {"read", p.publication->seen},
                    {"study", p.publication->study},
                    {"symbols", symbols},
                    {"rows", rows}});
  }
  const Json json{{"command", r.command},
                  {"version", version_string},
                  {"partial", r.partial},
                  {"differs", r.differs()},
                  {"publications", list}};
  return json.dump(2) + "\n";
}

Document publications_document(const JudgedPublications& r) {
  constexpr std::array tones{Tone::good, Tone::bad, Tone::open, Tone::plain};
  Document d;
  d.title = words::publications::page_title;
  d.blocks.push_back(Paragraph{tally(r), r.differs() ? Tone::bad : Tone::good});
  d.blocks.push_back(Paragraph{words::publications::page_note});
  for (const JudgedPublication& p : r.list) {
    d.blocks.push_back(Heading{2, p.publication->title, p.publication->name});
    d.blocks.push_back(Paragraph{std::string(p.publication->citation) + "."});
    d.blocks.push_back(Paragraph{fmt::format(words::publications::seen, p.publication->seen) + "."});
    DocumentTable symbols{{"theirs", "in a study"}, {}, "", false, {}};
    for (const SymbolMapping& s : p.publication->symbols) symbols.rows.push_back(row_of("tt", {s.theirs, s.ours}));
    d.blocks.push_back(std::move(symbols));
    DocumentTable table{{"where", "quantity", "settings", "published", "by", "here", "verdict"}, {}, "", false, {2}};
    for (const JudgedRow& row : p.rows) {
      const bool computed = row.verdict != RowVerdict::not_computed;
      std::string verdict = name_of(row.verdict);
      if (!computed || row.verdict == RowVerdict::explained) verdict += std::string(": ") + row.row->reason;
      table.rows.push_back(row_of(
          "lttntnt",
          {row.row->place, row.row->quantity, settings_text(*row.row), with_error(row.published, row.row->unit),
           name_of_source(row.row->known_by), computed ? with_error(row.computed, row.row->unit) : "", verdict}));
      table.rows.back().back().tone = tones[static_cast<std::size_t>(row.verdict)];
    }
    d.blocks.push_back(std::move(table));
    if (*p.publication->study)
      d.blocks.push_back(Paragraph{fmt::format(words::publications::study_file,
                                               fmt::format("studies/publications/{}.toml", p.publication->study))});
  }
  d.blocks.push_back(Paragraph{fmt::format(words::publications::made_by, r.command)});
  return d;
}

std::string publications_list(const std::vector<std::string>& parts) {
  std::string text =
      fmt::format(words::publications::list_heading, filled(fmt::format("{}", fmt::join(parts, ", ")), 2));
  for (const Publication& p : publications()) {
    const auto computed = std::count_if(p.rows.begin(), p.rows.end(), [](const auto& row) { return row.computed; });
    text += fmt::format(words::publications::list_line, p.name, p.title, "", computed, p.rows.size());
  }
  return text;
}

}  // namespace equipoise
