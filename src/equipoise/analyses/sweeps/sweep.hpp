// Sweeps: an ensemble at every combination of some parameters' values.
// This room: an ensemble in every cell; the largest unbalance.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "equipoise/analyses/sweeps/survey.hpp"
#include "equipoise/analyses/sweeps/sweep_plan.hpp"
#include "equipoise/results/commands/sweep_result.hpp"

namespace equipoise {

struct SweepOptions : SurveyOptions {
  /// Only every `shards`-th block, starting with number `shard`; other processes have the rest (merge_sweeps()).
  std::size_t shard = 0, shards = 1;
  /// Called with every finished cell and its index, never from two threads at once.
  std::function<void(std::size_t, const SweepCell&)> cell;
};

/// For other processes of a job: a record is a cell.
Survey sweep_survey(const SweepPlan& plan);

/// Runs the ensembles. The result depends only on the plan. Throws InputError, before any work, for cells that cannot
/// be decided and for unusable output files, RunError if the output fails later.
SweepResult sweep(const SweepPlan& plan, const SweepOptions& options = {});

/// Motions with a fixed identifier keep it in every cell. The others are matched with those of the preceding neighbours
/// along every axis: the most similar in vibration and drift of the same kind and kind of name, if they differ by at
/// most a third. An unmatched motion gets the next free identifier, and a number if its name is taken.
void label_attractors(const std::vector<SweepAxis>& axes, SweepCells& cells);

/// Reads a sweep's file, or its unfinished part (.part), as a result. A notice says what is damaged in a part. Throws
/// InputError for other or damaged files.
SweepResult stored_sweep(const std::string& path, const RunOptions& options = {});

/// Merges the files of shards, or of any runs of one sweep, into `output`, with notices as above. Throws InputError if
/// they do not belong to one sweep, or are damaged.
SweepResult merge_sweeps(const std::vector<std::string>& files, const std::string& output,
                         const RunOptions& options = {});

}  // namespace equipoise
