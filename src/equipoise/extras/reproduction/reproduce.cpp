// Row by row and law by law: an ensemble, read from a file or computed.
#include "equipoise/extras/reproduction/reproduce.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/ensembles/basin_header.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/running/reporting.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"

namespace equipoise {

namespace {

bool is_balanced(const Fate& fate) { return fate.outcome == Outcome::attracted && fate.attractor == balanced_id; }

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
        if (!result.complete) break;
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
    if (stopped()) return result;
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
    result.starts = file.stored();
    result.seed = study.sampling.seed;
    result.complete = true;
    result.seconds = file.time().seconds;
    result.cpu_seconds = file.time().cpu_seconds;
    for (const OutcomeShare& line : file.summary()) {
      if (line.id > 0)
        result.attractors.push_back(line);
      else
        (line.id == undecided_code  ? result.undecided
         : line.id == diverged_code ? result.diverged
                                    : result.failed) = line.share;
    }
    constexpr std::uint64_t block = 65536;
    for (std::uint64_t first = 0; first < result.starts; first += block)
      for (const Fate& fate : file.read(first, std::min<std::uint64_t>(block, result.starts - first)))
        result.balanced.push_back(is_balanced(fate));
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
    options.fate = [&](const Fate& fate) { result.balanced.push_back(is_balanced(fate)); };
    options.progress = [&](const Progress& p) { p.preparing ? report_stage(p) : report(p.done); };
    const BasinResult basin = equipoise::basin(study, options);
    result.starts = basin.starts;
    result.seed = study.sampling.seed;
    result.attractors = basin.attractors;
    static_cast<OtherShares&>(result) = basin;
    result.complete = !basin.partial;
    RunTime time{basin.seconds, basin.cpu_seconds};
    if (!path.empty()) time = BasinFile(path, basin_file_header(study, false)).time();  // earlier parts included
    result.seconds = time.seconds;
    result.cpu_seconds = time.cpu_seconds;
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

}  // namespace

std::vector<ReproducedTable> reproduce_tables(const ReproduceOptions& options) {
  const ChosenCpuTarget chosen(options.cpu_target);
  return reported(options, [](const ReproduceOptions& o) { return TableRun(o).run(); });
}

}  // namespace equipoise
