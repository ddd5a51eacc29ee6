// Rows of the other tables with slow settling of balls or a long spin-up.
#include "table_7_elsewhere.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <fmt/format.h>

#include "equipoise/extras/reproduction/reproduction.hpp"
#include "table_7_fit.hpp"

namespace equipoise::table_7 {

namespace {

struct Row {
  const char* study;
  double printed;
  std::uint64_t printed_starts;
};

constexpr Row rows[] = {{"table-1-beta-0.01-omega-3.0", 10.72, 300000}, {"table-1-beta-0.01-omega-4.0", 13.04, 300000},
                        {"table-1-beta-0.01-omega-5.0", 14.56, 300000}, {"table-1-beta-0.01-omega-6.0", 15.74, 300000},
                        {"table-2-omega-2.0", 55.23, 300000},           {"table-2-omega-2.2", 63.99, 300000},
                        {"table-2-omega-2.6", 99.59, 300000},           {"table-2-omega-2.8", 99.98, 300000},
                        {"table-2-omega-3.0", 98.32, 300000},           {"table-4-omega-2.0", 63.88, 100000},
                        {"table-4-omega-2.6", 99.88, 100000},           {"table-5-t0-800", 91.93, 100000},
                        {"table-6-release-2-t0-1000", 88.16, 300000},   {"table-6-release-3-t0-1000", 96.05, 300000}};
constexpr double times[] = {60, 100, 200, 300, 400, 500, 560, 620, 700};

double signed_z(std::uint64_t count, std::uint64_t starts, const Row& row) {
  const double z = std::sqrt(deviance(count, starts, row.printed, row.printed_starts));
  return 100.0 * static_cast<double>(count) < row.printed * static_cast<double>(starts) ? -z : z;
}

}  // namespace

int elsewhere(const std::string& studies, double tolerance, double span, std::uint64_t starts, double until) {
  fmt::print("max r over {} below {}: share in percent (z-score) by time since release and final speed\n", span,
             tolerance);
  fmt::print("study,printed,agrees_from,agrees_until");
  for (double after : times) fmt::print(",share_{0},z_{0}", after);
  fmt::print("\n");
  for (const Row& row : rows) {
    const Study study = read_study(studies + "/" + row.study + ".toml");
    // The later of release and settling, on the grid of windows.
    const double settled = std::max(study.release_time(), study.speed_profile().settled_time());
    const double origin = window * std::ceil(settled / window);
    ObservationSettings settings;
    settings.starts = starts;
    settings.window = window;
    settings.until = origin + until;
    const Observation seen = observe(study, settings);
    const auto z_at = [&](double after, double* share = nullptr) {
      const std::uint64_t count = called_balanced(seen, {origin + after - span, origin + after, tolerance});
      if (share) *share = 100.0 * static_cast<double>(count) / static_cast<double>(starts);
      return signed_z(count, starts, row);
    };
    double from = -1.0, last = -1.0;
    for (double after = std::max(span, window); after <= until; after += window) {
      if (std::fabs(z_at(after)) >= 3.0) continue;
      if (from < 0.0) from = after;
      last = after;
    }
    fmt::print("{},{},{},{}", row.study, row.printed, from, last);
    for (double after : times) {
      double share = 0.0;
      const double z = after >= span && after <= until ? z_at(after, &share) : 0.0;
      fmt::print(",{:.2f},{:.1f}", share, z);
    }
    fmt::print("\n");
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace equipoise::table_7
