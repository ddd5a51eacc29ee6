// What the kernels reach of what the machine can: the roofline's flat part, since all they work on stays in cache.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "../problems.hpp"
#include "../table.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "kernel_count.hpp"
#include "kernel_equations.hpp"
#include "kernel_peak.hpp"
#include "works.hpp"

namespace equipoise::bench {

namespace {

// The paper's rotor with n equal balls that weigh 0.1 together.
model::Parameters rotor(int balls) {
  model::Parameters p;
  p.balls = balls;
  for (int i = 0; i < balls; ++i) {
    p.mass[i] = 0.1 / balls;
    p.drag[i] = 0.05;
  }
  return p;
}

// Nanoseconds of one lane's evaluation, the equations alone on one thread.
double time_evaluation(const model::Parameters& p, double seconds) {
  double checksum = 0.0;
  for (long evaluations = 1000;; evaluations *= 4) {
    const double begin = thread_seconds();
    const int lanes = evaluate_derivatives(p, 2.4, evaluations, &checksum);
    const double taken = thread_seconds() - begin;
    if (taken > seconds) return 1e9 * taken / (static_cast<double>(evaluations) * lanes);
  }
}

struct Measured {
  std::vector<double> peak_one, peak_all;                 // flops a second
  std::vector<double> nanoseconds[model::max_balls + 1];  // the equations alone
  std::vector<double> all_in_one, all_in_all;             // evaluations a second, one thread and all
};

Measured measure(const Options& options) {
  const double seconds = options.quick ? 0.01 : 0.3;
  StudyProblem problem(paper_study("table-2-omega-2.4"), 1500.0);
  const RivalPointer self = engine();
  const std::size_t starts = options.quick ? 32 : 8192;
  Measured m;
  for (int round = 0; round < options.rounds; ++round) {
    say(fmt::format("kernel: round {} of {}", round + 1, options.rounds));
    m.peak_one.push_back(multiply_add_peak(seconds));
    std::vector<double> each(static_cast<std::size_t>(options.threads));
    in_parallel(each.size(), options.threads, [&](std::size_t first, std::size_t) {
      each[first] = multiply_add_peak(seconds);
      return 0;
    });
    double all = 0.0;
    for (double one : each) all += one;
    m.peak_all.push_back(all);
    for (int n = 1; n <= model::max_balls; ++n) m.nanoseconds[n].push_back(time_evaluation(rotor(n), seconds / 4));
    for (int threads : options.threads == 1 ? std::vector<int>{1} : std::vector<int>{1, options.threads}) {
      std::vector<double> states = problem.states(0, starts * static_cast<std::size_t>(threads));
      const Cost cost = self->run(problem.problem(), states, threads);
      const double rate = static_cast<double>(cost.evaluations) * threads / cost.cpu;
      (threads == 1 ? m.all_in_one : m.all_in_all).push_back(rate);
      if (options.threads == 1) m.all_in_all = m.all_in_one;
    }
  }
  return m;
}

// Operations of a step, from a trajectory that must end where the engine's own does: so the counting numbers compute.
double count_checked() {
  const StudyProblem source(paper_study("table-2-omega-2.4"), 100.0);
  std::vector<double> counted = source.states(0, 1), followed = counted;
  const Problem& problem = source.problem();
  const double flops = count_step(problem.parameters, problem.segment.speed, counted.data(), problem.end);
  engine()->run(problem, followed, 1);
  for (std::size_t i = 0; i < counted.size(); ++i)
    if (!(std::fabs(counted[i] - followed[i]) < 1e-4))
      throw RunError("the counting numbers and the engine disagree about a trajectory");
  return flops;
}

Json report_peak(const Measured& m, double flops_step, double flops_rhs, const Options& options) {
  const Spread one = spread(m.peak_one), all = spread(m.peak_all);
  const Spread in_one = spread(m.all_in_one), in_all = spread(m.all_in_all);
  const double per_evaluation = flops_step / 12.0;
  Table table(
      {"work of `full`, two balls", "ns/lane-evaluation", "GFLOP/s", "peak GFLOP/s", "least .. most", "share of peak"});
  const auto row = [&](const std::string& name, int threads, const Spread& rate, const Spread& peak) {
    table.row({name, figure(1e9 * threads / rate.median), figure(1e-9 * rate.median * per_evaluation),
               figure(1e-9 * peak.median), range(1e-9 * peak.least, 1e-9 * peak.most),
               fmt::format("{:.0f} %", 100 * rate.median * per_evaluation / peak.median)});
  };
  row("1 thread", 1, in_one, one);
  if (options.threads > 1) row(fmt::format("{} threads", options.threads), options.threads, in_all, all);
  table.print();
  fmt::print("\n");
  print_paragraph(fmt::format(
      "Times are processor times of the threads, so that other work on the machine weighs less. Operations are counted "
      "by running the kernels' own code on numbers that count; a fused multiply-add is two, "
      "comparisons, selections and signs are none. All in: {} a step and lane of 12 evaluations, hence {} an "
      "evaluation, "
      "of which {} are the equations (as written: what the compiler takes out of the loop counts too). Peak: "
      "multiply-adds on registers alone.",
      count(flops_step), figure(per_evaluation), count(flops_rhs)));
  return {{"flops_per_step", flops_step},
          {"flops_per_evaluation_all_in", per_evaluation},
          {"peak_flops_one_thread", to_json(one)},
          {"peak_flops_all_threads", to_json(all)},
          {"evaluations_per_second_one_thread", to_json(in_one)},
          {"evaluations_per_second_all_threads", to_json(in_all)},
          {"ns_per_lane_evaluation_one_thread", 1e9 / in_one.median},
          {"share_of_peak_one_thread", in_one.median * per_evaluation / one.median},
          {"share_of_peak_all_threads", in_all.median * per_evaluation / all.median},
          {"rounds",
           {{"peak_one", m.peak_one},
            {"peak_all", m.peak_all},
            {"evaluations_per_second_one", m.all_in_one},
            {"evaluations_per_second_all", m.all_in_all}}}};
}

Json report_balls(const Measured& m) {
  const double peak = spread(m.peak_one).median;
  fmt::print("\n");
  Table table({"equations alone, 1 thread", "ns/lane-evaluation", "least .. most", "flops", "divisions", "GFLOP/s",
               "share of peak"});
  Json list = Json::array();
  for (int n = 1; n <= model::max_balls; ++n) {
    const Spread ns = spread(m.nanoseconds[n]);
    const FlopCount counted = count_right_hand_side(rotor(n));
    // evaluate_derivatives() adds every rate to the state, one multiply-add a component.
    const double flops = static_cast<double>(counted.flops + 2 * static_cast<unsigned>(model::dimension(n)));
    table.row({fmt::format("{} ball{}", n, n == 1 ? "" : "s"), figure(ns.median), range(ns.least, ns.most),
               count(static_cast<double>(counted.flops)), fmt::format("{}", counted.divide), figure(flops / ns.median),
               fmt::format("{:.0f} %", 100 * flops / ns.median * 1e9 / peak)});
    list.push_back({{"balls", n},
                    {"ns_per_lane_evaluation", to_json(ns)},
                    {"flops", counted.flops},
                    {"flops_in_fused_multiply_adds", counted.fused},
                    {"divisions_and_roots", counted.divide},
                    {"share_of_peak", flops / ns.median * 1e9 / peak},
                    {"rounds_ns", m.nanoseconds[n]}});
  }
  table.print();
  return list;
}

}  // namespace

Json kernel(const Options& options) {
  const Measured m = measure(options);
  const double flops_step = count_checked();
  const model::Parameters p = rotor(2);
  print_heading(fmt::format("kernel: what is reached of what {} can", cpu_target()));
  Json out = report_peak(m, flops_step, static_cast<double>(count_right_hand_side(p).flops), options);
  out["instruction_set"] = cpu_target();
  out["balls"] = report_balls(m);
  return out;
}

}  // namespace equipoise::bench
