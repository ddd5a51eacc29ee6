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
#include "options.hpp"
#include "progress.hpp"
#include "reproduce_files.hpp"
#include "streams.hpp"
#include "time_limit.hpp"
#include "help.hpp"
#include "words.hpp"

namespace equipoise::app {

namespace {

namespace fs = std::filesystem;

struct ReproduceArguments : ComputingArguments {
  std::vector<std::string> what;
  std::optional<std::string> starts, pixels;
  std::string law = "both", output, report, explorer;
  bool json = false;
};

// Each WHAT may be several, separated by commas.
std::vector<std::string> split(const std::vector<std::string>& what) {
  std::vector<std::string> names;
  for (const std::string& list : what)
    for (std::size_t begin = 0; begin <= list.size();) {
      const std::size_t end = std::min(list.find(',', begin), list.size());
      if (end > begin || list.empty()) names.push_back(list.substr(begin, end - begin));
      begin = end + 1;
    }
  return names;
}

ReproduceOptions options_from(const ReproduceArguments& a) {
  ReproduceOptions options = options_for(a.what);
  if (a.pixels) options.slice_pixels = option_number<int>("--pixels", *a.pixels, 2, 4096, words::pixel_range);
  options.threads = threads_option(a.threads);
  if (a.starts)
    options.starts = option_number<std::uint64_t>("--starts", *a.starts, 1, 1'000'000'000, words::paper_start_range);
  options.laws = option_choice<LawChoice>("--law", a.law, law_choice_names);
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

void check_paths(const ReproduceArguments& a) {
  require_ending("--report", a.report, ".html");
  if (!a.explorer.empty() && a.report.empty()) throw InputError("--explorer", "", a.explorer, words::report_only);
  require_writable("--report", a.report);
}

int run_reproduce(ReproduceArguments& a) {
  begin_computing(a);
  a.what = split(a.what);
  ReproduceOptions options = options_from(a);
  check_paths(a);
  const std::string folder = picture_folder(a.output);
  ProgressLine progress(a.quiet);
  progress.listen(options);
  Reproduction r = reproduce(options);
  progress.finish();
  r.command = command_line(a);
  if (!r.partial) write_reproduction(r, a.report, a.explorer, folder);
  if (!a.output.empty()) write_file(a.output + "/reproduction.json", reproduction_json(r));
  put(a.json ? reproduction_json(r) : reproduction_text(r, text_style()));
  std::optional<WorkLeft> left = progress.left();
  if (left && left->total > 0) left->what = words::starts;
  return r.partial ? ended_early(left, "-o DIR", a.output) : r.differs() ? check_failed : done;
}

}  // namespace

Command add_reproduce(CLI::App& app) {
  const auto a = std::make_shared<ReproduceArguments>();
  app.add_option("what", a->what, fmt::format(help::reproduce::what, fmt::join(reproducible(), ", ")))
      ->type_name("WHAT");
  app.add_option("--starts", a->starts, help::reproduce::starts)->type_name("N");
  app.add_option("--law", a->law, help::reproduce::law)->type_name("LAW");
  app.add_option("--report", a->report, help::reproduce::report)->type_name("FILE.html");
  app.add_option("--explorer", a->explorer, help::reproduce::explorer)->type_name("PAGE");
  app.add_option("-o,--output", a->output, help::reproduce::output)->type_name("DIR");
  app.add_option("--pixels", a->pixels, help::reproduce::pixels)->type_name("P");
  add_wide(app);
  add_computing(app, *a);
  app.add_flag("--json", a->json, help::json);
  return [a] { return run_reproduce(*a); };
}

}  // namespace equipoise::app
