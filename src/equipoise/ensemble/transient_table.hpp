// What the time loop gathers of every trajectory for the statistics of transients, and the figures it comes to.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace equipoise {

/// What is asked of every trajectory. Dimensionless.
struct TransientSettings {
  /// Radial displacement whose exceedance is timed; infinite: none.
  double displacement = std::numeric_limits<double>::infinity();
  /// Radial displacement below which a rotor has settled; 0: settling is not watched.
  double settled = 0.0;
  double release = 0.0;  ///< study time at which the balls are let go
  /// Length of the windows of time at whose last the vibration "at the end" is taken. Many turns of the rotor, and
  /// several of the slow turns of balls about it.
  double window = 16.0;

  bool watches_settling() const { return settled > 0.0; }
};

/// What one trajectory has come to so far; grows over spin-up, release and branches. Squares, so that no root is taken
/// in the time loop.
struct TransientSums {
  double end = 0.0;                  ///< study time up to which all this holds
  double clamped_peak = 0.0;         ///< largest r^2 before release
  double free_peak = 0.0;            ///< largest r^2 from release on
  double force_peak = 0.0;           ///< largest |f|^2
  double force_integral = 0.0;       ///< of |f|^2 over time, from t = 0
  double time_above = 0.0;           ///< with r > settings.displacement, from t = 0
  double last_above = 0.0;           ///< study time at which r > settings.settled held last, from release on; else 0
  double window_length = 0.0;        ///< of what the window's sums are over
  double window_peak = 0.0;          ///< largest r^2 in it
  double window_velocity = 0.0;      ///< integral of u^2 + v^2
  double window_unbalance = 0.0;     ///< integral of |lambda + sum mu_i e^{i phi_i}|
};

/// The figures of one start, as they are stored and counted; not-a-number for one that was lost. Dimensionless: lengths
/// in R, forces in M R omega_c^2, velocities in R omega_c, times in 1/omega_c.
struct TransientRow {
  float peak_radial = 0.0f;                ///< of the centre O, over the whole run
  float peak_radial_after_release = 0.0f;  ///< from release on
  float peak_radial_at_end = 0.0f;         ///< in the last window
  float peak_force = 0.0f;                 ///< of springs and dampers on the support, over the whole run
  float rms_force = 0.0f;                  ///< the same, root mean square from t = 0 to followed_until
  float rms_velocity = 0.0f;               ///< of O, root mean square of the inertial velocity in the last window
  float residual_unbalance = 0.0f;         ///< mean |lambda + sum mu_i e^{i phi_i}| in the last window
  float time_above = 0.0f;     ///< with r above the displacement limit, from t = 0 to followed_until; 0 without a limit
  float settling_time = 0.0f;  ///< from release until r was last above `settled`; infinite: not below throughout the
                               ///< last window
  float followed_until = 0.0f;  ///< study time
};

/// A column of TransientRow.
struct TransientColumn {
  const char* name;       ///< in files
  const char* long_name;  ///< with its unit
  float TransientRow::*value;
};
inline constexpr std::array<TransientColumn, 10> transient_columns{{
    {"peak_radial", "largest radial displacement of the centre, in race radii", &TransientRow::peak_radial},
    {"peak_radial_after_release", "largest radial displacement from release on, in race radii",
     &TransientRow::peak_radial_after_release},
    {"peak_radial_at_end", "largest radial displacement in the last window, in race radii",
     &TransientRow::peak_radial_at_end},
    {"peak_force", "largest bearing force, in M R omega_c^2", &TransientRow::peak_force},
    {"rms_force", "root mean square bearing force of the run, in M R omega_c^2", &TransientRow::rms_force},
    {"rms_velocity", "root mean square velocity of the centre in the last window, in R omega_c",
     &TransientRow::rms_velocity},
    {"residual_unbalance", "mean unbalance of rotor and balls in the last window, in M R",
     &TransientRow::residual_unbalance},
    {"time_above", "time with the radial displacement above limits.displacement, in 1/omega_c",
     &TransientRow::time_above},
    {"settling_time",
     "time from release until the radial displacement was last above limits.settled, in 1/omega_c; missing: not settled",
     &TransientRow::settling_time},
    {"followed_until", "study time up to which the start was followed, in 1/omega_c", &TransientRow::followed_until},
}};

/// The sums of the trajectories of a task, by their place in it. Filled with spin_up or begun() rows, then handed to
/// one task after another.
struct TransientTable {
  TransientSettings settings;
  std::vector<TransientSums> rows;
};

/// The figures of sums that are complete; `lost`: of a trajectory that diverged or failed.
TransientRow transient_row(const TransientSettings& settings, const TransientSums& sums, bool lost);

}  // namespace equipoise
