// The answer for those who decide: starts and one-body runs come from wherever they were computed, and are counted
// here.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "calls.hpp"
#include "equipoise/analyses/ensembles/ensemble_runner.hpp"
#include "equipoise/analyses/ensembles/tally.hpp"
#include "equipoise/analyses/ensembles/without_balls.hpp"
#include "equipoise/analyses/mapper/mapper.hpp"
#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/classification/start_runs/transient_tally.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/report/decision/standards_text.hpp"
#include "equipoise/report/decision/verdict.hpp"
#include "equipoise/results/types/outcome.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "equipoise/study/sampling/sampling.hpp"

namespace equipoise::web {

namespace {

std::vector<OneBodyRun> rows_of(const Json& told) {
  const auto codes = numbers_of<std::int32_t>(told.at("outcome"));
  const auto speed = numbers_of<double>(told.at("speed")), figures = numbers_of<double>(told.at("figures"));
  constexpr std::size_t columns = transient_figures.size();
  if (speed.size() != codes.size() || figures.size() != codes.size() * columns)
    throw InputError("judge", "starts", fmt::format("{} figures", figures.size()),
                     fmt::format("must be {} a start, of {} starts", columns, codes.size()));
  std::vector<OneBodyRun> rows(codes.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].outcome = outcome_of(static_cast<short>(codes[i])).value_or(Outcome{});
    rows[i].outcome.mean_speed = static_cast<float>(speed[i]);
    for (std::size_t k = 0; k < columns; ++k)
      rows[i].row.*transient_figures[k].value = static_cast<float>(figures[i * columns + k]);
  }
  return rows;
}

// Runs of one body end in no listed attractor: any code above 0 stands for a steady motion.
Json told_runs(const std::vector<OneBodyRun>& runs, Bulk& bulk) {
  std::vector<Outcome> outcomes;
  std::vector<TransientRow> rows;
  for (const OneBodyRun& run : runs) {
    outcomes.push_back(run.outcome);
    rows.push_back(run.row);
    if (run.outcome.kind == OutcomeKind::attracted) outcomes.back().attractor = balanced_id;
  }
  return told_rows(outcomes, rows, bulk);
}

// The part of a result that the verdict and the tables of figures show; no shares of attractors.
BasinResult counted(const Study& study, const Json& told, const Json& bare, const Json& held) {
  BasinResult r;
  r.study = study;
  const Sampler sampler = sampler_of(study);
  Tally tally(sampler, study.sampling.seed, 0.0);
  TransientTally figures(study, sampler);
  for (const OneBodyRun& start : rows_of(told)) {
    tally.add(start.outcome);
    figures.add(start.outcome, start.row);
  }
  r.starts = tally.total();
  tally.count(Catalogue(), r);
  r.transients = figures.result(Catalogue());
  const std::uint64_t most = std::min(r.starts, most_held_starts);
  const auto first = [most](std::vector<OneBodyRun> runs) {
    runs.resize(std::min<std::size_t>(runs.size(), most));
    return runs;
  };
  if (r.starts > 0)
    r.without_balls = counted_runs({study, sampler, r.starts}, first(rows_of(bare)),
                                   held.is_null() ? std::vector<OneBodyRun>() : first(rows_of(held)));
  return r;
}

const char* name_of(Tone tone) {
  return tone == Tone::good ? "good" : tone == Tone::bad ? "bad" : tone == Tone::open ? "open" : "plain";
}

Json table_json(const DocumentTable& table) {
  const auto row = [](const std::vector<DocumentCell>& cells) {
    return object("cells", list_of(cells, [](const DocumentCell& cell) { return cell.text; }), "tone",
                  cells.empty() ? "plain" : name_of(cells.front().tone));
  };
  return object("header", table.header, "rows", list_of(table.rows, row), "caption", table.caption);
}

Json group_json(const std::vector<Block>& group) {
  Json blocks = Json::array();
  for (const Block& block : group) {
    if (const auto* table = std::get_if<DocumentTable>(&block)) blocks.push_back(object("table", table_json(*table)));
    if (const auto* words = std::get_if<Paragraph>(&block)) blocks.push_back(object("text", words->text));
  }
  return blocks;
}

// As the program's table of outcomes has it, by code.
Json velocities_json(const BasinResult& r) {
  const study::ShownUnit unit = study::shown_unit(study::Dimension::velocity, r.study.scales);
  Json of = Json::object();
  for (const TransientGroup& g : r.transients->groups)
    if (g.id && g.starts > 0)
      of[std::to_string(*g.id)] = fmt::format("{:.3g}", g.figure(&TransientRow::rms_velocity).mean * unit.size);
  return {{"unit", unit.name}, {"of", of}};
}

}  // namespace

