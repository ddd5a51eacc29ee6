// equipoise: will a ball balancer work on this rotor?
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
#include "equipoise/core/base/interrupted.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"
#include "equipoise/study/toml/overrides.hpp"
#include "help.hpp"
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
  CLI::App app;
  app.name("equipoise");
  app.set_help_flag("-h,--help", "print this help");
  set_help(app);
  app.require_subcommand(1);
  app.set_version_flag("--version", version_text);
  std::vector<std::pair<CLI::App*, Command>> commands;
  for (const CommandGroup& group : command_groups())
    for (const CommandEntry& command : group.commands) {
      CLI::App* sub = app.add_subcommand(command.name, command.words);
      commands.emplace_back(sub, command.add(*sub));
    }
  if (given < 2) {
    put_error(program_help());
    return bad_input;
  }
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
    say(usage_error(app, e, argv));
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
  } catch (const Interrupted& e) {
    say(e.what());
    return interrupted;
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
  struct sigaction asked {};  // without SA_RESTART: opening or writing to a pipe without a reader ends
  asked.sa_handler = app::ask_to_stop;
  sigaction(SIGINT, &asked, nullptr);
  sigaction(SIGTERM, &asked, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is reported like a full disk
  return app::close_output(app::run_guarded(argc, argv));
}
