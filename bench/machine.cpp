// Where, with what and when a benchmark ran.
#include "machine.hpp"

#include <ctime>
#include <fstream>
#include <string>
#include <thread>

#include <boost/version.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#ifdef EQUIPOISE_BENCH_SUNDIALS
#include <sundials/sundials_config.h>
#endif

#include "equipoise/core/base/version.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "rivals/rival.hpp"
#include "table.hpp"

namespace equipoise::bench {

namespace {

// The first value of a key of /proc/cpuinfo; "unknown" elsewhere than on Linux.
std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::string date() {
  const std::time_t now = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
  return text;
}

}  // namespace

Json describe_machine() {
  Json versions{
      {"equipoise", version_string},
      {"boost", fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100)}};
#ifdef EQUIPOISE_BENCH_SUNDIALS
  versions["sundials"] = SUNDIALS_VERSION;
#else
  versions["sundials"] = nullptr;
#endif
  std::string scipy_version;
  if (python_with_scipy(scipy_version).empty())
    versions["scipy"] = nullptr;
  else
    versions["scipy"] = scipy_version;
  return {{"processor", processor()},
          {"cores", std::thread::hardware_concurrency()},
          {"instruction_set", cpu_target()},
          {"instruction_sets", cpu_targets()},
          {"compiler", EQUIPOISE_BENCH_COMPILER},
          {"build", EQUIPOISE_BENCH_BUILD},
          {"rival_options", EQUIPOISE_BENCH_RIVAL_OPTIONS},
          {"versions", versions},
          {"date", date()}};
}

void print_machine(const Json& machine, const Options& options) {
  const auto text = [](const Json& value) { return value.is_null() ? "-" : value.get<std::string>(); };
  const Json& versions = machine["versions"];
  print_heading(fmt::format("Equipoise {} and its rivals, {}", version_string, text(machine["date"])));
  fmt::print("  processor  {}, {} cores\n", text(machine["processor"]), machine["cores"].get<int>());
  fmt::print("  engine     {} of {}, chosen at run time; build {}\n", text(machine["instruction_set"]),
             fmt::join(machine["instruction_sets"].get<std::vector<std::string>>(), ", "), text(machine["build"]));
  fmt::print("  rivals     {}; SUNDIALS and SciPy themselves as installed\n", text(machine["rival_options"]));
  fmt::print("  compiler   {}\n", text(machine["compiler"]));
  fmt::print("  versions   Boost {}, SUNDIALS {}, SciPy {}\n", text(versions["boost"]), text(versions["sundials"]),
             text(versions["scipy"]));
  fmt::print("  run        {} thread{}, {} round{}{}\n", options.threads, options.threads == 1 ? "" : "s",
             options.rounds, options.rounds == 1 ? "" : "s",
             options.quick ? "; QUICK: sizes too small to measure anything" : "");
}

}  // namespace equipoise::bench
