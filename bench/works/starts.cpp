// Sizes of an ensemble: time and memory of a whole run with its results file, each in a process of its own.
#include <cstdio>

#include <fmt/format.h>

#include "../child.hpp"
#include "../problems.hpp"
#include "../table.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/core/base/error.hpp"
#include "works.hpp"

namespace equipoise::bench {

int decide_as_child(std::uint64_t starts, int threads, const std::string& output) {
  Study study = paper_study("table-2-omega-2.4");
  study.sampling.starts = starts;
  BasinOptions how;
  how.threads = threads;
  how.output = output;
  const Stopwatch watch;
  const BasinResult result = basin(study, how);
  const Cost cost = watch.cost();
  fmt::print("{}\n", Json{{"wall_s", cost.wall},
                          {"cpu_s", cost.cpu},
                          {"starts", result.starts},
                          {"balanced", result.attractors.front().share.share},
                          {"undecided", result.undecided.count}}
                         .dump());
  return 0;
}

Json starts(const Options& options) {
  std::vector<std::uint64_t> sizes{1000, 10'000, 100'000, 1'000'000};
  if (options.long_run) sizes.push_back(10'000'000);
  if (options.quick) sizes = {1000};
  struct Size {
    std::vector<double> wall, cpu, memory;
    Json last;
  };
  std::vector<Size> measured(sizes.size());
  for (int round = 0; round < options.rounds; ++round)
    for (std::size_t k = 0; k < sizes.size(); ++k) {
      if (round > 0 && sizes[k] >= 1'000'000) continue;  // long enough to be steady
      say(fmt::format("starts: {}, round {} of {}", count(static_cast<double>(sizes[k])), round + 1, options.rounds));
      const std::string path = temporary_path(".nc");
      const ChildResult child = run_child({"/proc/self/exe", "--decide-as-child", fmt::format("{}", sizes[k]),
                                           fmt::format("{}", options.threads), path});
      std::remove(path.c_str());
      if (!child.ran) throw RunError("the process that decides an ensemble failed");
      measured[k].last = Json::parse(child.output);
      measured[k].wall.push_back(measured[k].last["wall_s"]);
      measured[k].cpu.push_back(measured[k].last["cpu_s"]);
      measured[k].memory.push_back(child.peak_megabytes);
    }

  print_heading("starts: row Omega = 2.4 decided, by number of starts");
  print_paragraph(
      fmt::format("basin() with a results file, {} threads, each size in a process of its own: its time with "
                  "discovery, and the most "
                  "memory that was resident.",
                  options.threads));
  fmt::print("\n");
  Table table({"starts", "rounds", "wall, s", "CPU, s", "starts/s", "least .. most", "memory, MiB", "balanced, %"});
  Json list = Json::array();
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    const Size& m = measured[k];
    const Spread wall = spread(m.wall), cpu = spread(m.cpu), memory = spread(m.memory);
    const auto n = static_cast<double>(sizes[k]);
    table.row({count(n), fmt::format("{}", m.wall.size()), figure(wall.median), figure(cpu.median),
               figure(n / wall.median), range(n / wall.most, n / wall.least), figure(memory.most),
               fmt::format("{:.2f}", 100 * m.last["balanced"].get<double>())});
    list.push_back({{"starts", sizes[k]},
                    {"wall_s", to_json(wall)},
                    {"cpu_s", to_json(cpu)},
                    {"peak_memory_mib", to_json(memory)},
                    {"balanced", m.last["balanced"]},
                    {"undecided", m.last["undecided"]},
                    {"rounds", {{"wall_s", m.wall}, {"cpu_s", m.cpu}, {"peak_memory_mib", m.memory}}}});
  }
  table.print();
  return {{"threads", options.threads}, {"sizes", list}};
}

}  // namespace equipoise::bench
