// A state as a row of a trajectory.
#pragma once

#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/results/commands/trajectory.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Appends state `z` (dimension(balls) numbers) at time `t`, rotor angle `psi` and speed `w` to every array but those
/// of bearings. `tilt`: the four variables of a tilting rotor.
void record(Trajectory& out, const model::Parameters& p, double psi, double w, double t, const double* z,
            const double* tilt = nullptr);

/// Appends state `z` of a machine (model::machine_layout()) at time `t`, at the bearings of a tilting rotor as well.
void record(Trajectory& out, const Study& study, double t, const double* z);

}  // namespace equipoise
