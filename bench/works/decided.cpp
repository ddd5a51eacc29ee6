// Ensembles as a user runs them: discovery, spin-up, trapping regions and all.
#include <algorithm>

#include <fmt/format.h>

#include "../problems.hpp"
#include "../table.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "works.hpp"

namespace equipoise::bench {

namespace {

struct Row {
  const char* study;
  const char* label;
  ClassificationMode mode;
  bool repeated;  // in every round; the others take long and run once unless --long
};

constexpr Row rows[] = {
    {"table-2-omega-2.4", "0.05, 2.4", ClassificationMode::validated, true},
    {"table-2-omega-2.4", "0.05, 2.4", ClassificationMode::proof, true},
    {"table-1-beta-0.01-omega-3.0", "0.01, 3.0", ClassificationMode::validated, false},
    {"table-1-beta-0.01-omega-4.0", "0.01, 4.0", ClassificationMode::validated, false},
    {"table-1-beta-0.01-omega-5.0", "0.01, 5.0", ClassificationMode::validated, false},
    {"table-1-beta-0.01-omega-6.0", "0.01, 6.0", ClassificationMode::validated, false},
    {"table-1-beta-0.01-omega-4.0", "0.01, 4.0", ClassificationMode::proof, false},
};

struct Outcome {
  std::vector<double> wall, cpu;
  BasinResult result;
};

// What rivals would need for an ensemble of this size, from the rates they were measured at.
Json print_rivals(const Json& full, std::uint64_t starts, double seconds) {
  Json computed = Json::array();
  fmt::print("\n");
  print_paragraph(
      fmt::format("By a fixed horizon t = 1500 and then r < 1e-2, {} starts of the first row would take (COMPUTED from "
                  "the rates of "
                  "`full`, not run; this engine decides them in {} s):",
                  count(static_cast<double>(starts)), figure(seconds)));
  Table table({"", "computed, s", "times longer"});
  for (const Json& engine : full["engines"]) {
    const double would = static_cast<double>(starts) / engine["starts_per_second"]["median"].get<double>();
    const auto name = engine["name"].get<std::string>();
    table.row({name, figure(would), figure(would / seconds)});
    computed.push_back({{"name", name}, {"computed_s", would}, {"times_longer", would / seconds}});
  }
  table.print();
  return computed;
}

}  // namespace

Json decided(const Options& options, const Json& full) {
  std::vector<Outcome> outcomes(std::size(rows));
  for (int round = 0; round < options.rounds; ++round)
    for (std::size_t k = 0; k < std::size(rows); ++k) {
      if (!rows[k].repeated && (options.quick || (round > 0 && !options.long_run))) continue;
      Study study = paper_study(rows[k].study);
      study.numerics.decide = rows[k].mode;
      if (options.quick) study.sampling.starts = 1000;
      say(fmt::format("decided: beta, Omega = {}, {}, round {} of {}", rows[k].label,
                      classification_mode_names[static_cast<std::size_t>(rows[k].mode)], round + 1, options.rounds));
      BasinOptions how;
      how.threads = options.threads;
      const Stopwatch watch;
      outcomes[k].result = basin(study, how);
      const Cost cost = watch.cost();
      outcomes[k].wall.push_back(cost.wall);
      outcomes[k].cpu.push_back(cost.cpu);
    }

  print_heading("decided: ensembles as a user runs them");
  print_paragraph(
      fmt::format("Rows of the paper by basin(), discovery of the attractors included, {} threads; medians over the "
                  "rounds of a row.",
                  options.threads));
  fmt::print("\n");
  Table table({"beta, Omega", "decided by", "starts", "rounds", "wall, s", "least .. most", "CPU, s", "starts/s",
               "balanced, % (95 %)", "undecided"});
  Json list = Json::array();
  for (std::size_t k = 0; k < std::size(rows); ++k) {
    if (outcomes[k].wall.empty()) continue;
    const BasinResult& r = outcomes[k].result;
    const Spread wall = spread(outcomes[k].wall), cpu = spread(outcomes[k].cpu);
    const Share& balanced = r.attractors.front().share;
    const auto starts = static_cast<double>(r.starts);
    const char* mode = classification_mode_names[static_cast<std::size_t>(rows[k].mode)];
    table.row({rows[k].label, mode, count(starts), fmt::format("{}", outcomes[k].wall.size()), figure(wall.median),
               range(wall.least, wall.most), figure(cpu.median), figure(starts / wall.median),
               fmt::format("{:.2f} ({:.2f}-{:.2f})", 100 * balanced.share, 100 * balanced.low, 100 * balanced.high),
               fmt::format("{}", r.undecided.count)});
    list.push_back({{"study", rows[k].study},
                    {"decide", mode},
                    {"starts", r.starts},
                    {"wall_s", to_json(wall)},
                    {"cpu_s", to_json(cpu)},
                    {"starts_per_second", starts / wall.median},
                    {"balanced", {{"share", balanced.share}, {"low", balanced.low}, {"high", balanced.high}}},
                    {"undecided", r.undecided.count},
                    {"diverged", r.diverged.count},
                    {"failed", r.failed.count},
                    {"rounds", {{"wall_s", outcomes[k].wall}, {"cpu_s", outcomes[k].cpu}}}});
  }
  table.print();
  Json out{{"threads", options.threads}, {"rows", list}};
  if (!full.is_null())
    out["rivals_computed_from_full"] = print_rivals(full, outcomes[0].result.starts, spread(outcomes[0].wall).median);
  return out;
}

}  // namespace equipoise::bench
