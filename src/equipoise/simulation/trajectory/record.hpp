// A state as a row of a trajectory.
#pragma once

#include <vector>

#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/results/commands/trajectory.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Appends state `z` (dimension(balls) numbers) at time `t`, rotor angle `psi` and speed `w` to every array but those
/// of bearings. `tilt`: the four variables of a rotor that tilts.
void record(Trajectory& out, const model::Parameters& p, double psi, double w, double t, const double* z,
            const double* tilt = nullptr);

/// Where a rotor that tilts has bearings, and each of them if it is known.
struct ShaftBearings {
  std::vector<double> places;
  std::vector<model::Bearing> each;
};
inline ShaftBearings shaft_bearings(const Study& study) { return {study.bearings, study.each_bearing()}; }

/// Appends to the arrays of bearings.
void record_bearings(Trajectory& out, const model::Parameters& p, const ShaftBearings& bearings, double psi,
                     const double* z, const double* tilt);

}  // namespace equipoise
