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
#include "equipoise/extras/literature/conclusions.hpp"
#include "equipoise/extras/reproduction/open_questions.hpp"
#include "equipoise/extras/reproduction/paper_figures.hpp"
#include "equipoise/extras/reproduction/reproduce.hpp"
#include "equipoise/extras/reproduction/table_7.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"

namespace equipoise {

namespace {

constexpr int last_table = 7;

// Starts per row for recomputing the best lead on table 7: enough for half-widths of .2 to .4 points.
constexpr std::uint64_t lead_starts = 20000;

void total(Reproduction& r) {
  for (const ReproducedTable& t : r.tables)
    for (const ReproducedRow& row : t.rows)
      for (const auto* e : {&row.by_published_law, &row.by_kinematic_law}) {
        if (!*e) continue;
        ++r.ensembles;
        r.starts += (*e)->starts;
        r.seconds += (*e)->seconds;
        r.cpu_seconds += (*e)->cpu_seconds;
      }
}

class WholePaper {
 public:
  explicit WholePaper(const ReproduceOptions& options) : options_(options) {}

  Reproduction run() {
    const auto begin = std::chrono::steady_clock::now();
    Reproduction r;
    r.cpu_target = cpu_target();
    r.threads = thread_count(options_.threads);
    r.tables = reproduce_tables(options_);
    r.conclusions = judge_conclusions(r.tables);
    const auto& tables = options_.tables;
    if (!stopped() && std::count(tables.begin(), tables.end(), last_table)) lead_on_table_7(r);
    for (std::size_t k = 0; k < options_.figures.size() && !stopped(); ++k) {
      report(k, options_.figures[k]);
      r.figures.push_back(paper_figure(options_.figures[k], options_.stop));
    }
    if (options_.future && !stopped()) r.open = future();
    r.partial = stopped();
    r.run_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    r.run_cpu_seconds = cpu_seconds();
    total(r);
    return r;
  }

 private:
  bool stopped() const { return is_set(options_.stop); }

  void report(std::size_t figure, const std::string& id) const {
    if (options_.progress) options_.progress({figure, options_.figures.size(), id, {}});
  }

  void lead_on_table_7(Reproduction& r) const {
    const std::uint64_t starts = options_.starts > 0 ? std::min(options_.starts, lead_starts) : lead_starts;
    try {
      for (const LeadReading& reading : observe_table_7_lead(starts, options_.threads, options_.stop))
        r.table_7_lead.push_back({fmt::format("{}, {}, {}", reading.row.t0, reading.row.t1, reading.row.t2),
                                  reading.row.printed, reading.balanced});
    } catch (const RunError&) {
      if (!stopped()) throw;  // stopped: results so far are valid
    }
  }

  OpenQuestions future() const {
    OpenQuestionSettings settings;
    static_cast<RunOptions&>(settings) = options_;
    settings.slice_pixels = options_.slice_pixels;
    if (options_.starts > 0) settings.starts = std::min(settings.starts, options_.starts);
    settings.folder = options_.folder;
    return open_questions(settings);
  }

  const ReproduceOptions& options_;
};

}  // namespace

std::vector<std::string> reproducible() {
  std::vector<std::string> list;
  for (int table = 1; table <= last_table; ++table) list.push_back(fmt::format("table-{}", table));
  list.insert(list.end(), paper_figure_ids().begin(), paper_figure_ids().end());
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
  return reported(options, [](const ReproduceOptions& o) { return WholePaper(o).run(); });
}

}  // namespace equipoise
