// Options that several commands share.
#include "options.hpp"

#include <cstdlib>
#include <string_view>
#include <algorithm>
#include <cstdint>
#include <limits>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include "equipoise/results/io/replacement.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"
#include "equipoise/study/echo/given_value.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "commands.hpp"
#include "streams.hpp"
#include "time_limit.hpp"

namespace equipoise::app {

double option_time(const char* option, const std::string& text, const Study& study, double least, double most,
                   const char* allowed) {
  const auto unit = study::unit_of(study, study::Dimension::time);
  const study::GivenValue given = study::read_given(text, unit);
  if (given.problem.empty() && given.value >= least && given.value <= most) return given.value;
  std::string problem = fmt::format("must be {}", allowed);
  if (unit)
    problem = fmt::format("must be {}, in 1/omega_c, or a time, such as \"10 s\"", allowed);
  else if (study::measure(text, {study::Dimension::time}).problem.empty())
    problem = fmt::format("must be {}: this study has no units", allowed);
  throw InputError(option, "", display_text(text), problem);
}

double half_width_option(const std::string& text) {
  return option_number<double>("--half-width", text, 1e-6, 0.5, "a fraction of one from 1e-6 to 0.5");
}

int threads_option(const std::optional<std::string>& text) {
  if (!text) return 0;
  const int threads = option_number<int>("--threads", *text, 1, 4096, "a whole number from 1 to 4096");
  // TBB makes no more threads than the machine has cores unless allowed to, and complains on standard error.
  static std::optional<tbb::global_control> allowed;
  const auto cores = static_cast<std::size_t>(tbb::info::default_concurrency());
  allowed.emplace(tbb::global_control::max_allowed_parallelism,
                  std::max(cores, static_cast<std::size_t>(thread_count(threads))));
  return threads;
}

std::vector<std::string> overrides_of(const CommonArguments& a) {
  constexpr std::uint64_t most = 1'000'000'000'000, largest = std::numeric_limits<std::int64_t>::max();
  std::vector<std::string> overrides = a.overrides;
  if (a.starts) {
    const auto n =
        option_number<std::uint64_t>("--starts", *a.starts, 1, most, "a whole number from 1 to 1000000000000");
    overrides.push_back(fmt::format("sampling.starts={}", n));
  }
  if (a.seed) {
    const auto s =
        option_number<std::uint64_t>("--seed", *a.seed, 0, largest, "a whole number from 0 to 9223372036854775807");
    overrides.push_back(fmt::format("sampling.seed={}", s));
  }
  return overrides;
}

StudySource source_of(const CommonArguments& a) {
  return {read_study_text(a.study), display_text(a.study), overrides_of(a)};
}

Study at_medians(Study study) {
  if (study.uncertain.empty()) return study;
  std::string values;
  for (const UncertainValue& v : study.uncertain.values)
    values += fmt::format("{}{} = {}{}", values.empty() ? "" : ", ", v.key, v.text(v.taken()),
                          v.has_no_direction() ? " (a quarter turn: it is drawn all round)" : "");
  say("uncertain values are at their medians: {}", values);
  return with_medians(std::move(study));
}

void require_writable(const char* option, const std::string& path) {
  if (path.empty()) return;
  const bool results = path.ends_with(".nc");
  if (const std::string problem = results ? io::why_no_results_at(path) : io::why_not_writable(path); !problem.empty())
    throw InputError(option, "", path,
                     fmt::format("cannot be written: {}; must be a file in a folder that exists", problem));
}

void require_ending(const char* option, const std::string& path, const char* first, const char* second) {
  if (path.empty() || path.ends_with(first) || (second && path.ends_with(second))) return;
  throw InputError(option, "", display_text(path),
                   second ? fmt::format("must be a file name that ends in {} or {}", first, second)
                          : fmt::format("must be a file name that ends in {}", first));
}

void write_file(const std::string& path, const std::string& text) { io::write_whole(path, text); }

CLI::Option* add_study(CLI::App& app, CommonArguments& a, const char* words) {
  return app.add_option("study", a.study, words)->required()->type_name("STUDY");
}

void add_starts(CLI::App& app, CommonArguments& a, const char* starts, const char* seed) {
  app.add_option("--starts", a.starts, starts)->type_name("N");
  app.add_option("--seed", a.seed, seed)->type_name("S");
}

void add_overrides(CLI::App& app, std::vector<std::string>& overrides) {
  app.add_option("--set", overrides, "override a study key, e.g. speed.final=2.6; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all();
}

std::string own_sweep(const std::string& study) { return fmt::format("{}: [sweep] over", study); }

namespace {
TextStyle& asked_style() {
  static TextStyle style;
  return style;
}
}  // namespace

void add_no_changes(CLI::App& app, bool& no_changes) {
  app.add_flag("--no-changes", no_changes, "if the verdict is negative, don't test standard improvements");
}

void add_wide(CLI::App& app) {
  app.add_flag_callback(
      "--wide", [] { asked_style().width = 0; }, "all columns, no line wrapping");
}

void add_details(CLI::App& app) {
  app.add_flag_callback(
      "--details", [] { asked_style().details = true; },
      "everything: clamped balls, contact, how runs were decided, all figures with intervals");
}

TextStyle text_style() {
  TextStyle style = asked_style();
  const char *off = std::getenv("NO_COLOR"), *terminal = std::getenv("TERM");
  style.colour = output_is_terminal() && !(off && *off) && terminal && std::string_view(terminal) != "dumb";
  return style;
}

void add_usual(CLI::App& app, CommonArguments& a) {
  add_wide(app);
  add_overrides(app, a.overrides);
  add_computing(app, a);
}

void add_quiet(CLI::App& app, bool& quiet) { app.add_flag("--quiet", quiet, "no progress line"); }

void add_zip(CLI::App& app, bool& zip) {
  app.add_flag("--zip", zip, "vary the parameters together, step by step, instead of in all combinations");
}

void add_json(CLI::App& app, bool& json) { app.add_flag("--json", json, "print one JSON object"); }

void add_computing(CLI::App& app, CommonArguments& a) {
  app.add_option("--threads", a.threads, "threads (default: all cores)")->type_name("T");
  app.add_option("--cpu", a.cpu, "instruction set to use instead of the best (see --version)")->type_name("NAME");
  add_within(app, a.within);
  add_quiet(app, a.quiet);
}

void begin_computing(const CommonArguments& a) {
  begin_time(a.within);
  if (!a.cpu.empty()) require_cpu_target(a.cpu, "--cpu", "");
}

void begin_computing(const CommonArguments& a, RunOptions& options) {
  begin_computing(a);
  options.threads = threads_option(a.threads);
  options.stop = &stop_flag();
}

}  // namespace equipoise::app
