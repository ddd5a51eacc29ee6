// Vibration that a machine's handles pass to hands: the frequency weighting of ISO 5349-1:2001 with the parameters of
// ISO 8041:2005, and daily exposure by Directive 2002/44/EC.
#pragma once

namespace equipoise::standards {

/// Weighting W_h at a frequency in Hz, > 0.
double hand_arm_weighting(double frequency);

/// Weighted acceleration, m/s^2, of all directions together, of a vibration at one frequency (Hz) with this root mean
/// square velocity of all directions together (m/s). For a circular orbit of radius r: W_h r omega^2.
double hand_arm_acceleration(double frequency, double rms_velocity);

/// Daily exposures A(8) over eight hours from which employers must act, and which must not be exceeded, m/s^2
/// (Directive 2002/44/EC, article 3).
inline constexpr double exposure_action_value = 2.5, exposure_limit_value = 5.0;

/// Hours of use after which the daily exposure reaches `value`: 8 (value/acceleration)^2. May exceed a day.
double hours_to_exposure(double acceleration, double value);

}  // namespace equipoise::standards
