// What a benchmark run has to measure.
#pragma once

#include <string>
#include <vector>

namespace equipoise::bench {

struct Options {
  std::vector<std::string> works;
  int rounds = 5;
  int threads = 0;             ///< as used: never 0 once read
  std::string json;            ///< file to write; empty: none
  std::string against;         ///< an older program, for `machines`; empty: none
  bool long_run = false;       ///< the slow parts too
  bool quick = false;          ///< sizes too small to measure anything: shows that all of it works
  double round_seconds = 1.5;  ///< what one rival's share of a round is to take

  bool asked(const std::string& work) const {
    for (const auto& w : works)
      if (w == work) return true;
    return false;
  }
};

}  // namespace equipoise::bench
