// Table 7 of Wright and Peng (2019), the trapezoid: its rows, readings of its protocol, and shares of starts that a
// test at a finite time calls balanced. docs/table-7.md has the evidence.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "equipoise/basins/observation.hpp"
#include "equipoise/model/speed.hpp"
#include "equipoise/statistics/share.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// A row as printed: the ramp function rises from 0 to 3 until T0, stays until T1 and falls to 2 until T2.
struct Table7Row {
  double t0, t1, t2;
  double printed;  ///< balanced, in percent, of 300 000 starts
};
inline constexpr std::array<Table7Row, 4> table_7_rows{
    {{50, 400, 500, 98.43}, {100, 300, 500, 97.19}, {100, 400, 500, 97.64}, {200, 400, 500, 93.64}}};
inline constexpr std::uint64_t table_7_printed_starts = 300000;

/// What psi' does while the ramp function Omega(t) runs straight from (t_b, Omega_b).
enum class BranchLaw {
  kinematic,  ///< psi' = Omega(t)
  published,  ///< psi = t Omega(t): psi' = Omega + t Omega'
  own_time,   ///< psi = psi(t_b) + (t - t_b) Omega(t): psi' = Omega + (t - t_b) Omega'
};

/// When the balls are let go.
enum class Table7Release { at_rise_speed, at_hold_end, at_fall_speed, at_settling };

/// A reading of how table 7 was computed. Defaults: the paper's words.
struct Table7Protocol {
  BranchLaw rise = BranchLaw::published;  ///< of a rise from t = 0: own_time is the same
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

/// A test of balance at a finite time: r below `tolerance` throughout [from, to], multiples of table_7_window, or at
/// the one time where both are equal.
struct Table7Test {
  double from, to, tolerance;
};
inline constexpr double table_7_window = 10.0;

/// How many of the starts observed in windows of table_7_window pass `test`.
std::uint64_t called_balanced(const Observation& observation, const Table7Test& test);

/// A protocol with a test.
struct Table7Reading {
  Table7Protocol protocol;
  Table7Test test;
};

/// The best lead, not a claim (docs/table-7.md): kinematic law, balls released when the ramp reaches 2.2, balanced if r
/// stays below 0.00134 from t = 630 to 730. The release was chosen among 96 protocols, time and tolerance were FITTED
/// to the four printed shares; none is in the paper's text.
Table7Reading table_7_lead();

/// What a reading says of one row.
struct ObservationReading {
  Table7Row row;
  Share balanced;  ///< starts that pass the test
};

/// The four rows under `reading`, from starts 0 .. starts - 1 of seed 1. Throws RunError if stopped early.
std::vector<ObservationReading> observe_table_7(const Table7Reading& reading, std::uint64_t starts, int threads = 0,
                                                const StopFlag* stop = nullptr);

}  // namespace equipoise
