// Why many starts stay undecided: what some of them do at the end, and which known rate the horizon was too short for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "equipoise/model/system.hpp"
#include "equipoise/rotor_family/horizon.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// Above this share of undecided starts a result says why.
inline constexpr double undecided_worth_a_word = 0.05;
/// As many are looked at.
inline constexpr std::size_t undecided_looked_at = 8;

/// What an undecided trajectory does at the horizon.
enum class Restlessness {
  near_balance,  ///< it is near a balanced state
  creeping,      ///< all is nearly at rest, and nothing near balance
  chaotic,       ///< its largest Lyapunov exponent is positive
  regular,       ///< it goes on in a way whose windows do not repeat yet
  // Of machines:
  held,            ///< a driven rotor never comes to the speed at which its balls are let go
  running_away,    ///< a motor whose torque never vanishes speeds it up without end
  speeding_up,     ///< its mean speed still rises
  changing_speed,  ///< its mean speed is not steady
  hardly_seen,     ///< not even eight parts of time
};
constexpr std::size_t restlessness_kinds = 9;

struct UndecidedEnd {
  Restlessness what = Restlessness::regular;
  double exponent = 0.0;  ///< chaotic only
  /// Held: the nearest speed to release.speed, and that. Speeding up: `reached` is the speed when it was last seen.
  double reached = 0.0, asked = 0.0;
};

/// `state`: where it is at the horizon; at a strobe if the rotor is strobed.
UndecidedEnd look_at_undecided(const model::System& system, const Eigen::VectorXd& state);

/// The slowest known rate and the horizon that it asks for.
std::string slowness_text(const Horizon& horizon);

/// Of those that are held: how near to release.speed they come at best. Empty if none is.
std::string held_text(const std::vector<UndecidedEnd>& ends);

/// One line, without a full stop: how many of `ends` do what, and, where more time might help, what the horizon was
/// against the slowest known rate, or against a run-up. Times and speeds are in the study's units.
std::string why_undecided(const Study& study, const Horizon& horizon, const std::vector<UndecidedEnd>& ends);

}  // namespace equipoise
