// A state as a row of a trajectory.
#pragma once

#include <vector>

#include "equipoise/model/parameters.hpp"
#include "equipoise/results/trajectory.hpp"

namespace equipoise {

/// Appends state `z` (dimension(balls) numbers) at time `t`, rotor angle `psi` and speed `w` to every array but those
/// of bearings. `tilt`: the four variables of a rotor that tilts.
void record(Trajectory& out, const model::Parameters& p, double psi, double w, double t, const double* z,
            const double* tilt = nullptr);

/// Appends to the arrays of bearings at these places along the shaft, one each.
void record_bearings(Trajectory& out, const model::Parameters& p, const std::vector<double>& places, double psi,
                     const double* z, const double* tilt);

}  // namespace equipoise
