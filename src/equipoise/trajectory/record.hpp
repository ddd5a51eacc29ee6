// A state as a row of a trajectory.
#pragma once

#include "equipoise/model/parameters.hpp"
#include "equipoise/results/trajectory.hpp"

namespace equipoise {

/// Appends state `z` (dimension(balls) numbers) at time `t`, rotor angle `psi` and speed `w` to every array.
void record(Trajectory& out, const model::Parameters& p, double psi, double w, double t, const double* z);

}  // namespace equipoise
