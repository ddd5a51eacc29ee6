// Possible protocols of table 7 of Wright and Peng (2019).
#pragma once

#include <array>
#include <vector>

#include "equipoise/extras/reproduction/reproduction.hpp"
#include "equipoise/machine/drives/speed.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

inline constexpr std::uint64_t table_7_printed_starts = 300000;

/// psi' while the ramp function Omega(t) runs straight from (t_b, Omega_b).
enum class BranchLaw {
  kinematic,  ///< psi' = Omega(t)
  published,  ///< psi = t Omega(t): psi' = Omega + t Omega'
  own_time,   ///< psi = psi(t_b) + (t - t_b) Omega(t): psi' = Omega + (t - t_b) Omega'
};

/// When the balls are released.
enum class Table7Release { at_rise_speed, at_hold_end, at_fall_speed, at_settling };

/// One possible protocol of table 7. Defaults: the paper's words.
struct Table7Protocol {
  BranchLaw rise = BranchLaw::published;  ///< for a rise from t = 0 own_time is the same
  BranchLaw fall = BranchLaw::published;
  Table7Release release = Table7Release::at_rise_speed;
  double release_speed = 3.0;  ///< of the ramp function, for at_rise_speed (peak: T0; 0: at once) and at_fall_speed
  double peak = 3.0, final = 2.0;
  bool durations = false;  ///< T0, T1, T2 are lengths of rise, hold and fall
  double drag = 0.05, damping = 0.5, mass = 0.05, eccentricity = 0.01;

  /// The ends of rise, hold and fall.
  std::array<double, 3> ends(const Table7Row& row) const;
  double release_time(const Table7Row& row) const;
  /// The rotor's motion, for observe().
  std::vector<model::Segment> segments(const Table7Row& row) const;
  /// Rotor, balancer and seed 1; its [speed] is the ramp function under the kinematic law.
  Study study(const Table7Row& row) const;
};

}  // namespace equipoise
