// Studies of cells, checked before any work; blocks along the longest axis.
#include "equipoise/analyses/sweeps/sweep_plan.hpp"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/analyses/ensembles/stored_ensemble.hpp"
#include "equipoise/analyses/sweeps/survey.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/results/result_files/result_identity.hpp"
#include "equipoise/study/reading/table_reader.hpp"
#include "equipoise/study/toml/toml_tree.hpp"

namespace equipoise {

Study StudySource::with(const std::vector<std::string>& more) const {
  std::vector<std::string> all = overrides;
  all.insert(all.end(), more.begin(), more.end());
  return parse_study(toml, name, all);
}

bool StudySource::states(const std::string& key) const {
  return study::parse_study_file(toml, name, overrides).root.find_path(key) != nullptr;
}

SweepPlan::SweepPlan(StudySource source, std::vector<SweepAxis> axes, const BasinOptions& request, std::string option)
    : source_(std::move(source)),
      axes_(std::move(axes)),
      request_(request),
      option_(std::move(option)),
      study_(source_.with()),
      tree_(study::parse_toml(source_.toml)) {
  for (std::size_t a = 0; a < axes_.size(); ++a) {
    cells_ *= axes_[a].size();
    if (axes_[a].size() > axes_[chain_].size()) chain_ = a;
  }
  const std::size_t length = chain_length();
  lines_ = cells_ / length;
  blocks_in_line_ = (length + block_length - 1) / block_length;
  transients_ = gathers_transients(study_, request_);
}

Study SweepPlan::study_of(std::size_t cell, const std::vector<std::string>& more) const {
  std::vector<std::string> overrides = source_.overrides;
  visit_parameters(axes_, cell,
                   [&](const SweepParameter& p, std::size_t k) { overrides.push_back(p.key + "=" + p.given[k]); });
  overrides.insert(overrides.end(), more.begin(), more.end());
  return study_from(tree_, source_.name, overrides);
}

Study SweepPlan::checked_study_of(std::size_t cell) const {
  try {
    Study study = study_of(cell);
    check_decidable_as_read(study, transients_);
    return study;
  } catch (const InputError& e) {
    throw InputError(option_, e.key(), e.value(), e.problem() + " (in the cell " + cell_title(axes_, cell) + ")");
  }
}

void SweepPlan::check_cells(const StopFlag* stop) const {
  for (std::size_t cell = 0; cell < cells_ && !is_set(stop); ++cell) (void)checked_study_of(cell);
}

std::vector<std::size_t> SweepPlan::cells_of(std::size_t block) const {
  const std::size_t line = block / blocks_in_line_, first = block % blocks_in_line_ * block_length;
  const std::size_t length = chain_length();
  std::size_t stride = 1;  // between neighbours along the chain
  for (std::size_t a = chain_ + 1; a < axes_.size(); ++a) stride *= axes_[a].size();
  const std::size_t begin = line / stride * stride * length + line % stride;
  std::vector<std::size_t> cells;
  for (std::size_t k = first; k < std::min(first + block_length, length); ++k) cells.push_back(begin + k * stride);
  return cells;
}

BasinOptions SweepPlan::ensemble(const BlockWorkers& workers) const {
  BasinOptions options = request_;
  options.transients = transients_;
  options.without_balls = false;
  options.notes = workers.notes;
  workers.work_on(options);
  return options;
}

std::string SweepPlan::identity() const {
  BasinFileHeader header = basin_file_header(study_, false, transients_);
  header.study = to_toml(study_);
  std::string text = io::identity_of(header) + "[sweep]\n";
  for (const SweepAxis& axis : axes_)
    for (const SweepParameter& p : axis.parameters)
      text += fmt::format("over.{} = {}\n", p.key, fmt::join(p.given, ", "));
  text += fmt::format("axes = {}\nhalf_width = {}\nstarts_are_a_limit = {}\n", axes_.size(), request_.half_width,
                      request_.limit_given);
  return text;
}

}  // namespace equipoise
