// One motion followed along a parameter by pseudo-arclength, past its folds.
#pragma once

#include <string>

#include <Eigen/Core>

#include "equipoise/core/running/run_options.hpp"
#include "equipoise/results/commands/branch.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Why a followed branch ends.
enum class BranchEnd {
  range,    ///< it leaves the range of the parameter
  lost,     ///< no point was found beyond, such as near a homoclinic connection
  length,   ///< it has several hundred points
  stopped,  ///< by the caller
};
const char* name_of(BranchEnd end);

struct MotionBranch {
  /// Points in the order of the curve: at folds the parameter turns back. Events lie between points; a deviation begins
  /// to grow (stability_lost) or ceases to (stability_gained), whatever others do.
  Branch branch;
  BranchEnd end = BranchEnd::lost;
  bool partial() const { return end == BranchEnd::stopped; }
};

/// Follows the equilibrium or periodic motion that the trajectory from `state` comes to, at value `at` of the
/// parameter, towards `to`, until the parameter leaves the range between the two. Throws InputError for other motions,
/// for members of a continuum, and for rotors that are not smooth or on which the rotor's angle matters.
MotionBranch follow_motion(const Study& study, const std::string& key, double at, double to,
                           const Eigen::VectorXd& state, const RunOptions& options = {});

}  // namespace equipoise
