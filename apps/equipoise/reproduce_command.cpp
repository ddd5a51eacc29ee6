// equipoise reproduce: the tables and figures of Wright and Peng (2019), computed again and judged.
#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include "equipoise/basins/basin.hpp"
#include "equipoise/kernels/lane_kernels.hpp"
#include "equipoise/reproduction/open_questions.hpp"
#include "equipoise/reproduction/paper_figures.hpp"
#include "equipoise/reproduction/reproduce.hpp"
#include "equipoise/reproduction/reproduction.hpp"
#include "equipoise/reproduction/table_7.hpp"
#include "gnuplot.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "reproduce_files.hpp"
#include "streams.hpp"

namespace equipoise::app {

namespace {

namespace fs = std::filesystem;

struct ReproduceArguments {
  std::vector<std::string> what;
  std::optional<std::string> starts, threads, pixels;
  std::string law = "both", output, report, cpu;
  bool json = false, quiet = false;
};

// What is to be made, in the order of the paper.
struct Plan {
  std::vector<int> tables;
  std::vector<std::string> figures;
  bool future = false;
  OpenQuestionSettings questions;
};

std::vector<std::string> choices() {
  std::vector<std::string> list;
  for (int table = 1; table <= 7; ++table) list.push_back(fmt::format("table-{}", table));
  list.insert(list.end(), paper_figure_ids().begin(), paper_figure_ids().end());
  list.insert(list.end(), {"future", "tables", "figures", "all"});
  return list;
}

Plan plan_of(const std::vector<std::string>& what) {
  for (const std::string& w : what)
    if (const auto known = choices(); std::find(known.begin(), known.end(), w) == known.end())
      throw InputError("reproduce", "", display_text(w), fmt::format("must be among {}", fmt::join(known, ", ")));
  const auto asked = [&](const std::string& one, const std::string& group) {
    return what.empty() || std::any_of(what.begin(), what.end(),
                                       [&](const std::string& w) { return w == "all" || w == group || w == one; });
  };
  Plan plan;
  for (int table = 1; table <= 7; ++table)
    if (asked(fmt::format("table-{}", table), "tables")) plan.tables.push_back(table);
  for (const std::string& id : paper_figure_ids())
    if (asked(id, "figures")) plan.figures.push_back(id);
  plan.future = asked("future", "future");
  return plan;
}

ReproduceOptions table_options(const ReproduceArguments& a, const Plan& plan) {
  ReproduceOptions options;
  options.tables = plan.tables;
  options.threads = threads_option(a.threads);
  if (a.starts)
    options.starts =
        option_number<std::uint64_t>("--starts", *a.starts, 1, 1'000'000'000, "a whole number from 1 to 1000000000");
  option_choice("--law", a.law, std::array{"published", "kinematic", "both"});
  options.laws = a.law == "published"   ? LawChoice::published
                 : a.law == "kinematic" ? LawChoice::kinematic
                                        : LawChoice::both;
  if (!a.output.empty()) options.folder = a.output + "/ensembles";
  options.stop = &stop_flag();
  return options;
}

std::string command_line(const ReproduceArguments& a) {
  std::string text = "equipoise reproduce";
  for (const std::string& w : a.what) text += " " + w;
  if (a.starts) text += " --starts " + *a.starts;
  if (a.pixels) text += " --pixels " + *a.pixels;
  if (a.law != "both") text += " --law " + a.law;
  if (!a.report.empty()) text += " --report " + display_text(fs::path(a.report).filename().string());
  return text;
}

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

// Starts a row from which the best lead on table 7 is computed anew: enough for half-widths of .2 to .4 points.
constexpr std::uint64_t lead_starts = 20000;

void lead_on_table_7(Reproduction& r, const ReproduceOptions& options) {
  const std::uint64_t starts = options.starts > 0 ? std::min(options.starts, lead_starts) : lead_starts;
  try {
    for (const ObservationReading& reading : observe_table_7(table_7_lead(), starts, options.threads, options.stop))
      r.table_7_lead.push_back({fmt::format("{}, {}, {}", reading.row.t0, reading.row.t1, reading.row.t2),
                                reading.row.printed, reading.balanced});
  } catch (const RunError&) {
    if (!stop_flag()) throw;  // stopped: what is there so far counts
  }
}

OpenQuestions future(OpenQuestionSettings settings, const ReproduceOptions& options, ProgressLine& progress) {
  if (options.starts > 0) settings.starts = std::min(settings.starts, options.starts);
  settings.folder = options.folder;
  settings.threads = options.threads;
  settings.stop = options.stop;
  settings.progress = [&](const std::string& part, double share) {
    progress.update(static_cast<std::uint64_t>(100.0 * share), 100, part);
  };
  return open_questions(settings);
}

void compute(Reproduction& r, const Plan& plan, ReproduceOptions& options, bool quiet) {
  ProgressLine progress(quiet);
  options.progress = [&](const ReproduceProgress& p) { progress.update(p.done, p.total, p.what); };
  r.tables = reproduce_tables(options);
  r.conclusions = judge_conclusions(r.tables);
  const auto stopped = [] { return stop_flag().load(); };
  if (!stopped() && std::count(plan.tables.begin(), plan.tables.end(), 7)) lead_on_table_7(r, options);
  for (const std::string& id : plan.figures)
    if (!stopped()) r.figures.push_back(paper_figure(id, &stop_flag()));
  if (plan.future && !stopped()) r.open = future(plan.questions, options, progress);
  r.partial = stopped();
}

void check_paths(const ReproduceArguments& a) {
  if (!a.report.empty() && !a.report.ends_with(".html") && !a.report.ends_with(".md"))
    throw InputError("--report", "", a.report, "must be a file name that ends in .html or .md");
  require_writable("--report", a.report);
  if (!a.report.empty()) require_gnuplot("--report", a.report);
  if (!a.output.empty()) require_gnuplot("--output", a.output);
}

int run_reproduce(const ReproduceArguments& a) {
  choose_cpu(a.cpu);
  Plan plan = plan_of(a.what);
  if (a.pixels)
    plan.questions.map_pixels = option_number<int>("--pixels", *a.pixels, 2, 4096, "a whole number from 2 to 4096");
  ReproduceOptions options = table_options(a, plan);
  check_paths(a);
  const PictureFolder folder(a.output, a.report);
  Reproduction r;
  r.command = command_line(a);
  r.cpu_target = cpu_target();
  r.threads = thread_count(options.threads);
  const auto begin = std::chrono::steady_clock::now();
  compute(r, plan, options, a.quiet);
  r.run_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  r.run_cpu_seconds = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  total(r);
  if (!folder.path().empty() && !r.partial) {
    draw_pictures(r, folder);
    if (!a.report.empty()) write_report(r, a.report, folder);
  }
  if (folder.temporary()) r.pictures.clear();
  if (!a.output.empty()) write_file(a.output + "/reproduction.json", reproduction_json(r));
  put(a.json ? reproduction_json(r) : reproduction_text(r));
  return r.partial ? interrupted : r.differs() ? check_failed : done;
}

}  // namespace

Command add_reproduce(CLI::App& app) {
  const auto a = std::make_shared<ReproduceArguments>();
  app.add_option("what", a->what, fmt::format("any of {} (default: all)", fmt::join(choices(), ", ")))
      ->type_name("WHAT");
  app.add_option("--starts", a->starts, "starts an ensemble (default: as many as the paper used)")->type_name("N");
  app.add_option("--law", a->law, "speed law of ramps (default: both)")->type_name("LAW");
  app.add_option("--report", a->report, "one page with everything (HTML), or Markdown with pictures beside it")
      ->type_name("FILE.html|.md");
  app.add_option("-o,--output", a->output, "folder for ensembles, pictures and tables; the same command resumes")
      ->type_name("DIR");
  app.add_option("--pixels", a->pixels, "pixels along each side of the maps of `future` (default: 64)")->type_name("P");
  app.add_option("--threads", a->threads, "threads (default: all cores)")->type_name("T");
  app.add_option("--cpu", a->cpu, "instruction set to use instead of the best (see --version)")->type_name("NAME");
  app.add_flag("--json", a->json, "print one JSON object");
  app.add_flag("--quiet", a->quiet, "no progress");
  return [a] { return run_reproduce(*a); };
}

}  // namespace equipoise::app
