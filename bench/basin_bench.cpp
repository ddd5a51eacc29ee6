// Whole ensembles: starts a second of CPU time, decided as a user would have them decided.
#include <string>

#include <benchmark/benchmark.h>

#include "equipoise/run/basin.hpp"

namespace {

using namespace equipoise;

// `row`: a study of the paper; time is CPU time, pilot and traps included.
void row(benchmark::State& state, const std::string& name, std::uint64_t starts) {
  Study study = read_study(std::string(EQUIPOISE_SOURCE_DIR) + "/studies/paper/" + name + ".toml");
  study.sampling.starts = starts;
  BasinOptions options;
  options.threads = 1;
  double balanced = 0.0;
  for (auto _ : state) balanced = basin(study, options).shares[0].share;
  state.counters["starts_per_cpu_second"] =
      benchmark::Counter(static_cast<double>(state.iterations() * starts), benchmark::Counter::kIsRate);
  state.counters["balanced"] = balanced;
}

BENCHMARK_CAPTURE(row, omega_2_4, std::string("table-2-omega-2.4"), 50000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(row, omega_4_beta_0_01, std::string("table-1-beta-0.01-omega-4.0"), 20000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(row, ramp_released_at_2_2, std::string("table-5-t0-500"), 50000)->Unit(benchmark::kMillisecond);

}  // namespace
