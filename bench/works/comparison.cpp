// This engine and its rivals on the same trajectories: rates, work and accuracy.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "../problems.hpp"
#include "../reference.hpp"
#include "../table.hpp"
#include "works.hpp"

namespace equipoise::bench {

Json to_json(const Spread& s) { return {{"median", s.median}, {"least", s.least}, {"most", s.most}}; }

Json to_json(const Cost& cost, std::size_t starts) {
  return {{"starts", starts}, {"wall_s", cost.wall}, {"cpu_s", cost.cpu}, {"evaluations", cost.evaluations}};
}

namespace {

// One engine's part in a comparison.
struct Contestant {
  RivalPointer rival;
  std::size_t starts = 0;  // a round
  std::vector<Cost> rounds;
  std::vector<double> errors;

  Spread over_rounds(double (*figure)(const Cost&, double starts)) const {
    std::vector<double> values;
    for (const Cost& cost : rounds) values.push_back(figure(cost, static_cast<double>(starts)));
    return spread(values);
  }
  double rate(std::size_t round) const { return static_cast<double>(starts) / rounds[round].wall; }
};

struct Comparison {
  std::string name, title, what;
  StudyProblem problem;
  double check_time;  // where accuracy is looked at
};

// As many starts as take a round's time, found by doubling from the fewest worth timing.
std::size_t find_size(const Comparison& comparison, Rival& rival, const Options& options) {
  const auto threads = static_cast<std::size_t>(options.threads);
  const std::size_t least = threads * (options.quick ? 1 : rival.least_starts);
  for (std::size_t starts = least;; starts *= 2) {
    std::vector<double> states = comparison.problem.states(0, starts);
    // Processor time: a moment's wait for a core must not shrink all rounds.
    const double taken = rival.run(comparison.problem.problem(), states, options.threads).cpu / options.threads;
    if (options.quick) return starts;
    if (taken < 0.1 * options.round_seconds && starts < 1'000'000) continue;
    const double wanted = static_cast<double>(starts) * options.round_seconds / taken;
    return std::max(least, threads * static_cast<std::size_t>(wanted / static_cast<double>(threads)));
  }
}

void race(const Comparison& comparison, std::vector<Contestant>& contestants, const Options& options) {
  for (Contestant& c : contestants) {
    c.starts = find_size(comparison, *c.rival, options);
    say(fmt::format("{}: {}, {} starts a round", comparison.name, c.rival->name, c.starts));
  }
  for (int round = 0; round < options.rounds; ++round) {
    say(fmt::format("{}: round {} of {}", comparison.name, round + 1, options.rounds));
    // Every round takes other starts: how much starts differ is then part of the spread.
    for (Contestant& c : contestants) {
      std::vector<double> states = comparison.problem.states(static_cast<std::uint64_t>(round) * c.starts, c.starts);
      c.rounds.push_back(c.rival->run(comparison.problem.problem(), states, options.threads));
    }
  }
}

Reference judge(const Comparison& comparison, std::vector<Contestant>& contestants, const Options& options) {
  say(fmt::format("{}: accuracy", comparison.name));
  Problem problem = comparison.problem.problem();
  problem.end = comparison.check_time;
  const std::vector<double> starts = comparison.problem.states(0, options.quick ? 8 : 256);
  const Reference reference = make_reference(problem, starts, options.threads);
  for (Contestant& c : contestants) {
    std::vector<double> states = starts;
    c.rival->run(problem, states, options.threads);
    c.errors = errors(states, reference.states);
  }
  return reference;
}

// How many times faster the first contestant was, round by round: what slows one round slows both.
Spread lead(const Contestant& first, const Contestant& other) {
  std::vector<double> ratios;
  for (std::size_t k = 0; k < first.rounds.size(); ++k) ratios.push_back(first.rate(k) / other.rate(k));
  return spread(ratios);
}

Json report(const Comparison& comparison, const std::vector<Contestant>& contestants, const Reference& reference,
            const std::vector<std::string>& missing, const Options& options) {
  print_heading(comparison.title);
  print_paragraph(comparison.what);
  fmt::print("\n");
  Table table({"", "starts/s", "least .. most", "starts/CPU s", "evals/start", "times slower", "error median", "90 %"});
  Json engines = Json::array();
  for (const Contestant& c : contestants) {
    const Spread rate = c.over_rounds([](const Cost& cost, double starts) { return starts / cost.wall; });
    const Spread cpu_rate = c.over_rounds([](const Cost& cost, double starts) { return starts / cost.cpu; });
    const Spread work =
        c.over_rounds([](const Cost& cost, double starts) { return static_cast<double>(cost.evaluations) / starts; });
    const Spread faster = lead(contestants.front(), c);
    const double median = quantile(c.errors, 0.5), high = quantile(c.errors, 0.9);
    table.row({c.rival->name, figure(rate.median), range(rate.least, rate.most), figure(cpu_rate.median),
               figure(work.median), figure(faster.median), fmt::format("{:.1e}", median), fmt::format("{:.1e}", high)});
    Json rounds = Json::array();
    for (const Cost& cost : c.rounds) rounds.push_back(to_json(cost, c.starts));
    engines.push_back({{"name", c.rival->name},
                       {"settings", c.rival->settings},
                       {"starts_per_round", c.starts},
                       {"starts_per_second", to_json(rate)},
                       {"starts_per_cpu_second", to_json(cpu_rate)},
                       {"evaluations_per_start", to_json(work)},
                       {"equipoise_times_faster", to_json(faster)},
                       {"error_median", median},
                       {"error_90_percent", high},
                       {"rounds", rounds}});
  }
  table.print();
  fmt::print("\n");
  print_paragraph(fmt::format(
      "Error: distance in (x, y), rotating frame, at t = {:g}, over {} starts. Reference: {}; the two differ by {:.1e} "
      "(median) and {:.1e} (most).",
      comparison.check_time, contestants.front().errors.size(), reference_method, reference.median, reference.most));
  print_paragraph(fmt::format(
      "Rivals at relative tolerance {:g} and absolute {:g}, angles not wrapped; this engine by its own scale, below. "
      "{} threads, equal shares of the starts; {} round{}, interleaved; medians, ratios within a round. Starts differ "
      "in cost and slow rivals see few: compare "
      "evals/start.",
      relative_tolerance, absolute_tolerance, options.threads, options.rounds, options.rounds == 1 ? "" : "s"));
  for (const Contestant& c : contestants)
    print_paragraph(fmt::format("{} ({} starts a round): {}.", c.rival->name, count(static_cast<double>(c.starts)),
                                c.rival->settings),
                    2);
  for (const std::string& who : missing) print_paragraph("Missing here: " + who + ".");
  return {{"problem", comparison.what},
          {"relative_tolerance", relative_tolerance},
          {"absolute_tolerance", absolute_tolerance},
          {"threads", options.threads},
          {"error_time", comparison.check_time},
          {"error_starts", contestants.front().errors.size()},
          {"reference", reference_method},
          {"reference_error_median", reference.median},
          {"reference_error_most", reference.most},
          {"engines", engines},
          {"missing", missing}};
}

Json compare(const Comparison& comparison, const Options& options) {
  Rivals rivals = all_rivals();
  std::vector<Contestant> contestants;
  contestants.push_back({engine(), 0, {}, {}});
  for (RivalPointer& rival : rivals.present) contestants.push_back({std::move(rival), 0, {}, {}});
  race(comparison, contestants, options);
  const Reference reference = judge(comparison, contestants, options);
  return report(comparison, contestants, reference, rivals.missing, options);
}

}  // namespace

Json full(const Options& options) {
  return compare({"full",
                  "full: every start followed to t = 1500",
                  "Table 2's row Omega = 2.4 (two balls, constant speed, random ball angles of seed 1), every start to "
                  "t = 1500, nothing decided early.",
                  {paper_study("table-2-omega-2.4"), 1500.0},
                  400.0},
                 options);
}

Json ramped(const Options& options) {
  const Study study = paper_study("table-6-release-2-t0-500");
  StudyProblem problem(study, 0.0);
  const double begin = problem.problem().segment.begin, end = problem.problem().end;
  const std::string what = fmt::format(
      "Table 6's row T0 = 500, Omega_r = 2 (psi' by the published law): balls released at t = {:g}, where psi' = {:g}, "
      "and followed to the end of the ramp at t = {:g}, where psi' = {:g}.",
      begin, problem.problem().segment.speed, end, problem.problem().segment.speed_at(end));
  return compare({"ramped", "ramped: released in mid-ramp", what, std::move(problem), end}, options);
}

}  // namespace equipoise::bench
