// Capacity: the largest value of a parameter, such as the unbalance, at which starts still balance as often as asked.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "equipoise/analyses/sweeps/survey.hpp"
#include "equipoise/analyses/sweeps/sweep_plan.hpp"
#include "equipoise/results/commands/capacity_result.hpp"

namespace equipoise {

/// The plan has to gather transients unless `by` is "balanced".
struct CapacityOptions : SurveyOptions, CapacityQuestion {
  std::string of = "of";  ///< names the key in errors
};

/// What `by` may be for this study: "balanced", and where it states limits "limits" and each of them that bounds a
/// figure.
std::vector<std::string> capacity_goals(const Study& study);

/// The source of a study in physical units with its unbalance as one quantity, rotor.unbalance in g mm, where it is
/// stated otherwise (as an eccentricity, a balance grade or places) and neither uncertain nor varied by an axis; else
/// the same. For a tilting rotor rotor.unbalance then stands for its static unbalance, and capacity() varies all of
/// its unbalances in proportion; throws InputError where they are a couple alone, uncertain or varied by an axis.
StudySource with_unbalance(const StudySource& source, const std::vector<SweepAxis>& axes);

/// Whether with_unbalance() made this source of a tilting rotor: rotor.unbalance stands for all its unbalances.
bool varies_all_unbalances(const StudySource& source);

/// Then the overrides with which its static unbalance is this (kg m), each unbalance keeping its share.
std::vector<std::string> unbalances_in_proportion(const SweepPlan& plan, double unbalance);

/// The key of the parameter to maximise, from its name as written; empty: rotor.unbalance if the study states it, else
/// rotor.eccentricity. `option` names it in errors. Throws InputError if the study states the other.
std::string capacity_key(const StudySource& source, const std::string& text, const std::string& option);

/// The range as written, "LOW:HIGH" in numbers or quantities of one unit ("20 g mm:400 g mm"). Empty: for
/// rotor.unbalance (in g mm) and rotor.eccentricity (plain, or in mm) from a fiftieth to all that the balls can cancel,
/// over all cells. `option` names it in errors. Once `stop` is set, that range is of no use. Throws InputError.
CapacityRange capacity_range(const SweepPlan& plan, const std::string& key, const std::string& text,
                             const std::string& option, const StopFlag* stop = nullptr);

/// The study of a trial: the cell's with the key at this value, in the options' unit.
Study capacity_study(const SweepPlan& plan, const CapacityOptions& options, std::size_t cell, double value);

/// For other processes of a job, which make trials: a block is a cell, a record a trial or more.
Survey capacity_survey(const SweepPlan& plan, const CapacityOptions& options);

/// In every cell of the plan: values in steps of an eighth of the range up to the first at which too few starts
/// balance, then bisection for where the balanced share, and each end of its interval, first falls below the required
/// one, all on the same starts. Throws InputError if a study at either end of the range, or one step into it, is
/// invalid, or for unusable output files, RunError if the output fails later. The result depends only on the plan and
/// the requirement.
CapacityResult capacity(const SweepPlan& plan, const CapacityOptions& options);

}  // namespace equipoise
