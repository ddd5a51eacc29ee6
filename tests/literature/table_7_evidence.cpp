// How might table 7 of Wright and Peng (2019) have been computed? Observes ensembles under many protocols and fits
// tests of balance at a finite time to the printed shares. docs/evidence/table-7.md reports the results.
//
//   table_7_evidence search [--starts N] [--only TEXT] [--until T] [--csv FILE] [--leaders FILE --below CHI2]
//       every variant: the best test for every origin of time and span. Those alone whose name contains TEXT, or that
//       fitted better than CHI2 in an earlier search's FILE
//   table_7_evidence elsewhere STUDIES TOLERANCE SPAN [--starts N] [--until T]
//       slow rows of the other tables, read from the folder STUDIES: what a test of that tolerance shows when
//   table_7_evidence lead [--starts N]
//       the four rows under the reading that the library keeps as the best lead
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <set>
#include <string>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "table_7_elsewhere.hpp"
#include "table_7_fit.hpp"
#include "table_7_variants.hpp"

namespace equipoise::table_7 {
namespace {

// Starts observed at once: 32 MB of r^2.
constexpr std::uint64_t batch = 32768;

struct Options {
  std::uint64_t starts = 4000;
  double until = 1200.0;
  std::string only, csv, leaders;
  double below = 8.0;  // the 98 % point for the two cells that two fitted numbers leave free
};

// Names of the variants that fitted well in an earlier search.
std::set<std::string> leaders(const Options& options) {
  std::ifstream file(options.leaders);
  if (!file) throw RunError(fmt::format("cannot read {}", options.leaders));
  std::set<std::string> names;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    const std::size_t open = line.find('"'), close = line.rfind('"');
    if (open < close && std::stod(line) < options.below) names.insert(line.substr(open + 1, close - open - 1));
  }
  return names;
}

Cells observe_rows(const Variant& variant, const Options& options) {
  Cells cells;
  for (const Table7Row& row : table_7_rows) {
    const Table7Protocol& p = variant.protocol;
    ObservationSettings settings;
    settings.window = window;
    settings.until = options.until + (p.durations ? 450.0 : 0.0);  // as long after T2 as otherwise
    Counts counts(static_cast<std::size_t>(std::lround(settings.until / window)), p.release_time(row));
    for (std::uint64_t first = 0; first < options.starts; first += batch) {
      settings.first = first;
      settings.starts = std::min(batch, options.starts - first);
      counts.add(observe(p.study(row), p.segments(row), settings));
    }
    counts.close();
    cells.counts.push_back(std::move(counts));
    cells.ends.push_back(p.ends(row));
  }
  return cells;
}

std::string shares(const Fit& fit) {
  return fmt::format("{:.3f},{:.3f},{:.3f},{:.3f}", fit.share[0], fit.share[1], fit.share[2], fit.share[3]);
}

int search(const Options& options) {
  std::FILE* csv = options.csv.empty() ? nullptr : std::fopen(options.csv.c_str(), "w");
  if (csv) fmt::print(csv, "chi2,share_1,share_2,share_3,share_4,starts,protocol,origin,offset,span,tolerance\n");
  const std::set<std::string> chosen = options.leaders.empty() ? std::set<std::string>{} : leaders(options);
  for (const Variant& variant : variants()) {
    if (variant.name.find(options.only) == std::string::npos) continue;
    if (!options.leaders.empty() && !chosen.count(variant.name)) continue;
    const auto begin = std::chrono::steady_clock::now();
    std::vector<Fit> fits = best_fits(observe_rows(variant, options));
    std::sort(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) { return a.chi2 < b.chi2; });
    for (const Fit& fit : fits)
      if (csv && fit.chi2 < 1e300)
        fmt::print(csv, "{:.2f},{},{},\"{}\",{},{},{},{:.3e}\n", fit.chi2, shares(fit), options.starts, variant.name,
                   origin_names[static_cast<std::size_t>(fit.test.origin)], fit.test.offset, spans[fit.test.span],
                   tolerance(fit.test.tolerance));
    if (csv) std::fflush(csv);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const Fit& best = fits.front();
    fmt::print("{:9.1f}  {}  {}; {}  ({:.1f} s)\n", best.chi2, shares(best), variant.name, name_of(best.test), seconds);
    std::fflush(stdout);
  }
  if (csv) std::fclose(csv);
  return 0;
}

int lead(const Options& options) {
  double chi2 = 0.0;
  for (const LeadReading& r : observe_table_7_lead(options.starts)) {
    const double part = deviance(r.balanced.count, r.balanced.total, r.row.printed, table_7_printed_starts);
    chi2 += part;
    fmt::print("T0 {}, T1 {}, T2 {}: printed {}, {:.3f} ({:.3f} to {:.3f}), chi2 {:.1f}\n", r.row.t0, r.row.t1,
               r.row.t2, r.row.printed, 100.0 * r.balanced.share, 100.0 * r.balanced.low, 100.0 * r.balanced.high,
               part);
  }
  fmt::print("chi2 {:.1f} over four rows\n", chi2);
  return 0;
}

int usage() {
  fmt::print(stderr,
             "usage: table_7_evidence search [--starts N] [--only TEXT] [--until T] [--csv FILE] [--leaders FILE "
             "--below CHI2]\n"
             "       table_7_evidence elsewhere STUDIES TOLERANCE SPAN [--starts N] [--until T]\n"
             "       table_7_evidence lead [--starts N]\n");
  return 2;
}

int run(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  Options options;
  std::vector<std::string> words;
  for (int i = 2; i < argc; ++i) {
    const std::string word = argv[i];
    const bool option = word.rfind("--", 0) == 0;
    if (!option) words.push_back(word);
    if (!option) continue;
    if (i + 1 == argc) return usage();
    const std::string value = argv[++i];
    if (word == "--starts")
      options.starts = std::stoull(value);
    else if (word == "--until")
      options.until = std::stod(value);
    else if (word == "--only")
      options.only = value;
    else if (word == "--csv")
      options.csv = value;
    else if (word == "--leaders")
      options.leaders = value;
    else if (word == "--below")
      options.below = std::stod(value);
    else
      return usage();
  }
  if (what == "search" && words.empty()) return search(options);
  if (what == "lead" && words.empty()) return lead(options);
  if (what == "elsewhere" && words.size() == 3)
    return elsewhere(words[0], std::stod(words[1]), std::stod(words[2]), options.starts, options.until);
  return usage();
}

}  // namespace
}  // namespace equipoise::table_7

int main(int argc, char** argv) {
  try {
    return equipoise::table_7::run(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "table_7_evidence: {}\n", e.what());
    return 1;
  }
}
