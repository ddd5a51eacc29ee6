// equipoise sweep: an ensemble at every combination of parameter values; equipoise merge: joins files of one sweep.
#include <charconv>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "commands.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/analyses/sweeps/sweep.hpp"
#include "equipoise/analyses/sweeps/sweep_axis.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "result_forms.hpp"
#include "streams.hpp"
#include "time_limit.hpp"
#include "team.hpp"

namespace equipoise::app {

namespace {

struct SweepArguments : ResultForms {
  std::string shard;
  std::vector<std::string> over;
  std::optional<std::string> half_width;
  bool zip = false, transients = false;
};

void put_sweep(const ResultForms& a, const SweepResult& result, const std::function<GivenMachine()>& machine) {
  put_forms(a, {result.study, [&] { return document_of(result); }, [&] { return json_text(result); },
                [&] { return sweep_csv(result); }, machine});
}

constexpr FormWords sweep_words{"one line per cell and outcome (.csv)",
                                "a picture: stacked shares along one parameter, a heat map over two"};

// "2/8": the second of eight.
void read_shard(const std::string& text, SweepOptions& options) {
  if (text.empty()) return;
  const char* end = text.data() + text.size();
  std::size_t number = 0;
  auto read = std::from_chars(text.data(), end, number);
  bool good = read.ec == std::errc() && read.ptr != end && *read.ptr == '/';
  if (good) {
    read = std::from_chars(read.ptr + 1, end, options.shards);
    good = read.ec == std::errc() && read.ptr == end;
  }
  if (!good || number < 1 || number > options.shards || options.shards > most_sweep_cells)
    throw InputError("--shard", "", display_text(text), "must be I/N with I from 1 to N, e.g. 2/8");
  options.shard = number - 1;
}

SweepPlan plan_of(const SweepArguments& a, const StudySource& source) {
  BasinOptions request;
  request.limit_given = a.starts.has_value();
  if (a.half_width) request.half_width = half_width_option(*a.half_width);
  if (a.transients) request.transients = true;
  const Study study = source.with();
  const bool own = a.over.empty() && !study.sweep.over.empty();
  if (a.over.empty() && !own)
    throw InputError("--over", "", "",
                     "says nothing, and the study has no [sweep] with over = [\"KEY=VALUES\"]; must name a parameter "
                     "and its values, e.g. speed.final=1.5:6:0.1");
  const std::string where = own ? own_sweep(study.name) : "--over";
  const std::vector<SweepAxis> axes = sweep_axes(own ? study.sweep.over : a.over, own ? study.sweep.zip : a.zip, where);
  return SweepPlan(source, axes, request, where);
}

SweepResult compute(Team& team, const SweepPlan& plan, const SweepArguments& a, SweepOptions& options) {
  using Clock = std::chrono::steady_clock;
  Clock::time_point told;  // not yet
  if (!a.quiet && !error_is_terminal())
    options.cell = [&, apart = lines_apart()](std::size_t index, const SweepCell& cell) {
      if (told != Clock::time_point{} && Clock::now() - told < apart) return;
      told = Clock::now();
      const Share& balanced = cell.outcomes.front().share;
      put_error(fmt::format("{}: {} starts, balanced {} ({}), undecided {}\n", cell_title(plan.axes(), index),
                            cell.starts, percent(balanced.share, digits_for(balanced)), interval(balanced),
                            percent(cell.undecided.share, 2)));
    };
  return team.lead(options, [&] { return sweep(plan, options); });
}

int run_sweep(const SweepArguments& a) {
  begin_computing(a);
  Team team;
  const bool same = team.have_same(a.shard);
  if (!same && !team.leads()) return bad_input;
  if (!same)
    throw InputError("--shard", "", a.shard,
                     "is not what the other processes of the job were given; must be the same for all, which share the "
                     "work of that part (start processes that have a part each without mpirun)");
  SweepOptions options;
  options.output = a.output;
  options.stop = &stop_flag();
  StudySource source;
  const auto plan = team.prepared([&] {
    options.threads = team.threads(a.threads);
    read_shard(a.shard, options);
    source = source_of(a);
    SweepPlan made = plan_of(a, source);
    if (team.leads()) check_forms(a);
    if (team.leads() && options.shards > 1 && a.output.empty())
      throw InputError("--shard", "", a.shard, "needs -o: the file that is merged with those of the other shards");
    return made;
  });
  if (!plan) return bad_input;
  if (!team.leads()) return team.follow(sweep_survey(*plan), options.threads, options.stop);
  if (const std::size_t blocks = plan->blocks(); options.shard >= blocks)
    put_error(
        fmt::format("shard {} is empty: the {} cells form {} block{} of up to {} cells, and a shard computes whole "
                    "blocks; {} all\n",
                    a.shard, plan->cells(), blocks, plural(blocks), SweepPlan::block_length,
                    blocks == 1 ? "shard 1 has" : fmt::format("the first {} shards have", blocks)));
  ProgressLine progress(a.quiet, options);
  const SweepResult result = compute(team, *plan, a, options);
  progress.finish();
  put_sweep(a, result, [&] { return given_machine(source.toml, source.name, source.overrides); });
  if (result.complete() || !stop_flag()) return done;
  return ended_early(progress.left(), kept_by_output, a.output);
}

struct MergeArguments : ResultForms {
  std::vector<std::string> files;
};

int run_merge(const MergeArguments& a) {
  check_forms(a);
  RunOptions options;
  options.notice = [](const std::string& sentence) { say(sentence); };
  const SweepResult result = merge_sweeps(a.files, a.output, options);
  put_sweep(a, result, [&] { return given_machine(result.study); });
  return done;
}

}  // namespace

Command add_sweep(CLI::App& app) {
  const auto a = std::make_shared<SweepArguments>();
  add_study(app, *a);
  app.add_option(
         "--over", a->over,
         "a parameter and its values, e.g. speed.final=1.5:6:0.1, balancer.drag=0.01,0.05,0.1, \"speed.final=900 "
         "rpm:4000 rpm:100 rpm\"; up to three times (default: [sweep] of the study)")
      ->type_name("KEY=VALUES")
      ->take_all();
  add_zip(app, a->zip);
  add_starts(app, *a, "number of runs per cell; with --half-width, the maximum",
             "seed of the random starts, the same in every cell");
  app.add_option("--half-width", a->half_width,
                 "keep sampling in each cell until every 95 % interval is narrower than +-H (e.g. 0.005 for +-0.5 %)")
      ->type_name("H");
  app.add_flag("--transients", a->transients,
               "also peak vibration, forces and settling time (default if the study has [limits])");
  app.add_option("-o,--output", a->output,
                 "all cells as NetCDF (.nc), saved as they finish; rerun the command to resume")
      ->type_name("FILE");
  app.add_option("--shard", a->shard, "compute only part I of N; join the parts with equipoise merge")
      ->type_name("I/N");
  add_forms(app, *a, sweep_words);
  add_usual(app, *a);
  return [a] { return run_sweep(*a); };
}

Command add_merge(CLI::App& app) {
  const auto a = std::make_shared<MergeArguments>();
  app.add_option("files", a->files, "result files of one sweep (.nc), or their unfinished parts (.nc.part)")
      ->required()
      ->type_name("FILE");
  app.add_option("-o,--output", a->output, "merged file to write (.nc)")->type_name("FILE")->required();
  add_forms(app, *a, sweep_words);
  add_wide(app);
  return [a] { return run_merge(*a); };
}

}  // namespace equipoise::app
