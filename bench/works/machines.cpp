// Rotors beyond the paper's: what a start costs under a motor, gravity, contact, stiction, off the centre; next to an
// older program if one is given.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "../child.hpp"
#include "../table.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "works.hpp"

namespace equipoise::bench {

namespace {

struct Machine {
  const char* label;
  const char* study;
  std::vector<std::string> overrides;
};

const std::vector<Machine> list_of_machines{
    {"paper's rotor, 2.4", "paper/table-2-omega-2.4.toml", {}},
    {"the same with a motor", "paper-rotor-with-motor.toml", {}},
    {"with motor and gravity", "paper-rotor-with-motor.toml", {"rotor.gravity=0.002"}},
    {"with motor, off-centre race", "paper-rotor-with-motor.toml", {"balancer.race_offset=[0.001, 0.0005]"}},
    {"with motor, balls that touch",
     "paper-rotor-with-motor.toml",
     {"balancer.contact_angle=0.3", "balancer.restitution=0.5"}},
    {"with a strong motor, balls that stick",
     "paper-rotor-with-motor.toml",
     {"balancer.rolling=0.001", "speed.torque.stall=1.0"}},
    // Said of the examples too: to an older program balls of a known size pass each other unless told otherwise.
    {"angle grinder", "examples/angle-grinder.toml", {"balancer.contact=true"}},
    {"laboratory centrifuge", "examples/laboratory-centrifuge.toml", {"balancer.contact=true"}},
    {"optical drive", "examples/optical-drive.toml", {"balancer.contact=true"}},
    {"washing machine", "examples/washing-machine.toml", {"balancer.contact=true"}},
};

std::string path_of(const Machine& m) { return fmt::format("{}/../studies/{}", EQUIPOISE_BENCH_SOURCE_DIR, m.study); }

// Processor time of an ensemble's run, in seconds; without the search for attractors where `known` has it.
double here(const Machine& m, std::uint64_t starts, const Options& options, AttractorSearchCache& known,
            BasinResult* result = nullptr) {
  Study study = read_study(path_of(m), m.overrides);
  study.sampling.starts = starts;
  BasinOptions how;
  how.threads = options.threads;
  how.searches = &known;
  const Stopwatch watch;
  const BasinResult found = basin(study, how);
  if (result) *result = found;
  return watch.cost().cpu;
}

double there(const Machine& m, std::uint64_t starts, const Options& options) {
  std::vector<std::string> command{options.against,
                                   "basin",
                                   path_of(m),
                                   "--starts",
                                   fmt::format("{}", starts),
                                   "--threads",
                                   fmt::format("{}", options.threads),
                                   "--quiet",
                                   "--json"};
  for (const std::string& setting : m.overrides) command.insert(command.end(), {"--set", setting});
  const ChildResult child = run_child(command, "", true);
  if (!child.ran) return std::nan("");
  return child.cpu_seconds;
}

// What starts cost beyond what is done before the first, in processor time.
struct StartCost {
  double before = 0.0, each = 0.0;  // seconds

  double of(double count) const { return before + each * count; }
};

// From ensembles of growing size, the last one long enough to be told from the smallest. `searches`: every run looks
// for attractors again, else the first alone.
template <class Run>
StartCost cost_of(const Options& options, std::uint64_t few, bool searches, Run&& run) {
  const double first = run(few);
  const double small = searches ? first : run(few);
  const double long_enough = options.quick ? 0.0 : 1.5;
  std::uint64_t many = 4 * few;
  double large = run(many);
  while (large - small < long_enough && many < 1'000'000) {
    many *= 4;
    large = run(many);
  }
  std::vector<double> each{(large - small) / static_cast<double>(many - few)};
  for (int round = 1; round < options.rounds; ++round)
    each.push_back((run(many) - small) / static_cast<double>(many - few));
  StartCost cost;
  cost.each = spread(each).median;
  cost.before = std::max(0.0, first - cost.each * static_cast<double>(few));
  return cost;
}

std::string or_dash(double value) { return std::isfinite(value) && value > 0.0 ? figure(value) : "-"; }

}  // namespace

Json machines(const Options& options) {
  const bool against = !options.against.empty();
  const std::uint64_t few = options.quick ? 5 : 50;
  constexpr double typical = 2000.0;  // starts, for the time of a whole run
  print_heading("machines: rotors beyond the paper's");
  print_paragraph(fmt::format(
      "basin() on {} threads. Before: CPU time before the first start, the search for attractors. Starts per CPU "
      "second "
      "beyond that, from ensembles of two sizes. {}",
      options.threads,
      against ? fmt::format("Times faster: CPU time of {} against this program's, a start and a run of {} starts.",
                            options.against, typical)
              : std::string("An older program is measured beside it with --against PROGRAM.")));
  fmt::print("\n");
  std::vector<std::string> heads{"", "starts", "undecided, %", "before, CPU s", "starts per CPU s"};
  if (against) heads.insert(heads.end(), {"older", "times faster a start", fmt::format("a run of {}", typical)});
  Table table(heads);
  Json list = Json::array();
  for (const Machine& m : list_of_machines) {
    say(fmt::format("machines: {}", m.label));
    BasinResult result;
    AttractorSearchCache known;
    const StartCost now =
        cost_of(options, few, false, [&](std::uint64_t starts) { return here(m, starts, options, known, &result); });
    std::vector<std::string> cells{m.label, count(static_cast<double>(result.starts)),
                                   fmt::format("{:.2f}", 100.0 * result.undecided.share), figure(now.before),
                                   or_dash(1.0 / now.each)};
    Json row{{"machine", m.label},
             {"starts", result.starts},
             {"undecided", result.undecided.share},
             {"before_cpu_s", now.before},
             {"starts_per_cpu_second", 1.0 / now.each}};
    if (against) {
      const StartCost old =
          cost_of(options, few, true, [&](std::uint64_t starts) { return there(m, starts, options); });
      cells.insert(cells.end(),
                   {or_dash(1.0 / old.each), or_dash(old.each / now.each), or_dash(old.of(typical) / now.of(typical))});
      row["older"] = {{"before_cpu_s", old.before}, {"starts_per_cpu_second", 1.0 / old.each}};
    }
    table.row(cells);
    list.push_back(row);
  }
  table.print();
  return {{"threads", options.threads}, {"against", options.against}, {"rows", list}};
}

}  // namespace equipoise::bench
