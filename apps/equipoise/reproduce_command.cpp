// equipoise reproduce: the tables and figures of Wright and Peng (2019), computed again and judged.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include "equipoise/report/reproduction.hpp"
#include "equipoise/report/reproduction_charts.hpp"
#include "equipoise/report/reproduction_document.hpp"
#include "equipoise/run/basin.hpp"
#include "equipoise/run/lane_kernels.hpp"
#include "equipoise/run/paper_figures.hpp"
#include "equipoise/run/reproduce.hpp"
#include "gnuplot.hpp"
#include "options.hpp"
#include "progress.hpp"

namespace equipoise::app {

namespace {

namespace fs = std::filesystem;

struct ReproduceArguments {
  std::vector<std::string> what;
  std::optional<std::string> starts, threads;
  std::string law = "both", output, report, cpu;
  bool json = false, quiet = false;
};

// What is to be made, in the order of the paper.
struct Plan {
  std::vector<int> tables;
  std::vector<std::string> figures;
};

std::vector<std::string> choices() {
  std::vector<std::string> list;
  for (int table = 1; table <= 7; ++table) list.push_back(fmt::format("table-{}", table));
  list.insert(list.end(), paper_figure_ids().begin(), paper_figure_ids().end());
  list.insert(list.end(), {"tables", "figures", "all"});
  return list;
}

Plan plan_of(const std::vector<std::string>& what) {
  for (const std::string& w : what)
    if (const auto known = choices(); std::find(known.begin(), known.end(), w) == known.end())
      throw InputError("reproduce", "", w, fmt::format("must be among {}", fmt::join(known, ", ")));
  const auto asked = [&](const std::string& one, const std::string& group) {
    return what.empty() || std::any_of(what.begin(), what.end(),
                                       [&](const std::string& w) { return w == "all" || w == group || w == one; });
  };
  Plan plan;
  for (int table = 1; table <= 7; ++table)
    if (asked(fmt::format("table-{}", table), "tables")) plan.tables.push_back(table);
  for (const std::string& id : paper_figure_ids())
    if (asked(id, "figures")) plan.figures.push_back(id);
  return plan;
}

// Where pictures go: into the folder of results, else beside a Markdown report, else, for a page that takes them in,
// into a folder that is removed afterwards.
class PictureFolder {
 public:
  explicit PictureFolder(const ReproduceArguments& a) {
    if (!a.output.empty())
      path_ = a.output + "/pictures";
    else if (a.report.ends_with(".md"))
      path_ = a.report.substr(0, a.report.size() - 3) + "-pictures";
    else if (!a.report.empty()) {
      std::string name = (fs::temp_directory_path() / "equipoise-XXXXXX").string();
      if (!mkdtemp(name.data())) throw RunError(name + ": no temporary folder can be made");
      path_ = name;
      temporary_ = true;
    }
    if (path_.empty()) return;
    std::error_code error;
    fs::create_directories(path_, error);
    if (error) throw InputError("--output", "", path_, "must be a folder that can be written");
  }
  ~PictureFolder() {
    std::error_code ignored;
    if (temporary_) fs::remove_all(path_, ignored);
  }
  PictureFolder(const PictureFolder&) = delete;
  PictureFolder& operator=(const PictureFolder&) = delete;

  const std::string& path() const { return path_; }
  bool temporary() const { return temporary_; }

