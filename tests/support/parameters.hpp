// The rotor that most tests start from, as parameters; studies of rotors.
#pragma once

#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// lambda = 0.01, zeta = 0.5, any number of equal balls.
inline model::Parameters base_rotor(int balls = 2, double drag = 0.05, double mass = 0.05) {
  model::Parameters p;
  p.balls = balls;
  p.mass.fill(mass);
  p.drag.fill(drag);
  return p;
}

/// At constant speed.
inline Study study_of(const model::Parameters& p, double speed) {
  Study study;
  study.name = "rotor";
  study.parameters = p;
  study.speed.profile = Profile::constant;
  study.speed.speed = speed;
  return study;
}

}  // namespace equipoise
