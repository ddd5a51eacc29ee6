// Trajectories that the numbers of publications come from.
#pragma once

#include "equipoise/extras/publications/publication.hpp"
#include "equipoise/results/commands/trajectory.hpp"

namespace equipoise::measures {

/// From the study's start; looked at between two times in steps of 0.05.
/// Throws RunError if it cannot be followed.
Trajectory follow(const Study& study, double from, double until);
/// Relative error of a trajectory's numbers: of its steps, where nothing grows.
inline constexpr double followed = 1e-8;
/// Part of a maximum that may be missed between two looks.
double missed(const Study& study);

}  // namespace equipoise::measures
