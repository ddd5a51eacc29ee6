// How long starts are followed where a study does not say: as its slowest known rate asks.
#pragma once

#include <string>

#include "equipoise/model/parameters.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// Rates at which starts come to balance or leave it at constant speed, by the linearised equations, and at which drag
/// brings moving balls to whatever they come to.
struct SettlingRates {
  double approach = 0.0;  ///< slowest rate at which a stable balanced state is approached (> 0); 0: there is none
  double growth = 0.0;    ///< slowest rate at which an unstable one is left (> 0); 0: there is none
  double drag = 0.0;  ///< half the least ball drag: of balls that move together, exactly that; 0: nothing damps them

  /// The slowest one.
  double slowest() const;
};

/// Of the isotropic, horizontal rotor with `p`'s mean stiffness and damping and a centred race: gravity, anisotropy and
/// all that makes a machine change rates, and seldom their size. Of a continuum of balanced states: at members drawn
/// over it; a quarter of them may be slower.
SettlingRates settling_rates(const model::Parameters& p, double speed);

/// How long a start is followed after the last branch begins (and release), and why so long.
struct Horizon {
  double time = 0.0;
  bool given = false;   ///< by the study
  SettlingRates rates;  ///< at the final speed; of a driven rotor at the one that its motor aims at
  double asked = 0.0;   ///< the time that the slowest rate asks for; infinite without drag

  bool long_enough() const { return asked <= time; }
};

/// numerics.horizon, or what is chosen where that is open. Depends on rotor, balancer, final speed and
/// numerics.decide alone: with `horizon` every start goes there, so that less is chosen.
Horizon choose_horizon(const Study& study);

/// The study with its horizon filled in, so that every output states what was used.
Study with_horizon(Study study);

}  // namespace equipoise
