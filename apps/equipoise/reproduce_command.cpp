// equipoise reproduce: what Wright and Peng (2019) printed, computed again and judged.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/extras/reproduction/reproduction.hpp"
#include "equipoise/report/drawing/plot_svg.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/results/result_files/slice_file.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "streams.hpp"
#include "time_limit.hpp"

namespace equipoise::app {

namespace {

namespace fs = std::filesystem;

struct ReproduceArguments : CommonArguments {
  std::vector<std::string> what;
  std::optional<std::string> pixels;
  std::string law = "both", report, explorer;
};

// Each WHAT may be several, separated by commas.
std::vector<std::string> split(const std::vector<std::string>& what) {
  std::vector<std::string> names;
  for (const std::string& list : what)
    for (const std::string& name : parts_of(list, ','))
      if (!name.empty() || list.empty()) names.push_back(name);
  return names;
}

ReproduceOptions options_from(const ReproduceArguments& a) {
  ReproduceOptions options = options_for(a.what);
  if (a.pixels)
    options.slice_pixels = option_number<int>("--pixels", *a.pixels, 2, 4096, "a whole number from 2 to 4096");
  if (a.starts)
    options.starts =
        option_number<std::uint64_t>("--starts", *a.starts, 1, 1'000'000'000, "a whole number from 1 to 1000000000");
  options.laws = option_choice<LawChoice>("--law", a.law, law_choice_names);
  if (!a.output.empty()) options.folder = a.output + "/ensembles";
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

void check_paths(const ReproduceArguments& a) {
  require_ending("--report", a.report, ".html");
  if (!a.explorer.empty() && a.report.empty()) throw InputError("--explorer", "", a.explorer, "goes with --report");
  require_writable("--report", a.report);
}

void make_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError("--output", "", folder, "must be a folder that can be written");
}

// Every drawing of the document, named and titled by the heading that it stands under.
std::vector<Picture> draw_pictures(const Document& document, const std::string& folder) {
  std::vector<Picture> pictures;
  Heading heading;
  for (const Block& block : document.blocks) {
    if (const auto* next = std::get_if<Heading>(&block)) heading = *next;
    const auto* row = std::get_if<DrawingRow>(&block);
    if (!row) continue;
    pictures.push_back({heading.anchor, heading.text, fmt::format("{}/{}.svg", folder, heading.anchor)});
    write_file(pictures.back().path, document_svg({"", {*row}}, heading.text));
  }
  return pictures;
}

void write_data(const Reproduction& r, const std::string& folder) {
  for (const PaperFigure& f : r.figures) write_file(folder + "/" + f.id + ".csv", figure_csv(f));
  if (!r.open) return;
  write_map_file(folder + "/future-eccentricity-angle.nc", r.open->eccentricity_and_angle);
  write_map_file(folder + "/future-eccentricity-mass.nc", r.open->eccentricity_and_mass);
}

// The folder for picture files in the folder of results, which is made; empty if `output` is.
std::string picture_folder(const std::string& output) {
  if (output.empty()) return "";
  make_folder(output + "/pictures");
  return output + "/pictures";
}

// Draws every table, figure and slice of `r` (SVG) into `folder`, lists them in r.pictures, and puts the figures'
// curves (CSV) and the slices (NetCDF) there; writes the report (HTML). Each may be empty. Throws RunError if a file
// cannot be written.
void write_reproduction(Reproduction& r, const std::string& report, const std::string& explorer,
                        const std::string& folder) {
  const Document document = reproduction_document(r, explorer);
  if (!folder.empty()) {
    r.pictures = draw_pictures(document, folder);
    write_data(r, folder);
  }
  if (!report.empty()) write_file(report, document_html(document));
}

int run_reproduce(ReproduceArguments& a) {
  a.what = split(a.what);
  ReproduceOptions options = options_from(a);
  begin_computing(a, options);
  check_paths(a);
  const std::string folder = picture_folder(a.output);
  ProgressLine progress(a.quiet, options);
  Reproduction r = reproduce(options);
  progress.finish();
  r.command = command_line(a);
  if (!r.partial) write_reproduction(r, a.report, a.explorer, folder);
  if (!a.output.empty()) write_file(a.output + "/reproduction.json", json_text(r));
  put(a.json ? json_text(r) : document_text(reproduction_document(r), text_style()));
  std::optional<WorkLeft> left = progress.left();
  if (left && left->total > 0) left->what = "starts";
  return r.partial ? ended_early(left, "-o DIR", a.output) : r.differs() ? check_failed : done;
}

}  // namespace

Command add_reproduce(CLI::App& app) {
  const auto a = std::make_shared<ReproduceArguments>();
  app.add_option(
         "what", a->what,
         fmt::format("any of {} (default: all), separated by blanks or commas", fmt::join(reproducible(), ", ")))
      ->type_name("WHAT");
  app.add_option("--starts", a->starts, "runs per ensemble (default: as in the paper)")->type_name("N");
  app.add_option("--law", a->law, "speed law of ramps (default: both)")->type_name("LAW");
  app.add_option("--report", a->report, "one HTML page with everything")->type_name("FILE.html");
  app.add_option("--explorer", a->explorer, "link each row to the explorer; give its path relative to the report")
      ->type_name("PAGE");
  app.add_option("-o,--output", a->output, "folder for ensembles, pictures and tables; rerun the command to resume")
      ->type_name("DIR");
  app.add_option("--pixels", a->pixels, "pixels along each side of the maps of `future` (default: 64)")->type_name("P");
  add_wide(app);
  add_computing(app, *a);
  add_json(app, a->json);
  return [a] { return run_reproduce(*a); };
}

}  // namespace equipoise::app
