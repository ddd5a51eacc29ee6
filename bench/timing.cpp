// Clocks, a static partition over threads, and the centre and spread of rounds.
#include "timing.hpp"

#include <algorithm>
#include <ctime>
#include <exception>
#include <thread>

namespace equipoise::bench {

namespace {

double seconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

Stopwatch::Stopwatch() : wall_(seconds(CLOCK_MONOTONIC)), cpu_(seconds(CLOCK_PROCESS_CPUTIME_ID)) {}

Cost Stopwatch::cost() const { return {seconds(CLOCK_MONOTONIC) - wall_, seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu_, 0}; }

double thread_seconds() { return seconds(CLOCK_THREAD_CPUTIME_ID); }

Cost in_parallel(std::size_t total, int threads,
                 const std::function<std::uint64_t(std::size_t first, std::size_t count)>& work) {
  const auto parts = static_cast<std::size_t>(threads);
  std::vector<std::uint64_t> evaluations(parts, 0);
  std::vector<std::exception_ptr> errors(parts);
  const Stopwatch watch;
  std::vector<std::thread> pool;
  for (std::size_t k = 0; k < parts; ++k)
    pool.emplace_back([&, k] {
      const std::size_t first = total * k / parts, end = total * (k + 1) / parts;
      try {
        if (end > first) evaluations[k] = work(first, end - first);
      } catch (...) {
        errors[k] = std::current_exception();
      }
    });
  for (std::thread& t : pool) t.join();
  Cost cost = watch.cost();
  for (const auto& e : errors)
    if (e) std::rethrow_exception(e);
  for (std::uint64_t n : evaluations) cost.evaluations += n;
  return cost;
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const double place = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  const double part = place - static_cast<double>(below);
  return part == 0.0 ? values[below] : values[below] + part * (values[above] - values[below]);
}

Spread spread(std::vector<double> values) {
  if (values.empty()) return {};
  return {quantile(values, 0.5), *std::min_element(values.begin(), values.end()),
          *std::max_element(values.begin(), values.end())};
}

}  // namespace equipoise::bench
