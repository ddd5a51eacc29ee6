// Clocks, a static partition over threads, and the centre and spread of rounds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace equipoise::bench {

/// What a piece of work cost.
struct Cost {
  double wall = 0.0, cpu = 0.0;   ///< seconds; cpu: of all threads
  std::uint64_t evaluations = 0;  ///< of the right-hand side, one trajectory's each
};

/// Wall and processor time since it was made.
class Stopwatch {
 public:
  Stopwatch();
  Cost cost() const;

 private:
  double wall_, cpu_;
};

/// Processor time of the calling thread, in seconds.
double thread_seconds();

/// Calls `work(first, count)` once on each of `threads` threads, shares of `total` as equal as can be, and times all of
/// it. `work` returns evaluations made. An exception in a thread is thrown again here.
Cost in_parallel(std::size_t total, int threads,
                 const std::function<std::uint64_t(std::size_t first, std::size_t count)>& work);

/// Centre and range of one figure over rounds.
struct Spread {
  double median = 0.0, least = 0.0, most = 0.0;
};
Spread spread(std::vector<double> values);

/// The value below which the share `q` of `values` lies.
double quantile(std::vector<double> values, double q);

}  // namespace equipoise::bench
