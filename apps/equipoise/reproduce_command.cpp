// equipoise reproduce: the tables and figures of Wright and Peng (2019), computed again and judged.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "commands.hpp"
#include "equipoise/report/reproduction.hpp"
#include "equipoise/run/lane_kernels.hpp"
#include "equipoise/run/reproduce.hpp"
#include "options.hpp"
#include "progress.hpp"

namespace equipoise::app {

namespace {

struct ReproduceArguments {
  std::vector<std::string> what;
  std::optional<std::string> starts, threads;
  std::string law = "both", output, report, cpu;
  bool json = false, quiet = false;
};

int run_reproduce(const ReproduceArguments& a) {
  choose_cpu(a.cpu);
  ReproduceOptions options;
  for (int table = 1; table <= 7; ++table) {
    const bool asked = a.what.empty() || std::any_of(a.what.begin(), a.what.end(), [&](const std::string& w) {
                         return w == "all" || w == "tables" || w == fmt::format("table-{}", table);
                       });
    if (asked) options.tables.push_back(table);
  }
  if (a.threads)
    options.threads = option_number<int>("--threads", *a.threads, 1, 4096, "a whole number from 1 to 4096");
  if (a.starts)
    options.starts =
        option_number<std::uint64_t>("--starts", *a.starts, 1, 1'000'000'000, "a whole number from 1 to 1e9");
  options.laws = a.law == "published"   ? LawChoice::published
                 : a.law == "kinematic" ? LawChoice::kinematic
                                        : LawChoice::both;
  if (!a.output.empty()) options.folder = a.output + "/ensembles";
  options.stop = &stop_flag();
  ProgressLine progress(a.quiet);
  options.progress = [&](const ReproduceProgress& p) { progress.update(p.done, p.total, p.what); };
  Reproduction r;
  r.tables = reproduce_tables(options);
  progress.finish();
  r.conclusions = judge_conclusions(r.tables);
  r.partial = stop_flag();
  fmt::print("{}", a.json ? reproduction_json(r) : reproduction_text(r));
  return r.partial ? interrupted : r.differs() ? check_failed : done;
}

}  // namespace

Command add_reproduce(CLI::App& app) {
  const auto a = std::make_shared<ReproduceArguments>();
  app.add_option("what", a->what, "table-1 to table-7, figure-..., future, all")->type_name("WHAT");
  app.add_option("--starts", a->starts, "starts an ensemble (default: as many as the paper used)")->type_name("N");
  app.add_option("--law", a->law, "speed law of ramps")->check(CLI::IsMember({"published", "kinematic", "both"}));
  app.add_option("-o,--output", a->output, "folder for ensembles and pictures; the same command resumes")
      ->type_name("DIR");
  app.add_option("--threads", a->threads, "threads (default: all cores)")->type_name("T");
  app.add_option("--cpu", a->cpu, "instruction set to use instead of the best (see --version)")->type_name("NAME");
  app.add_flag("--json", a->json, "print one JSON object");
  app.add_flag("--quiet", a->quiet, "no progress");
  return [a] { return run_reproduce(*a); };
}

}  // namespace equipoise::app
