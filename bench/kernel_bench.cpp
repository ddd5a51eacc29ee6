// The kernel: nanoseconds per lane and evaluation of the equations, by ball count and instruction set.
#include <string>

#include <benchmark/benchmark.h>

#include "equipoise/run/lane_kernels.hpp"

namespace {

using namespace equipoise;

model::Parameters paper_balancer(int balls) {
  model::Parameters p;
  p.balls = balls;
  for (int i = 0; i < balls; ++i) {
    p.mass[i] = 0.05;
    p.drag[i] = 0.05;
  }
  return p;
}

void derivatives(benchmark::State& state, const std::string& target) {
  use_cpu_target(target);
  const model::Parameters p = paper_balancer(static_cast<int>(state.range(0)));
  constexpr long evaluations = 20000;
  double checksum = 0.0;
  int lanes = 0;
  for (auto _ : state) {
    lanes = evaluate_derivatives(p, 2.4, evaluations, &checksum);
    benchmark::DoNotOptimize(checksum);
  }
  // Printed with an SI prefix: 1.5n is 1.5 nanoseconds.
  state.counters["seconds_per_lane_and_rhs"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * evaluations * lanes,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  use_cpu_target("");
}

const bool registered = [] {
  for (const std::string& target : cpu_targets()) {
    auto* bench = benchmark::RegisterBenchmark(("derivatives/" + target + "/balls").c_str(), derivatives, target);
    if (target == cpu_targets().front())
      bench->DenseRange(1, 8);
    else
      bench->Arg(2);
  }
  return true;
}();

}  // namespace
