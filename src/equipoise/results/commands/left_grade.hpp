// The balance quality grades of the rotor alone, and of the unbalance that the balls leave.
#pragma once

#include <optional>

#include "equipoise/machine/balance/balance_grade.hpp"
#include "equipoise/machine/balance/tolerance_planes.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// In mm/s, for the centre of mass of rotor and balls at the rotor's final speed. `study` must have units.
inline double left_balance_grade(double unbalance, const Study& study) {
  const double eccentricity = unbalance / (1.0 + study.parameters.total_mass());
  return model::balance_grade(eccentricity * study.scales->length, study.system().pace() * study.scales->frequency);
}

/// Whether the study has units, and its rotor two planes to be judged in if it tilts.
inline bool is_graded(const Study& study) {
  return study.scales && (!study.parameters.tilts() || model::tolerance_planes(study.bearings));
}

/// In mm/s, of the rotor without balls at this speed; empty unless is_graded().
inline std::optional<double> own_balance_grade(const Study& study, double speed) {
  if (!is_graded(study)) return std::nullopt;
  model::Parameters bare = study.parameters;
  bare.balls = 0;
  double unbalance = bare.eccentricity;
  if (bare.tilts()) unbalance = model::judged_unbalance(bare, *model::tolerance_planes(study.bearings), nullptr);
  return model::balance_grade(unbalance * study.scales->length, speed * study.scales->frequency);
}

}  // namespace equipoise
