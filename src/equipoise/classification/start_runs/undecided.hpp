// Explains why many starts stay undecided: how some go on at the end, and which known rate was too slow.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Chaos that a trajectory is still in at the horizon, if that is long enough (lasting_chaos) and no listed chaos is like
/// it: an outcome of its own, with a rate at which starts leave it. No finite time shows whether it lasts for ever.
inline constexpr char long_lived_chaos[] = "long-lived chaos";

/// A result with a larger share of undecided starts says why.
inline constexpr double undecided_worth_a_word = 0.05;
/// How many of them are looked at.
inline constexpr std::size_t undecided_looked_at = 8;

/// How an undecided trajectory goes on at the horizon.
enum class Restlessness {
  near_balance,  ///< it is near a balanced state, and stays there
  creeping,      ///< everything is nearly at rest, but not near balance
  chaotic,       ///< its largest Lyapunov exponent is positive
  regular,       ///< it goes on in a way whose windows do not repeat yet
  // Driven rotors only:
  clamped,         ///< the rotor never reaches the speed that releases its balls
  running_away,    ///< its motor's torque never vanishes, so it speeds up without end
  speeding_up,     ///< its mean speed still rises
  changing_speed,  ///< its mean speed is not steady
  hardly_seen,     ///< it was watched over fewer than eight windows
  // Any rotor:
  unidentified,  ///< its windows repeated before the horizon, but it could not be followed to a motion
};
constexpr std::size_t restlessness_kinds = 10;

struct UndecidedEnd {
  Restlessness what = Restlessness::regular;
  double exponent = 0.0;  ///< chaotic only
  /// Clamped: the speed nearest to release.speed, and release.speed. Speeding up: `reached` is the last speed.
  double reached = 0.0, asked = 0.0;
};

/// `state`: the state at the horizon, or on the next stroboscopic section if there is one.
UndecidedEnd look_at_undecided(const model::System& system, const Eigen::VectorXd& state);

/// "0.05 s", or dimensionless without units.
std::string time_words(const Study& study, double time, int digits);

/// The slowest known rate and the horizon that it asks for.
std::string slowness_text(const Horizon& horizon);

/// How near rotors with clamped balls come to release.speed at best. Empty if there are none.
std::string clamped_text(const std::vector<UndecidedEnd>& ends);

/// One line without a full stop: how many of `ends` go on in which way. Where more time might help, it also compares
/// the horizon with the slowest known rate, or with a run-up. Times and speeds are in the study's units.
std::string why_undecided(const Study& study, const Horizon& horizon, const std::vector<UndecidedEnd>& ends);

}  // namespace equipoise
