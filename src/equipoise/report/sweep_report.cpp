// Sweeps as text, JSON and CSV.
#include "equipoise/report/sweep_report.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "equipoise/base/version.hpp"
#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/report/text.hpp"

namespace equipoise {

namespace {

using Json = nlohmann::ordered_json;

// Attractors with a column of their own in a terminal's table.
constexpr std::size_t most_columns = 5;

struct SweepColumn {
  int id = 0;
  std::string name;
  double largest = 0.0;  // share in any cell
};

// Of all attractors that some start came to, balanced first.
std::vector<SweepColumn> columns_of(const SweepResult& r) {
  std::map<int, SweepColumn> columns;
  columns[balanced_id] = {balanced_id, "balanced", 0.0};
  for (const auto& cell : r.cells) {
    if (!cell) continue;
    for (const SweepOutcome& o : cell->outcomes) {
      if (o.share.count == 0) continue;
      SweepColumn& column = columns[o.id];
      column = {o.id, o.alias.empty() ? o.name : o.alias, std::max(column.largest, o.share.share)};
    }
  }
  std::vector<SweepColumn> list;
  for (const auto& [id, column] : columns) list.push_back(column);
  return list;
}

const SweepOutcome* find(const SweepCell& cell, int id) {
  const auto at = std::find_if(cell.outcomes.begin(), cell.outcomes.end(), [&](const auto& o) { return o.id == id; });
  return at == cell.outcomes.end() ? nullptr : &*at;
}

std::string quoted_csv(const std::string& text) {
  return text.find_first_of(",\"") == std::string::npos ? text : "\"" + text + "\"";
}

std::string csv_number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? fmt::format("{}", *value) : "";
}

// Each parameter with its value in a cell.
template <class Visit>
void for_each_value(const SweepResult& r, std::size_t cell, const Visit& visit) {
  const std::vector<std::size_t> place = r.place(cell);
  for (std::size_t a = 0; a < r.axes.size(); ++a)
    for (const SweepParameter& p : r.axes[a].parameters) visit(p, place[a]);
}

}  // namespace

