// equipoise attractors --along: continues attractors along a parameter.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "equipoise/study/contents/study.hpp"

namespace equipoise::app {

/// The options, checked as far as possible without the study.
struct AlongArguments {
  std::string along, output, plot;
  std::uint64_t starts = 0;  ///< 0: only the pilot's
  int threads = 0;           ///< 0: all cores
  std::vector<std::vector<double>> states;
  bool json = false, quiet = false;
};

/// Follows, prints, writes and draws; returns the exit code. Throws InputError before any work starts.
int run_along(const Study& study, const AlongArguments& arguments);

}  // namespace equipoise::app
