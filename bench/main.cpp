// equipoise_bench: how fast this engine is, next to its rivals and next to what the machine allows.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "machine.hpp"
#include "table.hpp"
#include "works/works.hpp"

namespace equipoise::bench {

namespace {

constexpr int failed = 1, bad_usage = 2;

const std::vector<std::string> all_works{"full",    "decided", "ramped", "kernel",   "targets",
                                         "threads", "balls",   "starts", "machines", "uncertain"};

const char* const footer =
    "Works:\n"
    "  full     every start of table 2's row Omega = 2.4 to t = 1500: this engine, Boost.Odeint, SUNDIALS, SciPy\n"
    "  decided  whole ensembles as a user runs them\n"
    "  ramped   balls released in mid-ramp, to the end of the ramp: this engine and the same rivals\n"
    "  kernel   operations a second against the machine's peak; ns an evaluation for 1 to 8 balls\n"
    "  targets  full length by instruction set\n"
    "  threads  full length and decided by number of threads\n"
    "  balls    full length by number of balls\n"
    "  starts   time and memory of ensembles of 10^3 to 10^6 starts (10^7 with --long)\n"
    "  machines motors, gravity, contact, stiction, off-centre races and the worked examples; --against PROGRAM\n"
    "  uncertain  values drawn anew for every start beside the same values known\n"
    "Tables go to standard output, progress to standard error. Exit codes: 0 done, 1 failed, 2 bad usage.";

void measure(const Options& options) {
  Json out{{"machine", describe_machine()},
           {"settings",
            {{"works", options.works},
             {"rounds", options.rounds},
             {"threads", options.threads},
             {"long", options.long_run},
             {"quick", options.quick}}}};
  print_machine(out["machine"], options);
  std::fflush(stdout);
  Json& works = out["works"] = Json::object();
  if (options.asked("full")) works["full"] = full(options);
  if (options.asked("decided")) works["decided"] = decided(options, works.contains("full") ? works["full"] : Json());
  if (options.asked("ramped")) works["ramped"] = ramped(options);
  if (options.asked("kernel")) works["kernel"] = kernel(options);
  if (options.asked("targets")) works["targets"] = targets(options);
  if (options.asked("threads")) works["threads"] = threads(options);
  if (options.asked("balls")) works["balls"] = balls(options);
  if (options.asked("starts")) works["starts"] = starts(options);
  if (options.asked("machines")) works["machines"] = machines(options);
  if (options.asked("uncertain")) works["uncertain"] = uncertain(options);
  if (options.json.empty()) return;
  std::ofstream file(options.json);
  file << out.dump(2) << '\n';
  if (!file.flush()) throw RunError("cannot write " + options.json);
}

int run(int argc, char** argv) {
  // How starts() calls this program for one ensemble: not for users.
  if (argc == 5 && std::string(argv[1]) == "--decide-as-child")
    return decide_as_child(std::strtoull(argv[2], nullptr, 10), std::atoi(argv[3]), argv[4]);

  Options options;
  options.works = all_works;
  CLI::App app("How fast Equipoise is, beside its rivals and beside what the machine allows.");
  app.name("equipoise_bench");
  app.footer(footer);
  app.add_option("works,--works", options.works,
                 fmt::format("what to measure, comma-separated: {}", fmt::join(all_works, ",")))
      ->delimiter(',')
      ->check(CLI::IsMember(all_works).description(""))
      ->type_name("LIST")
      ->default_str("all");
  auto* rounds = app.add_option("--rounds", options.rounds, "how often each is measured, in turns")
                     ->check(CLI::Range(1, 1000).description(""))
                     ->type_name("N")
                     ->default_str("5");
  app.add_option("--threads", options.threads, "threads for this engine and all rivals (default: all cores)")
      ->check(CLI::Range(1, 4096).description(""))
      ->type_name("N");
  app.add_option("--json", options.json, "write everything, raw figures of every round too, to this file")
      ->type_name("FILE");
  app.add_option("--against", options.against, "an older equipoise, measured beside this one in `machines`")
      ->check(CLI::ExistingFile.description(""))
      ->type_name("PROGRAM");
  auto* longer =
      app.add_flag("--long", options.long_run, "the slow parts too: rows of beta = 0.01 in every round, 10^7 starts");
  app.add_flag("--quick", options.quick, "sizes too small to measure anything, one round: shows that all of it works")
      ->excludes(longer);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    fmt::print(stderr, "equipoise_bench: {} (see --help)\n", e.what());
    return bad_usage;
  }
  if (!options.json.empty() && !std::ofstream(options.json, std::ios::app)) {
    fmt::print(stderr, "equipoise_bench: --json: cannot write {}\n", options.json);
    return bad_usage;
  }
  if (options.quick && rounds->count() == 0) options.rounds = 1;
  options.threads = thread_count(options.threads);
  measure(options);
  return 0;
}

}  // namespace
}  // namespace equipoise::bench

int main(int argc, char** argv) {
  try {
    return equipoise::bench::run(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "equipoise_bench: {}\n", e.what());
    return equipoise::bench::failed;
  }
}
