// The problems that this engine and its rivals are given, made from studies of the repository.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "equipoise/simulation/spin_up/start_source.hpp"
#include "equipoise/study/contents/study.hpp"
#include "rivals/rival.hpp"

namespace equipoise::bench {

/// The study of a row of the paper's tables, by the name of its file without ".toml".
Study paper_study(const std::string& name);

/// A study's trajectories from where the balls become free to the end of that segment of the rotor's motion.
class StudyProblem {
 public:
  /// `end`: where they end if the segment has no end.
  StudyProblem(const Study& study, double end);

  const Problem& problem() const { return problem_; }
  /// States of starts first .. first + count - 1 of the study's seed when their balls become free.
  std::vector<double> states(std::uint64_t first, std::size_t count) const;

 private:
  Study study_;
  std::unique_ptr<StartSource> source_;
  Problem problem_;
};

}  // namespace equipoise::bench