std::string sweep_text(const SweepResult& r) {
  std::string text = study_heading(r.study), header;
  for (const SweepAxis& axis : r.axes)
    for (const SweepParameter& p : axis.parameters) {
      const std::string title = p.unit.empty() ? p.key : fmt::format("{}, {}", p.key, p.unit);
      header += fmt::format("{:>{}}  ", title, std::max<std::size_t>(title.size(), 10));
    }
  std::vector<SweepColumn> columns = columns_of(r), shown = columns;
  if (shown.size() > most_columns) {
    std::stable_sort(shown.begin() + 1, shown.end(),
                     [](const auto& a, const auto& b) { return a.largest > b.largest; });
    shown.resize(most_columns);
    std::sort(shown.begin(), shown.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  }
  const bool others = shown.size() < columns.size();
  header += fmt::format("{:>9}  {:>10}  {:<20}", "starts", "balanced", "95 % interval");
  std::vector<std::size_t> widths;
  for (std::size_t k = 1; k < shown.size(); ++k) {
    widths.push_back(std::max<std::size_t>(shown[k].name.size(), 8));
    header += fmt::format("  {:>{}}", shown[k].name, widths.back());
  }
  if (others) header += "    others";
  text += header + "  undecided\n";
  for (std::size_t index = 0; index < r.cells.size(); ++index) {
    if (!r.cells[index]) continue;
    const SweepCell& cell = *r.cells[index];
    for_each_value(r, index, [&](const SweepParameter& p, std::size_t at) {
      const std::size_t title = p.key.size() + (p.unit.empty() ? 0 : p.unit.size() + 2);
      text += fmt::format("{:>{}.6g}  ", p.values[at], std::max<std::size_t>(title, 10));
    });
    const Share& balanced = cell.outcomes.front().share;
    text += fmt::format("{:>9}  {:>10}  {:<20}", cell.starts, percent(balanced.share, digits_for(balanced)),
                        interval(balanced));
    double rest = 0.0;
    for (const SweepOutcome& o : cell.outcomes) rest += o.share.share;
    rest -= balanced.share;
    for (std::size_t k = 1; k < shown.size(); ++k) {
      const SweepOutcome* o = find(cell, shown[k].id);
      if (o) rest -= o->share.share;
      text += fmt::format("  {:>{}}", o ? percent(o->share.share, 2) : "-", widths[k - 1]);
    }
    if (others) text += fmt::format("  {:>8}", percent(std::max(rest, 0.0), 2));
    double open = cell.undecided.share;
    if (cell.stalled) open += cell.stalled->share;
    text += fmt::format("  {:>9}\n", percent(cell.undecided.share, 2));
  }
  text += "\n";
  std::size_t done = 0;
  std::uint64_t starts = 0, lost = 0;
  for (const auto& cell : r.cells) {
    if (!cell) continue;
    ++done;
    starts += cell->starts;
    lost += cell->diverged.count + cell->failed.count;
  }
  if (lost > 0) text += fmt::format("{} starts diverged or failed.\n", lost);
  for (std::size_t index = 0; index < r.cells.size(); ++index)
    if (r.cells[index] && !r.cells[index]->note.empty()) {
      std::string where;
      for_each_value(r, index, [&](const SweepParameter& p, std::size_t at) {
        where += fmt::format("{}{} = {}", where.empty() ? "" : ", ", p.key, p.given[at]);
      });
      text += fmt::format("Note at {}: {}.\n", where, r.cells[index]->note);
    }
  if (done < r.cells.size())
    text += fmt::format("PARTIAL: {} of {} cells; the rest is missing.\n", done, r.cells.size());
  text +=
      fmt::format("{} cells, {} starts, seed {}, the same starts in every cell", done, starts, r.study.sampling.seed);
  if (r.resumed_cells > 0) text += fmt::format("; {} cells from an earlier run", r.resumed_cells);
  if (r.seconds > 0.0)
    text += fmt::format("; {:.2f} s, {:.2f} s CPU on {} thread{} ({})", r.seconds, r.cpu_seconds, r.threads,
                        r.threads == 1 ? "" : "s", r.cpu_target);
  return text + fmt::format("; equipoise {}\n", version_string);
}

std::string sweep_json(const SweepResult& r) {
  const auto share = [](const Share& s) {
    Json one = share_json(s);
    one["least"] = s.least;
    one["most"] = s.most;
    return one;
  };
  const auto optional = [](const std::optional<double>& v) { return v ? Json(*v) : Json(nullptr); };
  Json json;
  json["over"] = Json::array();
  for (const SweepAxis& axis : r.axes)
    for (const SweepParameter& p : axis.parameters)
      json["over"].push_back({{"key", p.key}, {"unit", p.unit}, {"values", p.values}});
  json["zipped"] = r.axes.size() == 1 && r.axes.front().parameters.size() > 1;
  json["partial"] = !r.complete();
  json["cells"] = Json::array();
  for (std::size_t index = 0; index < r.cells.size(); ++index) {
    if (!r.cells[index]) continue;
    const SweepCell& cell = *r.cells[index];
    Json one, at = Json::object();
    for_each_value(r, index, [&](const SweepParameter& p, std::size_t k) { at[p.key] = p.values[k]; });
    one["at"] = at;
    one["starts"] = cell.starts;
    one["outcomes"] = Json::array();
    for (const SweepOutcome& o : cell.outcomes) {
      Json outcome = {{"id", o.id}, {"name", o.name}, {"alias", o.alias}, {"kind", o.kind}};
      outcome.update(share(o.share));
      outcome["mean_time"] = o.mean_time;
      outcome["radial"] = {{"min", optional(o.r_min)}, {"mean", optional(o.r_mean)}, {"max", optional(o.r_max)}};
      outcome["period"] = o.period > 0.0 ? Json(o.period) : Json(nullptr);
      one["outcomes"].push_back(outcome);
    }
    if (cell.stalled) one["stalled"] = share(*cell.stalled);
    if (cell.passed) one["passed"] = share(*cell.passed);
    one["undecided"] = share(cell.undecided);
    one["diverged"] = share(cell.diverged);
    one["failed"] = share(cell.failed);
    if (cell.transients) {
      Json transients = Json::object();
      for (std::size_t k = 0; k < transient_columns.size(); ++k) {
        const SampleSummary& s = cell.transients->figures[k];
        Json& figure = transients[transient_columns[k].name];
        figure = {{"mean", s.mean}, {"largest", s.largest}};
        for (std::size_t q = 0; q < reported_quantiles.size(); ++q)
          figure["quantiles"].push_back({{"at", reported_quantiles[q]},
                                         {"value", s.quantiles[q].value},
                                         {"low", s.quantiles[q].low},
                                         {"high", s.quantiles[q].high}});
      }
      for (std::size_t k = 0; k < transient_limit_names.size(); ++k)
        if (cell.transients->exceeded[k])
          transients["exceeded"][transient_limit_names[k]] = share_json(*cell.transients->exceeded[k]);
      one["transients"] = transients;
    }
    one["balanced_stable"] = cell.balanced_stable;
    one["note"] = cell.note;
    json["cells"].push_back(one);
  }
  json["confidence"] = 0.95;
  json["half_width"] = r.half_width;
  json["seconds"] = r.seconds;
  json["cpu_seconds"] = r.cpu_seconds;
  json["resumed_cells"] = r.resumed_cells;
  json["threads"] = r.threads;
  json["cpu_target"] = r.cpu_target;
  json["study_name"] = r.study.name;
  json["study"] = study_json(r.study);
  json["version"] = version_string;
  return json.dump(2) + "\n";
}

std::string sweep_csv(const SweepResult& r) {
  std::string text =
      fmt::format("# equipoise {}: sweep{}\n", version_string, r.complete() ? "" : ", PARTIAL: cells are missing");
  std::istringstream study(to_toml(r.study));
  for (std::string line; std::getline(study, line);) text += line.empty() ? "#\n" : "# " + line + "\n";
  for (const SweepAxis& axis : r.axes)
    for (const SweepParameter& p : axis.parameters)
      text += quoted_csv(p.unit.empty() ? p.key : fmt::format("{} ({})", p.key, p.unit)) + ",";
  text += "starts,id,name,alias,kind,count,share,low,high,mean_time,r_min,r_mean,r_max,period\n";
  for (std::size_t index = 0; index < r.cells.size(); ++index) {
    if (!r.cells[index]) continue;
    const SweepCell& cell = *r.cells[index];
    std::string at;
    for_each_value(r, index, [&](const SweepParameter& p, std::size_t k) { at += fmt::format("{},", p.values[k]); });
    const auto line = [&](int id, const std::string& name, const Share& s, const SweepOutcome* o) {
      text += fmt::format("{}{},{},{},{},{},{},{},{},{},", at, cell.starts, id, quoted_csv(name), o ? o->alias : "",
                          o ? o->kind : "", s.count, s.share, s.low, s.high);
      text += o ? fmt::format("{},{},{},{},{}\n", s.count > 0 ? csv_number(o->mean_time) : "", csv_number(o->r_min),
                              csv_number(o->r_mean), csv_number(o->r_max), o->period > 0.0 ? csv_number(o->period) : "")
                : ",,,,\n";
    };
    for (const SweepOutcome& o : cell.outcomes) line(o.id, o.name, o.share, &o);
    if (cell.stalled) line(-3, "stalled", *cell.stalled, nullptr);
    line(0, "undecided", cell.undecided, nullptr);
    line(-1, "diverged", cell.diverged, nullptr);
    line(-2, "failed", cell.failed, nullptr);
  }
  return text;
}

}  // namespace equipoise
