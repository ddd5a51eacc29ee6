// Ranks candidates: their violations, their worths, and which ones no other beats.
#pragma once

#include <cstddef>
#include <vector>

#include "equipoise/analyses/design/problem.hpp"
#include "equipoise/results/commands/design_result.hpp"

namespace equipoise {

/// The value of a figure to use: the estimate, a standard error to the good or the bad side (half of the 95 %
/// interval's arm), or the interval's bad end.
enum class Side { estimate, hopeful, doubtful, worst };

class DesignStanding {
 public:
  explicit DesignStanding(const DesignProblem& problem) : problem_(problem) {}

  const DesignProblem& problem() const { return problem_; }

  /// Sum of the amounts by which limits are missed, relative to the limits; 0: none is.
  double violation(const DesignSample& sample, Side side) const;
  double violation(const DesignLimit& limit, const DesignSample& sample, Side side) const;
  /// The objectives; less is better.
  std::vector<double> goals(const DesignSample& sample, Side side) const;
  /// The same for an optimiser: every sample that misses a limit is worse than every sample that misses none.
  std::vector<double> worth(const DesignSample& sample) const;
  /// Whether a is better than b: it misses less; or neither misses a limit, and a is nowhere worse, somewhere better.
  bool beats(const DesignSample& a, Side side_a, const DesignSample& b, Side side_b) const;
  /// Indices of the samples that no other beats, by the first objective.
  std::vector<std::size_t> front(const std::vector<const DesignSample*>& samples, Side side) const;
  /// Indices by worth, the best first: by the first objective among those that meet the limits.
  std::vector<std::size_t> order(const std::vector<const DesignSample*>& samples, Side side) const;
  /// The member of a front nearest to the best value of every objective, each measured by the front's own range.
  std::size_t middle(const std::vector<const DesignSample*>& samples) const;

 private:
  double at(const DesignSample& sample, std::size_t figure, bool up, Side side) const;

  const DesignProblem& problem_;
};

}  // namespace equipoise
