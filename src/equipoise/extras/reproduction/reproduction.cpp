// The reproduced paper as JSON; what its basin slices show.
#include "equipoise/extras/reproduction/reproduction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/version.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/results/types/outcome.hpp"

namespace equipoise {

CellCounts all_cells(const Reproduction& r) {
  CellCounts all;
  for (const ReproducedTable& t : r.tables) {
    all.agreeing += t.agreeing;
    all.differing += t.differing;
    all.not_comparable += t.not_comparable;
  }
  return all;
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

// An outcome's names and share, as the program's other results have them.
Json with_share(Json json, const Share& share) {
  json.update(Json(share));
  return json;
}
Json named_share(const OutcomeShare& o) { return with_share(object("name", o.name, "alias", o.alias), o.share); }

}  // namespace

void to_json(Json& json, const EnsembleResult& e) {
  json = object("starts", e.starts, "seed", e.study.sampling.seed, "complete", !e.partial, "outcomes",
                list_of(e.attractors, named_share), "undecided", e.undecided, "diverged", e.diverged, "failed",
                e.failed, "seconds", e.seconds, "cpu_seconds", e.cpu_seconds);
}

void to_json(Json& json, const ReproducedCell& c) {
  json = object("attractor", c.published->attractor, "printed", c.published->printed, "published",
                c.published->share.share, "published_starts", c.published->share.starts, "computed", c.computed,
                "p_value", c.p_value, "verdict", name_of(c.verdict), "reason", c.reason);
}

void to_json(Json& json, const ReproducedRow& row) {
  json = object("row", row.published->label, "study", row.published->study + ".toml", "slip", row.published->slip,
                "follow_up", row.follow_up, "cells", row.cells, "published_law", row.by_published_law, "kinematic_law",
                row.by_kinematic_law, "kinematic_minus_published", row.law_difference);
}

void to_json(Json& json, const ReproducedTable& t) {
  json = object("table", t.published->number, "title", t.published->title, "agrees", t.agreeing, "differs", t.differing,
                "not_comparable", t.not_comparable, "p_value_limit", t.single_limit, "rows", t.rows);
}

void to_json(Json& json, const BasinSlice& map) {
  json = object("x", map.x.key, "y", map.y.key, "pixels", std::array{map.x.pixels, map.y.pixels}, "outcomes",
                list_of(map.codes, named_share));
}

void to_json(Json& json, const BoxShares& b) {
  json = object("speed", b.speed, "box", Json::parse(json_text(b.box)), "rest", Json::parse(json_text(b.rest)));
}

void to_json(Json& json, const OpenQuestions& open) {
  json = object("maps", Json::array({open.eccentricity_and_angle, open.eccentricity_and_mass}), "boxes", open.boxes);
}

void to_json(Json& json, const ConclusionResult& c) {
  json = object("answer", name_of(c.answer), "differences", c.differences);
}

void to_json(Json& json, const ConclusionRow& c) {
  json = object("conclusion", c.conclusion->text, "table", c.conclusion->table, "published_law", c.published,
                "kinematic_law", c.kinematic);
}

void to_json(Json& json, const LeadReading& reading) {
  json = with_share(object("row", reading.row.label(), "printed", reading.row.printed), reading.balanced);
}

void to_json(Json& json, const Picture& p) { json = object("id", p.id, "title", p.title, "path", p.path); }

bool Reproduction::differs() const { return all_cells(*this).differing > 0; }

std::string json_text(const Reproduction& r) {
  return object("command", r.command, "version", version_string, "citation", published_citation, "partial", r.partial,
                "differs", r.differs(), "tables", r.tables, "table_7_lead", r.table_7_lead, "conclusions",
                r.conclusions, "open_questions", r.open, "pictures", r.pictures, "run_seconds", r.run_seconds,
                "run_cpu_seconds", r.run_cpu_seconds, "ensembles", r.ensembles, "starts", r.starts, "seconds",
                r.seconds, "cpu_seconds", r.cpu_seconds, "threads", r.threads, "cpu_target", r.cpu_target)
             .dump(2) +
         "\n";
}

}  // namespace equipoise