 private:
  std::string path_;
  bool temporary_ = false;
};

void write_file(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw RunError(path + ": writing failed");
}

// A picture as PNG, and as SVG where it is kept.
void picture(Reproduction& r, const PictureFolder& folder, const std::string& id, const std::string& title,
             const std::vector<Chart>& charts) {
  const std::string stem = folder.path() + "/" + id;
  draw(stem + ".png", chart_plot_script(title, charts, stem + ".png"));
  if (!folder.temporary()) draw(stem + ".svg", chart_plot_script(title, charts, stem + ".svg"));
  r.pictures.push_back({id, title, stem + ".png"});
}

void draw_all(Reproduction& r, const PictureFolder& folder) {
  for (const ReproducedTable& t : r.tables)
    if (const auto chart = table_chart(t)) {
      Chart untitled = *chart;
      untitled.title.clear();
      picture(r, folder, fmt::format("table-{}", t.published->number), chart->title, {untitled});
    }
  for (const PaperFigure& f : r.figures) {
    picture(r, folder, f.id, f.title, figure_charts(f));
    if (!folder.temporary()) write_file(folder.path() + "/" + f.id + ".csv", figure_csv(f));
  }
}

ReproduceOptions table_options(const ReproduceArguments& a, const Plan& plan) {
  ReproduceOptions options;
  options.tables = plan.tables;
  if (a.threads)
    options.threads = option_number<int>("--threads", *a.threads, 1, 4096, "a whole number from 1 to 4096");
  if (a.starts)
    options.starts =
        option_number<std::uint64_t>("--starts", *a.starts, 1, 1'000'000'000, "a whole number from 1 to 1000000000");
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
  if (a.law != "both") text += " --law " + a.law;
  if (!a.report.empty()) text += " --report " + fs::path(a.report).filename().string();
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

int run_reproduce(const ReproduceArguments& a) {
  choose_cpu(a.cpu);
  const Plan plan = plan_of(a.what);
  ReproduceOptions options = table_options(a, plan);
  if (!a.report.empty() && !a.report.ends_with(".html") && !a.report.ends_with(".md"))
    throw InputError("--report", "", a.report, "must be a file name that ends in .html or .md");
  require_writable("--report", a.report);
  const bool pictures = !a.report.empty() || !a.output.empty();
  if (pictures) require_gnuplot(a.report.empty() ? "--output" : "--report", a.report.empty() ? a.output : a.report);
  const PictureFolder folder(a);

  ProgressLine progress(a.quiet);
  options.progress = [&](const ReproduceProgress& p) { progress.update(p.done, p.total, p.what); };
  Reproduction r;
  r.command = command_line(a);
  r.cpu_target = cpu_target();
  r.tables = reproduce_tables(options);
  r.threads = thread_count(options.threads);
  r.conclusions = judge_conclusions(r.tables);
  total(r);
  for (const std::string& id : plan.figures)
    if (!stop_flag()) r.figures.push_back(paper_figure(id, &stop_flag()));
  progress.finish();
  r.partial = stop_flag();
  if (pictures && !r.partial) draw_all(r, folder);

  if (a.report.ends_with(".html")) write_file(a.report, document_html(reproduction_document(r)));
  if (a.report.ends_with(".md"))
    write_file(a.report, document_markdown(reproduction_document(r),
                                           fs::proximate(folder.path(), fs::path(a.report).parent_path()).string()));
  if (!a.output.empty()) write_file(a.output + "/reproduction.json", reproduction_json(r));
  if (folder.temporary()) r.pictures.clear();
  fmt::print("{}", a.json ? reproduction_json(r) : reproduction_text(r));
  return r.partial ? interrupted : r.differs() ? check_failed : done;
}

}  // namespace

Command add_reproduce(CLI::App& app) {
  const auto a = std::make_shared<ReproduceArguments>();
  app.add_option("what", a->what, fmt::format("any of {} (default: all)", fmt::join(choices(), ", ")))
      ->type_name("WHAT");
  app.add_option("--starts", a->starts, "starts an ensemble (default: as many as the paper used)")->type_name("N");
  app.add_option("--law", a->law, "speed law of ramps (default: both)")
      ->check(CLI::IsMember({"published", "kinematic", "both"}))
      ->type_name("LAW");
  app.add_option("--report", a->report, "one page with everything (HTML), or Markdown with pictures beside it")
      ->type_name("FILE.html|.md");
  app.add_option("-o,--output", a->output, "folder for ensembles, pictures and tables; the same command resumes")
      ->type_name("DIR");
  app.add_option("--threads", a->threads, "threads (default: all cores)")->type_name("T");
  app.add_option("--cpu", a->cpu, "instruction set to use instead of the best (see --version)")->type_name("NAME");
  app.add_flag("--json", a->json, "print one JSON object");
  app.add_flag("--quiet", a->quiet, "no progress");
  return [a] { return run_reproduce(*a); };
}

}  // namespace equipoise::app
