// The balance quality grade of the unbalance that the balls leave.
#pragma once

#include "equipoise/mechanics/balance_grade.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// In mm/s, for the centre of mass of rotor and balls at the rotor's final speed. `study` must have units.
inline double left_balance_grade(double unbalance, const Study& study) {
  const double eccentricity = unbalance / (1.0 + study.parameters.total_mass());
  return model::balance_grade(eccentricity * study.scales->length, study.system().pace() * study.scales->frequency);
}

}  // namespace equipoise
