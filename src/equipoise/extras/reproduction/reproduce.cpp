// Row by row and law by law: an ensemble, read from a file or computed. Then all other parts of the paper, in order.
#include "equipoise/extras/reproduction/reproduction.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/ensembles/stored_ensemble.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/core/running/run_info.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/simulation/kernels/long_call.hpp"

namespace equipoise {

namespace {

bool is_balanced(const Outcome& outcome) {
  return outcome.kind == OutcomeKind::attracted && outcome.attractor == balanced_id;
}

// Factor on the starts of a row whose cell differs.
constexpr std::uint64_t follow_up_factor = 5;

class TableRun {
 public:
  explicit TableRun(const ReproduceOptions& options) : options_(options) {}

  std::vector<ReproducedTable> run() {
    if (!options_.folder.empty()) make_folder();
    std::vector<ReproducedTable> tables;
    for (const int number : options_.tables) {
      const PublishedTable& published = published_tables().at(static_cast<std::size_t>(number) - 1);
      ReproducedTable& table = tables.emplace_back();
      table.published = &published;
      for (const PublishedRow& row : published.rows) {
        table.rows.push_back({&row, {}, {}, {}, {}, {}});
        progress_.total += laws_of(published).size() * starts_of(row);
      }
    }
    for (ReproducedTable& table : tables) {
      for (ReproducedRow& row : table.rows)
        for (const model::SpeedLaw law : laws_of(*table.published))
          (law == model::SpeedLaw::published ? row.by_published_law : row.by_kinematic_law) = ensemble(row, law);
      judge(table);
      follow_up(table);
    }
    return tables;
  }

 private:
  std::vector<model::SpeedLaw> laws_of(const PublishedTable& t) const {
    using model::SpeedLaw;
    if (!t.ramps || options_.laws == LawChoice::published) return {SpeedLaw::published};
    if (options_.laws == LawChoice::kinematic) return {SpeedLaw::kinematic};
    return {SpeedLaw::published, SpeedLaw::kinematic};
  }
  bool stopped() const { return is_set(options_.stop); }

  std::uint64_t starts_of(const PublishedRow& row) const {
    return options_.starts > 0 ? options_.starts : row.cells.front().share.starts;
  }

  void make_folder() const {
    std::error_code error;
    std::filesystem::create_directories(options_.folder, error);
    if (error) throw InputError("output", "", options_.folder, "must be a folder that can be written to");
  }

  // By chance, one table in a hundred shows a cell that differs. Such a cell is sampled further, and the larger sample
  // decides: in it chance fades and a true difference stands out.
  void follow_up(ReproducedTable& table) {
    bool larger = false;
    for (ReproducedRow& row : table.rows)
      for (const ReproducedCell& cell : row.cells) {
        if (cell.verdict != Verdict::differs || stopped()) continue;
        const std::uint64_t first = row.by_published_law->starts;
        progress_.total += follow_up_factor * first;
        EnsembleResult result = ensemble(row, model::SpeedLaw::published, follow_up_factor);
        if (result.partial) break;
        row.follow_up =
            fmt::format("{}, {}: p = {:.2g} from the first {} starts, so {} were taken", row.published->label,
                        cell.published->attractor, cell.p_value, first, result.starts);
        row.by_published_law = std::move(result);
        larger = true;
        break;  // the row's other cells share the sample
      }
    if (larger) judge(table);
  }

  EnsembleResult ensemble(const ReproducedRow& row, model::SpeedLaw law, std::uint64_t factor = 1) {
    Study study = study_of(*row.published, law);
    study.sampling.starts = factor * starts_of(*row.published);
    // The constant-speed study has no law in its name.
    const bool constant = study.speed.profile == Profile::constant;
    const std::string& name = row.published->study;
    const std::string path = options_.folder.empty() ? ""
                                                     : fmt::format("{}/{}{}{}.nc", options_.folder, name,
                                                                   constant ? "" : fmt::format("-{}", name_of(law)),
                                                                   factor > 1 ? "-follow-up" : "");
    progress_.what = constant ? name : fmt::format("{}, {} law", name, name_of(law));
    EnsembleResult result;
    result.partial = stopped();
    if (result.partial) return result;
    report(0);
    if (path.empty() || !stored(study, path, result)) result = compute(study, path);
    before_ += study.sampling.starts;
    return result;
  }

  // Reads a finished ensemble of exactly as many starts; false if the file holds anything else of the same study.
  bool stored(const Study& study, const std::string& path, EnsembleResult& result) const {
    if (!std::filesystem::exists(path)) return false;
    const BasinFile file(path, basin_file_header(study, false));
    if (!file.complete() || file.stored() != study.sampling.starts) return false;
    result.study = study;
    result.starts = file.stored();
    result.took(file.time());
    for (const OutcomeShare& line : file.summary()) {
      if (line.id > 0)
        result.attractors.push_back(line);
      else
        (line.id == undecided_code  ? result.undecided
         : line.id == diverged_code ? result.diverged
                                    : result.failed) = line.share;
    }
    for_each_stored(file, 0, result.starts, [&](const Outcome& outcome, const TransientRow*) {
      result.balanced.push_back(is_balanced(outcome));
    });
    return true;
  }

  EnsembleResult compute(const Study& study, const std::string& path) {
    EnsembleResult result;
    BasinOptions options;
    options.threads = options_.threads;
    options.output = path;
    options.store_angles = false;
    options.stop = options_.stop;
    options.searches = &searches_;
    options.outcome = [&](const Outcome& outcome) { result.balanced.push_back(is_balanced(outcome)); };
    options.progress = [&](const Progress& p) { p.preparing ? report_stage(p) : report(p.done); };
    static_cast<BasinResult&>(result) = basin(study, options);
    if (path.empty()) return result;
    result.took(BasinFile(path, basin_file_header(study, false)).time());  // earlier parts included
    return result;
  }

  void report(std::uint64_t done) {
    progress_.done = before_ + done;
    if (options_.progress) options_.progress(progress_);
  }

  // Stages before a row's starts add nothing to the starts done.
  void report_stage(const Progress& stage) const {
    if (!options_.progress) return;
    Progress now = progress_;
    now.what += ", " + stage.what;
    options_.progress(now);
  }

  const ReproduceOptions& options_;
  Progress progress_;
  AttractorSearchCache searches_;
  std::uint64_t before_ = 0;
};

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

Reproduction whole_paper(const ReproduceOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const auto stopped = [&] { return is_set(options.stop); };
  Reproduction r;
  r.cpu_target = cpu_target();
  r.threads = thread_count(options.threads);
  r.tables = TableRun(options).run();
  r.conclusions = judge_conclusions(r.tables);
  if (!stopped() && std::count(options.tables.begin(), options.tables.end(), last_table)) lead_on_table_7(options, r);
  for (std::size_t k = 0; k < options.figures.size() && !stopped(); ++k) {
    if (options.progress) options.progress({k, options.figures.size(), options.figures[k], {}});
    r.figures.push_back(paper_figure(options.figures[k], options.stop));
  }
  if (options.future && !stopped()) r.open = open_questions(options);
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

Reproduction reproduce(const ReproduceOptions& options) { return long_call(options, whole_paper); }

}  // namespace equipoise
