// One deadline per run of the program.
#include "time_limit.hpp"

#include <atomic>
#include <filesystem>

#include <fmt/format.h>

#include "equipoise/core/running/deadline.hpp"
#include "streams.hpp"
#include "help.hpp"
#include "words.hpp"

namespace equipoise::app {

namespace {

struct Time {
  std::string given;
  std::atomic<bool> half_used{false};  // asked from several threads
  std::optional<Deadline> deadline;
};

Time& time_given() {
  static Time time;
  return time;
}

// "475392 of 3000000 starts are done; the rest takes about 26 s more"
std::string left_text(const std::optional<WorkLeft>& left) {
  if (!left) return words::rest_unknown;
  if (left->total == 0) return fmt::format(words::was_at, left->what, words::rest_unknown);
  const std::string done = fmt::format(words::part_done, left->done, left->total, left->what);
  if (!left->seconds) return fmt::format("{}; {}", done, words::rest_unknown);
  return fmt::format(words::rest_takes, done, duration_text(*left->seconds));
}

std::string going_on(Keeper keeper, const std::string& output) {
  if (!output.empty() && (std::filesystem::exists(output) || std::filesystem::exists(output + ".part")))
    return fmt::format(words::goes_on_from, output);
  if (!output.empty()) return fmt::format(words::nothing_yet, output);
  if (keeper) return fmt::format(words::would_go_on, keeper);
  return words::keeps_nothing;
}

}  // namespace

void add_within(CLI::App& app, std::optional<std::string>& within) {
  app.add_option("--within", within, help::within)->type_name("TIME");
}

void begin_time(const std::optional<std::string>& within) {
  if (!within) return;
  time_given().deadline.emplace(stop_flag(), read_time_limit("--within", *within));
  time_given().given = *within;
}

std::function<bool()> half_of_the_time() {
  if (!time_is_limited()) return {};
  return [] { return time_given().half_used = time_given().half_used || time_given().deadline->half_over(); };
}

bool time_is_over() { return time_is_limited() && time_given().deadline->over(); }

void end_time() {
  if (time_is_limited()) time_given().deadline->end();
}

bool time_is_limited() { return time_given().deadline.has_value(); }

int ended_early(const std::optional<WorkLeft>& left, Keeper keeper, const std::string& output) {
  if (!time_is_limited() || !(time_given().deadline->over() || time_given().half_used)) {
    if (keeper) say(words::stopped, going_on(keeper, output));
    return interrupted;
  }
  say(words::time_over, time_given().given, left_text(left), going_on(keeper, output));
  return out_of_time;
}

}  // namespace equipoise::app
