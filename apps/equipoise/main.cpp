// equipoise: will this automatic balancer balance this rotor, how surely, how fast?
#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <exception>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include "equipoise/analyses/design/search.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"
#include "equipoise/study/toml/overrides.hpp"
#include "streams.hpp"
#include "team.hpp"
#include "usage.hpp"

namespace equipoise::app {

StopFlag& stop_flag() {
  static StopFlag flag{false};
  return flag;
}

namespace {

// A second Ctrl-C ends the program at once. timeout(1) and schedulers signal a program and its whole group, so it
// receives two signals within a moment; these count as one request.
void ask_to_stop(int signal) {
  constexpr std::int64_t moment = 500'000'000;  // nanoseconds
  static std::atomic<std::int64_t> asked_at{0};
  timespec clock{};
  clock_gettime(CLOCK_MONOTONIC, &clock);
  const std::int64_t now = clock.tv_sec * std::int64_t{1'000'000'000} + clock.tv_nsec;
  std::int64_t first = 0;
  if (asked_at.compare_exchange_strong(first, now)) {
    stop_flag().store(true);
  } else if (now - first > moment) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

std::string version_text() {
  return fmt::format("equipoise {}\ncompiler: {}\nCPU targets here: {}; using {}\noptimisers: {}\nMPI: {}\n",
                     version_string, __VERSION__, fmt::join(cpu_targets(), ", "), cpu_target(), optimisers_version(),
                     mpi_text());
}

// "help basin" means "basin --help". The name of an unknown command stays, to be reported.
std::vector<char*> words_of(const CLI::App& app, int argc, char** argv) {
  static char help[] = "--help";
  std::vector<char*> words(argv, argv + argc);
  if (argc < 2 || argv[1] != std::string_view("help")) return words;
  words.erase(words.begin() + 1);
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  const bool of_all = argc == 2;
  if (of_all || std::any_of(commands.begin(), commands.end(), [&](const auto* c) { return c->get_name() == argv[2]; }))
    words.insert(words.begin() + (of_all ? 1 : 2), help);
  return words;
}

int run(int given, char** arguments) {
  CLI::App app("Will this automatic balancer balance this rotor, how surely and how fast?");
  app.name("equipoise");
  fold_help(app);
  app.require_subcommand(1);
  app.set_version_flag("--version", version_text);
  app.footer(
      "Exit codes: 0 done, 1 failed, 2 bad usage or study, 3 not proved or damaged, 4 out of time (--within) with a "
      "partial answer, 130 interrupted with results kept.\nData go to standard output, all else to standard error.");
  std::vector<std::pair<CLI::App*, Command>> commands;
  const auto add = [&](const char* name, const char* description, Command (*make)(CLI::App&)) {
    CLI::App* sub = app.add_subcommand(name, description);
    commands.emplace_back(sub, make(*sub));
  };
  add("attractors", "every steady motion of the final speed: refined, named, with its share", add_attractors);
  add("basin", "shares of starts that end in each attractor, with intervals", add_basin);
  add("capacity", "the largest unbalance, or other parameter, at which a stated share of starts balances",
      add_capacity);
  add("certify", "a proof that trajectories near balance end balanced, or the check of one", add_certify);
  add("chart", "curves in a plane of two parameters on which balance changes, and what is proved beside", add_chart);
  add("check", "what was understood of a study, what was assumed, and which estimate matters most", add_check);
  add("compare", "two studies or results on common starts: how much more often the second balances", add_compare);
  add("design", "the best balancer or spin-up among allowed choices, with margins and evidence", add_design);
  add("explain", "a study in physical and dimensionless form, and what follows without simulation", add_explain);
  add("inspect", "what a file of results holds, how complete and whether damaged", add_inspect);
  add("map", "the outcome of a start at every pixel of a plane of two quantities", add_map);
  add("merge", "joins files of one sweep from several machines or runs", add_merge);
  add("new", "a commented study to start from: a washing machine, a fan, any machine", add_new);
  add("report", "a page on one machine for two printed sheets: verdict, shares, motions, peaks, runs", add_report);
  add("reproduce", "what Wright and Peng (2019) published, computed again and judged", add_reproduce);
  add("simulate", "one trajectory at stated times", add_simulate);
  add("stability", "where balance is stable in a plane of two parameters, by eigenvalues alone", add_stability);
  add("sweep", "shares at every combination of some parameters' values", add_sweep);
  std::vector<char*> words = words_of(app, given, arguments);
  const int argc = static_cast<int>(words.size());
  char** argv = words.data();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) {
      std::ostringstream text;
      const int code = app.exit(e, text, text);
      put(text.str());
      return code;
    }
    say(usage_error(app, e, argc, argv));
    return bad_input;
  }
  for (auto& [sub, command] : commands) {
    if (!sub->parsed()) continue;
    if (repeats_work(*sub)) return bad_input;
    refuse_empty_values(*sub);
    refuse_same_files(*sub);
    return command();
  }
  return bad_input;
}

InputError from_options(const InputError& e) {
  const std::string_view name = overrides_name;
  if (!e.where().starts_with(name)) return e;
  return {"--set" + e.where().substr(name.size()), e.key(), e.value(), e.problem()};
}

int run_guarded(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (...) {
    return say_error(std::current_exception());
  }
}

}  // namespace

int say_error(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const InputError& e) {
    say(from_options(e).what());
    return bad_input;
  } catch (const std::bad_alloc&) {
    say("out of memory: the system gives no more to this process");
    return failed;
  } catch (const std::system_error& e) {
    say(e.code() == std::errc::resource_unavailable_try_again ? "the system makes no more threads for this process"
                                                              : e.what());
    return failed;
  } catch (const std::exception& e) {
    say(e.what());
    return failed;
  }
}

}  // namespace equipoise::app

int main(int argc, char** argv) {
  using namespace equipoise;
  app::claim_streams();
  struct sigaction asked {};  // without SA_RESTART: opening or writing to a pipe that nobody reads ends
  asked.sa_handler = app::ask_to_stop;
  sigaction(SIGINT, &asked, nullptr);
  sigaction(SIGTERM, &asked, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is reported like a full disk
  return app::close_output(app::run_guarded(argc, argv));
}
