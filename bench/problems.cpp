// The problems that this engine and its rivals are given, made from studies of the repository.
#include "problems.hpp"

#include <cmath>

#include "equipoise/core/base/embedded.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/study/sampling/starts.hpp"

namespace equipoise::embedded {
extern const Archive paper_files;  // of equipoise_paper: studies of the printed rows
}

namespace equipoise::bench {

Study paper_study(const std::string& name) {
  const auto text = embedded::paper_files.find("studies/" + name + ".toml");
  if (text.empty()) throw RunError("this program carries no study " + name);
  return parse_study(std::string(text), name + ".toml");
}

StudyProblem::StudyProblem(const Study& study, double end)
    : study_(study), source_(std::make_unique<StartSource>(study, nullptr)) {
  problem_.parameters = study.parameters;
  problem_.segment = source_->segments()[source_->first_free()];
  problem_.end = std::isfinite(problem_.segment.end) ? problem_.segment.end : end;
}

std::vector<double> StudyProblem::states(std::uint64_t first, std::size_t count) const {
  std::vector<InitialState> starts(count, study_.initial);
  for (std::size_t i = 0; i < count; ++i)
    start_angles(study_.sampling.seed, first + i, study_.parameters.balls, starts[i].phi.data());
  std::vector<double> states;
  source_->release(starts, states);
  return states;
}

}  // namespace equipoise::bench
