// The whole paper, from its first table to its open questions: computes what is asked for, in order, and sums it up.
#include <algorithm>
#include <chrono>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/running/cpu_time.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/core/running/reporting.hpp"
#include "equipoise/extras/reproduction/reproduction.hpp"
#include "equipoise/extras/reproduction/reproduce.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"

namespace equipoise {

namespace {

constexpr int last_table = 7;

// Starts per row for recomputing the best lead on table 7: enough for half-widths of .2 to .4 points.
constexpr std::uint64_t lead_starts = 20000;

void total(Reproduction& r) {
  for (const ReproducedTable& t : r.tables)
    for (const ReproducedRow& row : t.rows)
      row.for_each_law([&](const EnsembleResult& e, model::SpeedLaw) {
        ++r.ensembles;
        r.starts += e.starts;
        r.seconds += e.seconds;
        r.cpu_seconds += e.cpu_seconds;
      });
}

void lead_on_table_7(const ReproduceOptions& options, Reproduction& r) {
  const std::uint64_t starts = options.starts > 0 ? std::min(options.starts, lead_starts) : lead_starts;
  try {
    r.table_7_lead = observe_table_7_lead(starts, options.threads, options.stop);
  } catch (const RunError&) {
    if (!is_set(options.stop)) throw;  // stopped: results so far are valid
  }
}

OpenQuestions future(const ReproduceOptions& options) {
  OpenQuestionSettings settings;
  static_cast<RunOptions&>(settings) = options;
  settings.slice_pixels = options.slice_pixels;
  if (options.starts > 0) settings.starts = std::min(settings.starts, options.starts);
  settings.folder = options.folder;
  return open_questions(settings);
}

Reproduction whole_paper(const ReproduceOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const auto stopped = [&] { return is_set(options.stop); };
  Reproduction r;
  r.cpu_target = cpu_target();
  r.threads = thread_count(options.threads);
  r.tables = reproduce_tables(options);
  r.conclusions = judge_conclusions(r.tables);
  if (!stopped() && std::count(options.tables.begin(), options.tables.end(), last_table)) lead_on_table_7(options, r);
  for (std::size_t k = 0; k < options.figures.size() && !stopped(); ++k) {
    if (options.progress) options.progress({k, options.figures.size(), options.figures[k], {}});
    r.figures.push_back(paper_figure(options.figures[k], options.stop));
  }
  if (options.future && !stopped()) r.open = future(options);
  r.partial = stopped();
  r.run_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  r.run_cpu_seconds = cpu_seconds();
  total(r);
  return r;
}

}  // namespace

std::vector<std::string> reproducible() {
  std::vector<std::string> list;
  for (int table = 1; table <= last_table; ++table) list.push_back(fmt::format("table-{}", table));
  for (const std::string& id : paper_figure_ids()) list.push_back(id);
  list.insert(list.end(), {"future", "tables", "figures", "all"});
  return list;
}

ReproduceOptions options_for(const std::vector<std::string>& what) {
  for (const std::string& w : what)
    if (const auto known = reproducible(); std::find(known.begin(), known.end(), w) == known.end())
      throw InputError(
          "reproduce", "", display_text(w),
          fmt::format("must be among {}; studies/publications/judge.py has the numbers of other publications",
                      fmt::join(known, ", ")));
  const auto asked = [&](const std::string& one, const std::string& group) {
    return what.empty() || std::any_of(what.begin(), what.end(),
                                       [&](const std::string& w) { return w == "all" || w == group || w == one; });
  };
  ReproduceOptions options;
  for (int table = 1; table <= last_table; ++table)
    if (asked(fmt::format("table-{}", table), "tables")) options.tables.push_back(table);
  for (const std::string& id : paper_figure_ids())
    if (asked(id, "figures")) options.figures.push_back(id);
  options.future = asked("future", "future");
  return options;
}

Reproduction reproduce(const ReproduceOptions& options) {
  const ChosenCpuTarget chosen(options.cpu_target);
  return reported(options, whole_paper);
}

}  // namespace equipoise
