// Eigenvalues at a balanced state, or multipliers over the time after which the equations repeat themselves.
#pragma once

#include <array>
#include <complex>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/results/types/left_out.hpp"
#include "equipoise/results/types/periodic_orbit.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

using BallAngles = std::array<double, model::max_balls>;

/// Rounding moves an eigenvalue by about 1e-15, a double zero, as continua have without drag, by its square root.
inline constexpr double zero_rate = 1e-7;

/// Slowest first, without the continuum's own `freedom` zeros; of a continuum, rates up to `zero` become 0.
std::vector<std::complex<double>> without_continuum(const Eigen::VectorXcd& rates, int freedom, double zero);

/// The speed of a balanced rotor in the end: the prescribed one, that which the motor holds, or, where the torque
/// vanishes for good, that of the rotor alone. Empty if the motor holds none. `system`: the study's.
std::optional<double> speed_in_balance(const Study& study, const model::System& system);

/// The balls' angles in one of the balanced states; of a continuum far from its ends, with room for balls of these
/// widths. None if there is none.
std::optional<BallAngles> balanced_angles(const model::BalancedStates& states, const model::Parameters& p,
                                          const std::vector<double>& width = {});

/// As much of the rotor as linear theory knows, at a constant speed.
struct LinearRotor {
  model::Parameters parameters;
  double speed;
  unsigned char left_out = 0;  ///< bits of LeftOut

  model::System system() const { return {parameters, speed}; }
  model::System with_drag(double factor) const;
};
/// Gravity is left out of a continuum (`family`), and where a ball's weight exceeds its centrifugal force.
LinearRotor linear_rotor(const Study& study, double speed, bool family);

/// Whether a turn at this speed lasts more than 1e4 radians of the fastest vibration, half a second's work: nothing
/// that is meant to answer at once follows such a rotor.
bool is_too_stiff(const model::Parameters& p, double speed);

/// How deviations from balance grow or die out.
struct BalancedRates {
  std::vector<std::complex<double>> rates;  ///< slowest first; ln(multiplier)/period where the equations repeat
  std::optional<PeriodicOrbit> orbit;       ///< what the balanced state became, where nothing rests
};
/// At the balanced state with these ball angles; also under a motor, if nothing depends on the rotor's angle. Empty if
/// gravity or unequal supports leave no balanced motion, or if `stop` is set.
std::optional<BalancedRates> balanced_rates(const model::System& system, const BallAngles& phi, bool family,
                                            const StopFlag* stop = nullptr);

}  // namespace equipoise
