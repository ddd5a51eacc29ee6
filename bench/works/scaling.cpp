// How the engine's rate goes with the instruction set, the number of threads and the number of balls.
#include <algorithm>

#include <fmt/format.h>

#include "../problems.hpp"
#include "../table.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "works.hpp"

namespace equipoise::bench {

namespace {

// One setting of the engine and what it reached.
struct Point {
  std::string name;
  std::size_t starts = 0;
  std::vector<double> rates, evaluation_rates;  // a second of wall time, by round
};

// Starts/s and evaluations/s of one run, added to the point.
void run_full(const StudyProblem& problem, Point& point, int threads) {
  std::vector<double> states = problem.states(0, point.starts);
  const Cost cost = engine()->run(problem.problem(), states, threads);
  point.rates.push_back(static_cast<double>(point.starts) / cost.wall);
  point.evaluation_rates.push_back(static_cast<double>(cost.evaluations) / cost.wall);
}

// As many starts as take a round's time.
std::size_t find_size(const StudyProblem& problem, int threads, const Options& options) {
  Point pilot{"", static_cast<std::size_t>(threads) * (options.quick ? 1 : 256), {}, {}};
  run_full(problem, pilot, threads);
  if (options.quick) return pilot.starts;
  const auto wanted = static_cast<std::size_t>(pilot.rates.front() * options.round_seconds);
  return std::max(pilot.starts, wanted);
}

Json to_json(const Point& point) {
  return {{"name", point.name},
          {"starts_per_round", point.starts},
          {"starts_per_second", to_json(spread(point.rates))},
          {"evaluations_per_second", to_json(spread(point.evaluation_rates))},
          {"rounds_starts_per_second", point.rates},
          {"rounds_evaluations_per_second", point.evaluation_rates}};
}

Json to_json(const std::vector<Point>& points) {
  Json list = Json::array();
  for (const Point& point : points) list.push_back(to_json(point));
  return list;
}

Study constant_row() { return paper_study("table-2-omega-2.4"); }

}  // namespace

Json targets(const Options& options) {
  const StudyProblem problem(constant_row(), 1500.0);
  std::vector<Point> points;
  for (const std::string& target : cpu_targets()) {
    use_cpu_target(target);
    points.push_back({target, find_size(problem, options.threads, options), {}, {}});
  }
  for (int round = 0; round < options.rounds; ++round) {
    say(fmt::format("targets: round {} of {}", round + 1, options.rounds));
    for (Point& point : points) {
      use_cpu_target(point.name);
      run_full(problem, point, options.threads);
    }
  }
  use_cpu_target("");

  print_heading("targets: the work of `full` by instruction set");
  print_paragraph(fmt::format("Those this program was built for and this machine has; {} threads.", options.threads));
  fmt::print("\n");
  Table table({"", "starts/s", "least .. most", "of the best", "times scalar"});
  const double best = spread(points.front().rates).median, scalar = spread(points.back().rates).median;
  for (const Point& point : points) {
    const Spread rate = spread(point.rates);
    table.row({point.name, figure(rate.median), range(rate.least, rate.most),
               fmt::format("{:.0f} %", 100 * rate.median / best), figure(rate.median / scalar)});
  }
  table.print();
  return {{"threads", options.threads}, {"targets", to_json(points)}};
}

Json threads(const Options& options) {
  std::vector<int> counts;
  for (int k = 1; k<options.threads; k *= options.threads> 8 ? 2 : 1, k += options.threads > 8 ? 0 : 1)
    counts.push_back(k);
  counts.push_back(options.threads);
  const StudyProblem problem(constant_row(), 1500.0);
  Study study = constant_row();
  study.sampling.starts = options.quick ? 500 : 100'000;
  std::vector<Point> followed, decided;
  for (int k : counts) {
    followed.push_back({fmt::format("{}", k), find_size(problem, k, options), {}, {}});
    decided.push_back({fmt::format("{}", k), study.sampling.starts, {}, {}});
  }
  for (int round = 0; round < options.rounds; ++round) {
    say(fmt::format("threads: round {} of {}", round + 1, options.rounds));
    for (std::size_t i = 0; i < counts.size(); ++i) {
      run_full(problem, followed[i], counts[i]);
      BasinOptions how;
      how.threads = counts[i];
      const Stopwatch watch;
      basin(study, how);
      decided[i].rates.push_back(static_cast<double>(study.sampling.starts) / watch.cost().wall);
    }
  }

  print_heading("threads: row Omega = 2.4, starts/s by number of threads");
  print_paragraph(fmt::format("Full length: the work of `full`. Decided: basin(), {} starts, discovery included.",
                              count(static_cast<double>(study.sampling.starts))));
  fmt::print("\n");
  Table table(
      {"threads", "full length", "least .. most", "times 1 thread", "decided", "least .. most", "times 1 thread"});
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const Spread a = spread(followed[i].rates), b = spread(decided[i].rates);
    table.row({followed[i].name, figure(a.median), range(a.least, a.most),
               figure(a.median / spread(followed[0].rates).median), figure(b.median), range(b.least, b.most),
               figure(b.median / spread(decided[0].rates).median)});
  }
  table.print();
  return {{"full", to_json(followed)}, {"decided", to_json(decided)}};
}

Json balls(const Options& options) {
  std::vector<StudyProblem> problems;
  std::vector<Point> points;
  for (int n = 1; n <= model::max_balls; ++n) {
    Study study = constant_row();
    study.parameters.balls = n;
    for (int i = 0; i < n; ++i) {
      study.parameters.mass[i] = 0.1 / n;
      study.parameters.drag[i] = 0.05;
    }
    problems.emplace_back(study, 1500.0);
    points.push_back({fmt::format("{}", n), find_size(problems.back(), options.threads, options), {}, {}});
  }
  for (int round = 0; round < options.rounds; ++round) {
    say(fmt::format("balls: round {} of {}", round + 1, options.rounds));
    for (std::size_t i = 0; i < points.size(); ++i) run_full(problems[i], points[i], options.threads);
  }

  print_heading("balls: full length (constant Omega = 2.4 to t = 1500) by number of balls");
  print_paragraph(
      fmt::format("Equal balls that weigh 0.1 together, drag 0.05; {} threads. ns a lane-evaluation: threads x wall "
                  "time / evaluations.",
                  options.threads));
  fmt::print("\n");
  Table table({"balls", "starts/s", "least .. most", "evals/start", "ns/lane-evaluation"});
  for (const Point& point : points) {
    const Spread rate = spread(point.rates), work = spread(point.evaluation_rates);
    table.row({point.name, figure(rate.median), range(rate.least, rate.most), figure(work.median / rate.median),
               figure(1e9 * options.threads / work.median)});
  }
  table.print();
  return {{"threads", options.threads}, {"balls", to_json(points)}};
}

}  // namespace equipoise::bench
