// SharedRegions around stable periodic motions: level sets of a quadratic form that goes round with the motion.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "equipoise/attractors/motion_symmetry.hpp"
#include "equipoise/classification/classification_rule.hpp"
#include "equipoise/model/system.hpp"

namespace equipoise {

/// A table over a phase that a state tells by itself: where the rotor's angle matters that angle, which is known beside
/// every state or is part of it; else the angle of a ball that turns steadily along the motion, the clock.
struct OrbitRegion {
  static constexpr int rotor = -1;

  struct Node {
    Eigen::VectorXd state;  ///< on the motion, angles unwrapped along it
    Eigen::VectorXd
        rate;  ///< where the phase is the rotor's angle: dz/dt there; under a motor, dz by what the rotor turns
    Eigen::MatrixXd form;  ///< P: V = d^T P d; of a clock among the balls of the whole state, without a part along the
                           ///< motion, else of what is compared
  };

  int attractor = 0;
  int clock = rotor;        ///< the ball whose angle is the phase, or the rotor
  int phase_place = -1;     ///< of the phase in the state, -1: it is none of it
  int turns = 1;            ///< of the phase in one period; of the rotor by section_angle()
  int cells = 0;            ///< of the table a turn
  std::vector<Node> nodes;  ///< turns x cells by growing phase, and the first once more a period later
  Eigen::VectorXd unit;     ///< of deviations d, component by component
  double level = 0.0;       ///< inside: V < level

  int rows() const { return turns * cells; }
};

/// V of a state, when the rotor's angle is `psi` (if that is no part of it): the least over the turns that the phase
/// leaves open. Where the phase is the rotor's angle, like balls take the places of those on the motion that they are
/// nearest to, and a state that plainly lies above the trapping region's level may get an infinite V.
double value(const model::System& system, const OrbitRegion& region, const double* state, double psi);

/// A state on the level `level` where row `row` of the table begins. `direction`: a unit vector, of directions()
/// numbers.
Eigen::VectorXd state_on_level(const OrbitRegion& region, int row, double level, const Eigen::VectorXd& direction);
int directions(const OrbitRegion& region);

/// V grows in every direction away from the motion, as computed.
bool is_definite(const OrbitRegion& region);

/// The trapping region around the motion that exchange of balls makes of this one.
OrbitRegion exchanged(const OrbitRegion& region, int balls, const BallOrder& order);

/// What lanes ask of a trapping region whose clock is a ball.
OrbitRegionTable table_of(const OrbitRegion& region, int balls);

}  // namespace equipoise
