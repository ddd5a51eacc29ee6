// Rotors that nobody knows exactly, next to the same rotors known: what a start costs, and the search before the first.
#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "../table.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/classification/rotor_family/family_mesh.hpp"
#include "works.hpp"

namespace equipoise::bench {

namespace {

struct Pair {
  const char* label;
  const char* study;
  std::vector<std::string> drawn;  // what makes its values uncertain
};

const std::vector<Pair> pairs{
    {"row 2.4, eccentricity", "paper/table-2-omega-2.4.toml", {"rotor.eccentricity={ uniform = [0.005, 0.015] }"}},
    {"row 2.4, five values",
     "paper/table-2-omega-2.4.toml",
     {"rotor.eccentricity={ uniform = [0.008, 0.012] }", "rotor.damping={ uniform = [0.4, 0.6] }",
      "balancer.mass={ uniform = [0.045, 0.055] }", "balancer.drag={ loguniform = [0.04, 0.06] }",
      "speed.speed={ uniform = [2.3, 2.5] }"}},
    {"row 3.0 under gravity, eccentricity",
     "paper/table-2-omega-3.0.toml",
     {"rotor.gravity=0.002", "rotor.eccentricity={ uniform = [0.008, 0.012] }"}},
    {"with a motor, eccentricity", "paper-rotor-with-motor.toml", {"rotor.eccentricity={ uniform = [0.008, 0.012] }"}},
};

struct Costs {
  double search = 0.0, each = 0.0;  // CPU seconds
};

Costs costs_of(const Study& given, std::uint64_t starts, const Options& options) {
  Study study = given;
  AttractorSearchCache found;
  BasinOptions how;
  how.threads = options.threads;
  how.searches = &found;
  study.sampling.starts = 2;
  const Stopwatch searching;
  basin(study, how);
  Costs costs{searching.cost().cpu, 0.0};
  study.sampling.starts = starts;
  std::vector<double> each;
  for (int round = 0; round < options.rounds; ++round) {
    const Stopwatch deciding;
    basin(study, how);
    each.push_back(deciding.cost().cpu / static_cast<double>(starts));
  }
  costs.each = spread(each).median;
  return costs;
}

}  // namespace

Json uncertain(const Options& options) {
  print_heading("uncertain: rotors that nobody knows exactly");
  print_paragraph(fmt::format(
      "basin() on {} threads: the same study with its values known, and drawn anew for every start. CPU seconds of the "
      "search, and starts per CPU second once it is done.",
      options.threads));
  Table table({"", "search, known", "drawn", "starts/s, known", "drawn", "drawn over known"});
  Json rows = Json::array();
  for (const Pair& pair : pairs) {
    say(fmt::format("uncertain: {}", pair.label));
    const std::string path = fmt::format("{}/../studies/{}", EQUIPOISE_BENCH_SOURCE_DIR, pair.study);
    const Study drawn = read_study(path, pair.drawn);
    const Costs a = costs_of(with_medians(drawn), options.quick ? 64 : 100'000, options);
    const Costs b = costs_of(drawn, options.quick ? 64 : 20'000, options);
    table.row({pair.label, figure(a.search), figure(b.search), count(1.0 / a.each), count(1.0 / b.each),
               fmt::format("{:.3f}", a.each / b.each)});
    rows.push_back({{"study", pair.label},
                    {"drawn", pair.drawn},
                    {"search_known", a.search},
                    {"search_drawn", b.search},
                    {"seconds_a_start_known", a.each},
                    {"seconds_a_start_drawn", b.each}});
    if (options.quick) break;
  }
  table.print();
  return {{"rows", rows}};
}

}  // namespace equipoise::bench
