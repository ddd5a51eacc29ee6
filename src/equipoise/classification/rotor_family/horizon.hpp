// Chooses how long starts are followed if a study does not say: as long as its slowest known rate needs.
#pragma once

#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Rates of the linearised equations at constant speed: of coming to balance, of leaving it, and of drag on moving
/// balls.
struct SettlingRates {
  double approach = 0.0;  ///< slowest approach to a stable balanced state (> 0); 0: there is none
  double growth = 0.0;    ///< slowest departure from an unstable one (> 0); 0: there is none
  double drag = 0.0;      ///< half the least ball drag, the exact rate of balls that move together; 0: undamped

  double slowest() const;
};

/// How long a start is followed from the last piece of the drive (and release) on, and why.
struct Horizon {
  double time = 0.0;
  bool given = false;   ///< by the study
  SettlingRates rates;  ///< at the final speed, or at the speed that a motor aims at
  double asked = 0.0;   ///< what the slowest rate needs; infinite without drag

  bool long_enough() const { return asked <= time; }
};

/// numerics.horizon or, if the study leaves it open, a chosen one. Depends on rotor, balancer, final speed and
/// numerics.decide alone. With decide = "horizon" every start runs that long, so a shorter one is chosen.
Horizon choose_horizon(const Study& study);

/// Fills the study's horizon in, so that every output states the one used.
Study with_horizon(Study study);

}  // namespace equipoise
