// equipoise reproduce: what Wright and Peng (2019) and other publications printed, computed again and judged.
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/extras/publications/publication_verdicts.hpp"
#include "equipoise/extras/reproduction/reproduce.hpp"
#include "equipoise/extras/reproduction/reproduction.hpp"
#include "equipoise/report/drawing/document.hpp"
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
  bool json = false, list = false;
};

// Names of publications, if that is what is asked for; each WHAT may be several, separated by commas.
std::vector<std::string> publications_in(const ReproduceArguments& a) {
  std::vector<std::string> names;
  std::size_t parts = 0;
  for (const std::string& name : a.what) {
    if (name == "publications")
      for (const Publication& p : publications()) names.emplace_back(p.name);
    else if (find_publication(name))
      names.push_back(name);
    else if (++parts; !names.empty())
      throw InputError("reproduce", "", name, words::publications_alone);
  }
  if (parts > 0 && !names.empty()) throw InputError("reproduce", "", names.front(), words::publications_alone);
  return names;
}

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
  if (!a.report.empty() && !a.report.ends_with(".html") && !a.report.ends_with(".md"))
    throw InputError("--report", "", a.report, fmt::format(words::ends_in_either, ".html", ".md"));
  if (!a.explorer.empty() && a.report.empty()) throw InputError("--explorer", "", a.explorer, words::report_only);
  require_writable("--report", a.report);
}

int run_publications(const ReproduceArguments& a, const std::vector<std::string>& names) {
  for (const auto& [option, given] : {std::pair{"--starts", a.starts.has_value()},
                                      {"--pixels", a.pixels.has_value()},
                                      {"--law", a.law != "both"},
                                      {"--output", !a.output.empty()},
                                      {"--explorer", !a.explorer.empty()}})
    if (given) throw InputError(option, "", names.front(), words::only_of_the_paper);
  if (!a.report.empty() && !a.report.ends_with(".html") && !a.report.ends_with(".md"))
    throw InputError("--report", "", a.report, fmt::format(words::ends_in_either, ".html", ".md"));
  require_writable("--report", a.report);
  ProgressLine progress(a.quiet);
  RunOptions options;
  options.threads = threads_option(a.threads);
  options.stop = &stop_flag();
  progress.listen(options);
  JudgedPublications r = judge_publications(names, options);
  progress.finish();
  r.command = command_line(a);
  if (!a.report.empty() && !r.partial) {
    const Document page = publications_document(r);
    write_file(a.report, a.report.ends_with(".md") ? document_markdown(page, "") : document_html(page));
  }
  put(a.json ? publications_json(r) : publications_text(r));
  std::optional<WorkLeft> left = progress.left();
  if (left && left->total > 0) {
    left->what = words::rows;
    left->seconds.reset();  // a row takes a moment or minutes
  }
  return r.partial ? ended_early(left, nullptr, "") : r.differs() ? check_failed : done;
}

int run_reproduce(ReproduceArguments& a) {
  if (a.list) {
    put(publications_list(reproducible()));
    return done;
  }
  begin_computing(a);
  a.what = split(a.what);
  if (const auto names = publications_in(a); !names.empty()) return run_publications(a, names);
  ReproduceOptions options = options_from(a);
  check_paths(a);
  const std::string folder = picture_folder(a.output, a.report);
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
  app.add_flag("--list", a->list, help::reproduce::list);
  app.add_option("--starts", a->starts, help::reproduce::starts)->type_name("N");
  app.add_option("--law", a->law, help::reproduce::law)->type_name("LAW");
  app.add_option("--report", a->report, help::reproduce::report)->type_name("FILE.html|.md");
  app.add_option("--explorer", a->explorer, help::reproduce::explorer)->type_name("PAGE");
  app.add_option("-o,--output", a->output, help::reproduce::output)->type_name("DIR");
  app.add_option("--pixels", a->pixels, help::reproduce::pixels)->type_name("P");
  add_wide(app);
  add_computing(app, *a);
  app.add_flag("--json", a->json, help::json);
  return [a] { return run_reproduce(*a); };
}

}  // namespace equipoise::app
