// Ensembles of candidates: run, kept as they come, never run twice.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/analyses/design/design.hpp"
#include "equipoise/analyses/sweeps/survey_run.hpp"
#include "equipoise/results/cell_files/cell_file.hpp"

namespace equipoise {

/// An ensemble that is wanted.
struct WantedSample {
  std::vector<DesignSetting> settings;
  std::uint64_t starts = 0, seed = 0;
  bool whole = false;  ///< with a whole search for attractors, not a first look's

  std::string name() const;
  CellRecord record() const;
};

/// A rerun of a design's search asks the same questions in the same order, so a question's number names its answer in
/// the file. One thread asks; other processes may help to answer.
class DesignEnsembles final : public SurveyRun {
 public:
  /// `file` and `kept`: what an earlier run kept.
  DesignEnsembles(const DesignProblem& problem, const DesignOptions& options, io::CellFile* file = nullptr,
                  KeptSamples kept = {});
  ~DesignEnsembles() override { dismiss(); }

  /// Results in the order of `wanted`; candidates run in parallel and share the threads. Throws SearchOver if stopped;
  /// finished samples are kept, see sample().
  std::vector<DesignSample> run(const std::vector<WantedSample>& wanted);
  using SurveyRun::close;
  using SurveyRun::stopped;

  /// An earlier sample of it, or null.
  const DesignSample* sample(const WantedSample& wanted) const;
  /// All, with those of the file.
  const KeptSamples& kept_samples() const { return kept_; }

  std::uint64_t trajectories() const { return trajectories_; }  ///< trajectories followed, including earlier runs
  std::uint64_t resumed() const { return resumed_; }
  /// From now on only the stop flag ends the work: the search is over.
  void after_search() { searching_ = false; }
  /// Whether the search has had its time. It has not before something is known: without a candidate the rest of the
  /// time would be of no use.
  bool out_of_time() const { return searching_ && some_known_ && search_time_ && search_time_(); }

 private:
  CellRecord record(std::size_t number) const override;
  CellRecord take(std::size_t number, const CellRecord& made) override;

  std::function<bool()> search_time_;
  std::atomic<bool> searching_{true}, some_known_{false};
  KeptSamples kept_;
  std::map<std::string, DesignSample> samples_;  // by name
  std::uint64_t trajectories_ = 0, resumed_ = 0;
  std::uint64_t asked_ = 0;  // before these:
  std::vector<WantedSample> batch_;
  std::vector<std::optional<DesignSample>> answers_;
};

}  // namespace equipoise
