// One deadline per run of the program.
#include "time_limit.hpp"

#include <atomic>
#include <filesystem>

#include <fmt/format.h>

#include "equipoise/core/running/deadline.hpp"
#include "streams.hpp"

namespace equipoise::app {

namespace {

constexpr char rest_unknown[] = "how long the rest takes is not known yet";

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
  if (!left) return rest_unknown;
  if (left->total == 0) return fmt::format("it was at \"{}\"; {}", left->what, rest_unknown);
  const std::string done = fmt::format("{} of {} {} are done", left->done, left->total, left->what);
  if (!left->seconds) return fmt::format("{}; {}", done, rest_unknown);
  return fmt::format("{}; the rest takes about {} more", done, duration_text(*left->seconds));
}

std::string going_on(Keeper keeper, const std::string& output) {
  if (!output.empty() && (std::filesystem::exists(output) || std::filesystem::exists(output + ".part")))
    return fmt::format("the same command resumes from {}", output);
  if (!output.empty()) return fmt::format("nothing is in {} yet", output);
  if (keeper) return fmt::format("with {} the same command would go on from here", keeper);
  return "this command keeps nothing between runs: give it more time";
}

}  // namespace

void add_within(CLI::App& app, std::optional<std::string>& within) {
  app.add_option("--within", within,
                 "stop after this time and print the results so far, marked PARTIAL: 90, 60s, 10min, 1.5h")
      ->type_name("TIME");
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
    if (keeper) say("stopped; {}", going_on(keeper, output));
    return interrupted;
  }
  say("out of time (--within {}): {}; {}", time_given().given, left_text(left), going_on(keeper, output));
  return out_of_time;
}

}  // namespace equipoise::app
