// A state as a row of a trajectory.
#pragma once

#include "equipoise/model/parameters.hpp"
#include "equipoise/results/trajectory.hpp"

namespace equipoise {

/// Appends state `z` (dimension(balls) numbers) at time `t`, rotor angle `psi` and speed `w` to every array. `tilt`:
/// the four variables of a rotor that tilts.
void record(Trajectory& out, const model::Parameters& p, double psi, double w, double t, const double* z,
            const double* tilt = nullptr);

}  // namespace equipoise
