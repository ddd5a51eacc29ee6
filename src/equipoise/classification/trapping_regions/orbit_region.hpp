// Trapping regions around stable periodic motions: level sets of a quadratic form that goes round with the motion.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/attractors/motions/motion_symmetry.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

/// A table over a phase that follows from the state. If the rotor's angle matters that is the phase, whether it is
/// known next to every state or part of it. Otherwise it is the angle of a ball that turns steadily along the motion,
/// the clock.
struct OrbitRegion {
  static constexpr int rotor = -1;

  struct Node {
    Eigen::VectorXd state;  ///< on the motion, angles unwrapped along it
    Eigen::VectorXd rate;   ///< if the phase is the rotor's angle: dz/dt there or, with a motor, dz over dpsi
    Eigen::MatrixXd form;   ///< P: V = d^T P d; with a ball as clock of the whole state, without a part along the
                            ///< motion; else of the compared components
  };

  int attractor = 0;
  int clock = rotor;        ///< the ball whose angle is the phase, or the rotor
  int phase_place = -1;     ///< place of the phase in the state, -1 if the state lacks it
  int turns = 1;            ///< of the phase in one period; of the rotor in units of section_angle()
  int cells = 0;            ///< of the table in a turn
  std::vector<Node> nodes;  ///< turns x cells by growing phase, and the first again a period later
  Eigen::VectorXd unit;     ///< of deviations d, by component
  double level = 0.0;       ///< inside: V < level

  int rows() const { return turns * cells; }
};

/// Fraction of the slowest rate that a form's decay must reach: closer to 1 it would be all slow directions.
inline constexpr double share_of_rate = 0.8;

/// P = sum_k Re(conj(w_k) w_k^T) of the left Floquet vectors at one state of an orbit (FloquetFrame::left).
Eigen::MatrixXd floquet_form(const Eigen::MatrixXcd& left);

/// The trapping regions, with levels still 0, of a stable periodic motion or, if the rotor's angle matters, of a
/// balanced equilibrium. One region for each motion that exchange of alike balls makes of it or, with the rotor's angle
/// as phase, one for all of them. Empty if none can be made: too long a period, no ball that turns steadily, too many
/// images, Floquet vectors that double precision cannot separate, a continuum, a failed integration.
std::vector<OrbitRegion> orbit_regions(const model::System& system, const Motion& motion, int attractor);

/// V of a state at rotor angle `psi` (unless the state contains it): the least over the turns that the phase leaves
/// open. If the phase is the rotor's angle, alike balls take the nearest places on the motion, and a state well above
/// the region's level may get an infinite V.
double value(const model::System& system, const OrbitRegion& region, const double* state, double psi);

/// A state on the level `level` where row `row` of the table begins. `direction`: a unit vector of directions()
/// numbers.
Eigen::VectorXd state_on_level(const OrbitRegion& region, int row, double level, const Eigen::VectorXd& direction);
int directions(const OrbitRegion& region);

/// Whether V, as computed, grows in every direction away from the motion.
bool is_definite(const OrbitRegion& region);

/// The trapping region around the motion that exchange of balls makes of this one.
OrbitRegion exchanged(const OrbitRegion& region, int balls, const BallOrder& order);

/// The table that lanes use if the clock is a ball.
OrbitRegionTable table_of(const OrbitRegion& region, int balls);

}  // namespace equipoise
