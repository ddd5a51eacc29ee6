// Options that several commands share.
#pragma once

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <system_error>
#include <type_traits>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/analyses/sweeps/sweep_plan.hpp"
#include "equipoise/core/base/read_number.hpp"
#include "equipoise/core/running/run_options.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise::app {

/// A decimal number given as an option. A bad one gets the same kind of error as in a study.
template <class T>
T option_number(const char* option, const std::string& text, T low, T high, const char* allowed) {
  T value{};
  bool whole = false;
  if constexpr (std::is_floating_point_v<T>) {
    const auto number = number_of_all(text);
    whole = number.has_value();
    value = number.value_or(value);
  } else {
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value);
    whole = read.ec == std::errc() && read.ptr == end;
  }
  if (!whole || !(value >= low && value <= high))
    throw InputError(option, "", display_text(text), fmt::format("must be {}", allowed));
  return value;
}

/// A time given as an option, in 1/omega_c: a plain number or, if the study has scales, a quantity such as "2 s".
/// `least` and `most` bound it.
double option_time(const char* option, const std::string& text, const Study& study, double least, double most,
                   const char* allowed);

/// A value of an enumeration by its name, given as an option; `names` are in the order of the values.
template <class Enumeration, class Names>
Enumeration option_choice(const char* option, const std::string& text, const Names& names) {
  const auto at = std::find(names.begin(), names.end(), text);
  if (at != names.end()) return static_cast<Enumeration>(at - names.begin());
  throw InputError(option, "", display_text(text), fmt::format("must be one of: {}", fmt::join(names, ", ")));
}

/// --half-width H.
double half_width_option(const std::string& text);
/// --threads T; 0 if absent, for all cores. More threads than cores are made if requested.
int threads_option(const std::optional<std::string>& text);

/// What most commands take. One that lacks an option leaves its member as it is.
struct CommonArguments {
  std::string study, output, cpu;
  std::vector<std::string> overrides;
  std::optional<std::string> starts, seed, threads, within;
  bool json = false, quiet = false;
};
/// STUDY.
CLI::Option* add_study(CLI::App& app, CommonArguments& a, const char* words = "study file (TOML)");
/// --starts and --seed.
void add_starts(CLI::App& app, CommonArguments& a, const char* starts = "number of runs",
                const char* seed = "seed of the random starts");
/// --set KEY=VALUE, repeated.
void add_overrides(CLI::App& app, std::vector<std::string>& overrides);
/// --threads, --cpu, --within and --quiet, which all commands have that compute.
void add_computing(CLI::App& app, CommonArguments& a);
/// --wide, --set and those of add_computing().
void add_usual(CLI::App& app, CommonArguments& a);
/// --json, --quiet, --zip.
void add_json(CLI::App& app, bool& json);
void add_quiet(CLI::App& app, bool& quiet);
void add_zip(CLI::App& app, bool& zip);

/// The command's time begins, on the instruction set that the user chose.
void begin_computing(const CommonArguments& a);
/// And the options of its work know their threads and what stops them.
void begin_computing(const CommonArguments& a, RunOptions& options);

/// --starts and --seed behind the other overrides.
std::vector<std::string> overrides_of(const CommonArguments& a);
/// The study as written, and what is set on top of it.
StudySource source_of(const CommonArguments& a);

/// The study with its uncertain values at their medians, for commands that draw none; says so in one line.
Study at_medians(Study study);

/// Throws InputError unless a file can be written at `path`, so that work is not lost to a missing folder. Nothing is
/// left behind. An empty path is none.
void require_writable(const char* option, const std::string& path);

/// Throws InputError unless a path is empty or ends in one of the endings; `second` may be null.
void require_ending(const char* option, const std::string& path, const char* first, const char* second = nullptr);

/// Throws RunError, naming the file, if `text` cannot be written whole; the old content then stays.
void write_file(const std::string& path, const std::string& text);

/// Where a study says what to sweep over, for messages.
std::string own_sweep(const std::string& study);

/// --no-changes, of commands that give a verdict.
void add_no_changes(CLI::App& app, bool& no_changes);

/// --wide, of commands whose text has tables or long lines to fit.
void add_wide(CLI::App& app);
/// --details, of commands whose text has them.
void add_details(CLI::App& app);
/// The style that was requested, in colours on a terminal unless NO_COLOR is set (https://no-color.org).
TextStyle text_style();

}  // namespace equipoise::app