Json told_rows(const std::vector<Outcome>& outcomes, const std::vector<TransientRow>& rows, Bulk& bulk) {
  std::vector<std::int32_t> codes;
  std::vector<double> speed, figures;
  for (const Outcome& outcome : outcomes) {
    codes.push_back(code_of(outcome));
    speed.push_back(outcome.mean_speed);
  }
  for (const TransientRow& row : rows)
    for (const TransientFigure& f : transient_figures) figures.push_back(row.*f.value);
  return {{"outcome", bulk.wholes(std::move(codes))},
          {"speed", bulk.doubles(std::move(speed))},
          {"figures", bulk.doubles(std::move(figures))}};
}

Json one_body(const Json& args, Bulk& bulk) {
  const Study study = as_sampled(study_of(args.at(0)));
  const bool balls = args.at(1).get<bool>();
  const auto first = args.at(2).get<std::uint64_t>(), count = args.at(3).get<std::uint64_t>();
  const Sampler sampler = sampler_of(study);
  const OneBodyTask task{study, sampler, first + count};
  const std::uint64_t needed = balls ? most_held_starts : bare_runs_needed(task),
                      until = std::min(first + count, needed);
  Json json = told_runs(one_body_runs(task, balls, first, until - std::min(first, until)), bulk);
  json["needed"] = needed;
  return json;
}

Json try_change(const Json& args, Bulk& bulk) {
  const std::vector<Change> changes = usual_changes(study_of(args.at(0)));
  const auto k = args.at(1).get<std::size_t>();
  MapperOptions options;
  options.transients = true;
  options.search = SearchMode::few;
  options.progress = tell;
  const Mapper mapper(changes.at(k).study, options);
  const Study& study = mapper.study();
  const Decided ended = mapper.starts(0, starts_of_a_change);
  const Sampler sampler = sampler_of(study);
  const OneBodyTask task{study, sampler, starts_of_a_change};
  Json json = told_rows(ended.outcomes, ended.transients, bulk);
  json["bare"] = told_runs(one_body_runs(task, false, 0, std::min(starts_of_a_change, bare_runs_needed(task))), bulk);
  json["change"] = k;
  return json;
}

Json judge(const Json& args) {
  const Study uncertain = study_of(args.at(0));
  const BasinResult r = counted(as_sampled(uncertain), args.at(1), args.at(2), args.at(3));
  std::vector<TriedChange> tried;
  const std::vector<Change> changes = args.at(4).empty() ? std::vector<Change>() : usual_changes(uncertain);
  for (const Json& one : args.at(4)) {
    const Change& change = changes.at(one.at("change").get<std::size_t>());
    const BasinResult with_it = counted(as_sampled(change.study), one, one.at("bare"), Json());
    if (auto judged = tried_change(change.words, with_it)) tried.push_back(*std::move(judged));
  }
  Json json = {{"starts", r.starts}, {"verdict", nullptr}, {"changes", nullptr}, {"possible", Json::array()}};
  if (const auto verdict = verdict_of(r, tried)) {
    json["verdict"] = PartOf{*verdict, std::span<const TriedChange>(tried)};
    json["verdict"]["tone"] = name_of(tone_of(verdict->decision));
    if (verdict->asks_for_changes())
      for (const Change& change : usual_changes(uncertain)) json["possible"].push_back(change.words);
    if (!tried.empty()) json["changes"] = table_json(changes_table(r, tried));
  }
  json["groups"] = list_of(balancer_blocks(r), group_json);
  json["velocity"] = velocities_json(r);
  return json;
}

}  // namespace equipoise::web
