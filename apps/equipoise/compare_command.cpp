// equipoise compare: two studies, or results, on common starts.
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "equipoise/analyses/one_study/comparison.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "streams.hpp"
#include "time_limit.hpp"

namespace equipoise::app {

namespace {

struct CompareArguments : CommonArguments {
  std::string first, second;
  std::vector<std::string> second_overrides;
  bool transients = false;
};

// Read and checked before any work starts.
ComparedSide side(const std::string& given, const CompareArguments& a, bool second) {
  const bool set = !a.overrides.empty() || (second && !a.second_overrides.empty());
  if (given.ends_with(".nc")) {
    if (set || a.starts || a.seed)
      throw InputError(given, set ? "--set" : "--starts, --seed", "", "go with studies; a result is already computed");
    return ComparedSide(given);
  }
  CommonArguments with = a;
  if (second) with.overrides.insert(with.overrides.end(), a.second_overrides.begin(), a.second_overrides.end());
  return ComparedSide(read_study(given, overrides_of(with)));
}

int run_compare(const CompareArguments& a) {
  RunOptions options;
  begin_computing(a, options);
  const ComparedSide first = side(a.first, a, false), second = side(a.second, a, true);
  ProgressLine progress(a.quiet, options);
  RunOptions of_first = options;
  if (second.study) of_first.stop_asked = half_of_the_time();
  const auto begin = std::chrono::steady_clock::now();
  const ComparisonResult result =
      compare(first, second, of_first, options, a.transients ? std::optional(true) : std::nullopt);
  progress.finish();
  put(a.json ? json_text(result) : result_text(result, text_style()));
  if (!result.partial || !(stop_flag() || time_is_limited())) return done;
  const Study& asked = second.study ? *second.study : first.study.value_or(result.first);
  WorkLeft left{result.starts, asked.sampling.starts, "starts of both"};
  const double taken = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (left.done > 0) left.seconds = taken * (static_cast<double>(left.total) / static_cast<double>(left.done) - 1.0);
  return ended_early(left, nullptr, "");
}

}  // namespace

Command add_compare(CLI::App& app) {
  const auto a = std::make_shared<CompareArguments>();
  app.add_option("first", a->first, "study file (TOML), or a result of basin -o (.nc)")->required()->type_name("FIRST");
  app.add_option("second", a->second, "study file or result to compare with it")->required()->type_name("SECOND");
  add_starts(app, *a, "number of runs of each", "seed of the random starts, the same for both");
  app.add_option("--set-second", a->second_overrides, "override a key of the second study only; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all();
  app.add_flag("--transients", a->transients,
               "also compare peak vibration, forces and settling time (default if a study has [limits])");
  add_usual(app, *a);
  add_json(app, a->json);
  return [a] { return run_compare(*a); };
}

}  // namespace equipoise::app
