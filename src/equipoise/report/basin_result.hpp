// What an ensemble answered, and its forms for people and for machines.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "equipoise/attractors/fate.hpp"
#include "equipoise/statistics/share.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// Everything a report needs.
struct BasinResult {
  Study study;
  std::uint64_t starts = 0;                       ///< decided and counted: starts 0 to starts - 1
  bool partial = false;                           ///< stopped before all requested starts were done
  std::uint64_t resumed_from = 0;                 ///< starts read from an earlier run's file
  std::array<Share, outcome_count> shares;        ///< by Outcome; 95 % Wilson intervals
  std::array<double, outcome_count> mean_time{};  ///< mean time from the last branch's begin (and release) to decision
  bool balanced_stable = false;                   ///< a linearly stable balanced state exists at the final speed
  std::string note;                               ///< why no start can end balanced, if so
  std::size_t motions_found = 0;  ///< stationary motions away from balance that the pilot could tell apart
  int threads = 0;
  std::string cpu_target;
  double seconds = 0.0, cpu_seconds = 0.0;  ///< of this run, pilot included
};

/// A table for the terminal; shares in percent.
std::string basin_text(const BasinResult& result);
/// One JSON object; shares are fractions of one. docs/guide/basin.md lists the keys.
std::string basin_json(const BasinResult& result);

}  // namespace equipoise
