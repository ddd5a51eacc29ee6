// The balance quality grades of the rotor alone, and of the unbalance that the balls leave. Both are for the mass of
// the rotor that is balanced, without its balls.
#pragma once

#include <optional>

#include "equipoise/machine/balance/balance_grade.hpp"
#include "equipoise/machine/balance/tolerance_planes.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// In mm/s, of an unbalance U/M in R at this dimensionless speed. `study` must have units.
inline double grade_at(double unbalance, double speed, const Study& study) {
  return model::balance_grade(unbalance * study.scales->length, speed * study.scales->frequency);
}

/// The same at the rotor's final speed.
inline double left_balance_grade(double unbalance, const Study& study) {
  return grade_at(unbalance, study.system().pace(), study);
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
  return grade_at(unbalance, speed, study);
}

}  // namespace equipoise
