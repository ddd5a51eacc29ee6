// From a start's index to its fate: spin-up, release, remaining branches, decision. Shared by basin(), its pilot and
// replay_start().
#pragma once

#include <cstdint>
#include <vector>

#include "equipoise/attractors/balanced_trap.hpp"
#include "equipoise/attractors/fate.hpp"
#include "equipoise/base/error.hpp"
#include "equipoise/integrate/clamped.hpp"
#include "equipoise/model/speed.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// Throws InputError for invalid studies and those whose starts cannot be decided: anisotropic supports, gravity.
void check_decidable(const Study& study);

/// Everything about a study that all its starts share. Thread-safe once made.
class StartRunner {
 public:
  /// Analyses the balanced states, integrates the clamped spin-up and runs the pilot on `threads` threads. The study
  /// has passed check_decidable(). Ask stopped() afterwards.
  StartRunner(const Study& study, int threads, const StopFlag* stop);

  /// Decides starts first .. first + count - 1. False if stopped early.
  bool run(std::uint64_t first, std::size_t count, std::vector<double>& phi, std::vector<Fate>& fates) const;

  const BalancedAnalysis& balanced() const { return balanced_; }
  std::size_t motions_found() const { return rule_.boxes.size(); }
  /// When the last branch has begun and the balls are free.
  double settled() const { return segments_.back().begin; }
  bool stopped() const { return stopped_; }

 private:
  bool run_seeded(std::uint64_t seed, std::uint64_t first, std::size_t count, double horizon, std::vector<double>& phi,
                  std::vector<Fate>& fates, std::vector<PilotRecord>* pilot) const;
  void run_pilot(int threads);

  Study study_;
  const StopFlag* stop_;
  std::vector<model::Segment> segments_;
  std::size_t first_free_ = 0;
  ClampedBasis basis_;
  BalancedAnalysis balanced_;
  DecisionRule rule_;
  double tolerance_;
  bool stopped_ = false;
};

}  // namespace equipoise
