// The search's judge: every candidate gets a first look, those that might win get more starts. Then how far each number
// of the chosen candidate may change, all others fixed.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "equipoise/analyses/design/ensembles.hpp"
#include "equipoise/analyses/design/problem.hpp"
#include "equipoise/analyses/design/search.hpp"
#include "equipoise/analyses/design/standing.hpp"
#include "equipoise/results/commands/design_result.hpp"

namespace equipoise {

class Race {
 public:
  /// `budget`: trajectories after which the search is over.
  Race(const DesignStanding& standing, DesignEnsembles& ensembles, std::uint64_t budget, std::uint64_t seed,
       std::function<void(const DesignCandidate*)> told)
      : problem_(standing.problem()),
        standing_(standing),
        ensembles_(ensembles),
        budget_(budget),
        seed_(seed),
        told_(std::move(told)) {}

  /// As a Judge, who judges the study itself before all else: throws SearchOver when the budget is spent, when nothing
  /// new is proposed, or when stopped.
  std::vector<SearchWorth> judge(const std::vector<SearchPoint>& points);

  /// All candidates that were examined, each with its largest sample.
  const std::vector<DesignCandidate>& candidates() const { return candidates_; }
  const std::vector<DesignStep>& history() const { return history_; }

 private:
  std::size_t enter(const SearchPoint& point);
  void look(const std::vector<std::size_t>& places, std::uint64_t starts);
  std::vector<std::size_t> might_win(const std::vector<std::size_t>& places) const;
  void raise(std::vector<std::size_t> places);
  void take_into_leaders(std::size_t place);
  void note_best();

  const DesignProblem& problem_;
  const DesignStanding& standing_;
  DesignEnsembles& ensembles_;
  std::uint64_t budget_, seed_;
  std::function<void(const DesignCandidate*)> told_;
  std::vector<DesignCandidate> candidates_;
  std::map<std::string, std::size_t> places_;  // by text
  std::vector<std::size_t> leaders_;           // beaten by no other
  std::vector<DesignStep> history_;
  std::uint64_t looked_ = 0, raised_ = 0;  // trajectories
  std::size_t idle_ = 0;                   // consecutive points without anything new
};

/// Changes every number of the candidate to either side by parts of its range, or to its other choices, on the held-out
/// starts; for a spin-up each point's speed and time. By effect, the largest first. Throws SearchOver if stopped.
std::vector<DesignMargin> design_margins(const DesignStanding& standing, DesignEnsembles& ensembles,
                                         const DesignCandidate& chosen, std::uint64_t starts, std::uint64_t seed);
/// Number of ensembles that this takes.
std::size_t margin_points(const DesignProblem& problem);

/// In words: limits that are just met or missed, and variables at an end of their range.
std::vector<std::string> design_limits_reached(const DesignStanding& standing, const DesignCandidate& chosen);

}  // namespace equipoise
