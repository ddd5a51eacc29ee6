// The dimensionless parameters of a rotor with a ball balancer (length R, time 1/omega_c, mass M), and the layout of
// its state. Everything depends on both.
#pragma once

#include <array>
#include <cmath>

namespace equipoise::model {

inline constexpr int max_balls = 16;

/// A rational number that each number type rounds, or encloses, by itself.
struct Ratio {
  double over, under;
  constexpr double value() const { return over / under; }
};
/// Moment of inertia of a solid sphere about its centre, over its mass and the square of its radius.
inline constexpr Ratio sphere_inertia{2.0, 5.0};

/// How a rotor tilts, and where along its shaft the balls run (docs/explanation/equations.md, "A tilting rotor").
/// Places along the shaft count from the rotor's centre of mass, in R; moments of inertia in M R^2, without the balls.
struct Tilt {
  double transverse_inertia = 0.0;  ///< Jt, about a diameter; 0: the rotor does not tilt
  double polar_inertia = 0.0;       ///< Jp, about its axis, >= 0
  double misalignment = 0.0;        ///< chi, angle in rad between principal axis and shaft, towards angle 0
  /// Of the supports in X and Y: {k12, k22}, the moment for a deflection, or force for a tilt, and the moment for a
  /// tilt.
  std::array<std::array<double, 2>, 2> stiffness{};
  std::array<std::array<double, 2>, 2> damping{};  ///< also {c12, c22}
  std::array<double, max_balls> plane{};           ///< z_i: of each ball's race

  /// The couple unbalance chi (Jt - Jp), along angle 0.
  double couple() const { return misalignment * (transverse_inertia - polar_inertia); }
  bool isotropic() const { return stiffness[0] == stiffness[1] && damping[0] == damping[1]; }
};

/// Of a rotor without balls, about the shaft's axis at its centre of mass: what its inertia is unless stated.
inline double axial_inertia(const Tilt& t) { return t.polar_inertia + t.couple() * t.misalignment; }

/// Rotor, supports and balls; constant in time. Symbols as in Wright and Peng (2019) and docs/explanation/equations.md.
/// Ranges are checked when a study is read.
struct Parameters {
  int balls = 2;                              ///< n, 1 to max_balls
  double eccentricity = 0.01;                 ///< lambda = eps/R, >= 0
  std::array<double, 2> damping{0.5, 0.5};    ///< zeta_x, zeta_y = c/sqrt(k M), >= 0 (twice the damping ratio)
  std::array<double, 2> stiffness{1.0, 1.0};  ///< kappa_x, kappa_y = k/(M omega_c^2), > 0
  double gravity = 0.0;                       ///< G = g/(R omega_c^2), acting along -Y
  std::array<double, max_balls> mass{};       ///< mu_i = m_i/M, > 0
  std::array<double, max_balls> drag{};       ///< beta_i = D_i/(m_i R^2 omega_c), >= 0

  // Beyond the paper, each off at its default; docs/explanation/equations.md says where each comes from.
  double inertia = 0.0;                         ///< iota = I_C/(M R^2) about the centre of mass; driven rotor only
  std::array<double, 2> race_offset{0.0, 0.0};  ///< e/R: centre of the race from the shaft's, in the rotating frame
  std::array<double, max_balls> rolling{};      ///< resistance of a moving ball over its normal force, >= 0
  std::array<double, max_balls> stiction{};     ///< largest resistance of a resting ball over its normal force
  double contact_angle = 0.0;                   ///< between touching balls, seen from the race's centre; 0: they pass
  double restitution = 0.5;                     ///< of ball on ball, 0 to 1
  bool rolls = false;                           ///< balls are solid spheres that roll without slip; else they slide
  std::array<double, max_balls> ball_radius{};  ///< of a ball that rolls, over R; 0 to 1
  Tilt tilt{};                                  ///< tilts() says whether the rotor does
  double eccentricity_angle = 0.0;              ///< beta_0: of the centre of mass, from angle 0; 0 unless tilts()

  /// Sum of mu_i.
  double total_mass() const {
    double sum = 0.0;
    for (int i = 0; i < balls; ++i) sum += mass[i];
    return sum;
  }
  /// lambda + sum mu_i: the largest possible unbalance, and the order of magnitude of r and of the rotor's velocity.
  /// For a tilting rotor, with the couple unbalance, and also of the order of the tilt.
  double all_unbalances() const {
    const double sum = eccentricity + total_mass();
    return tilts() ? sum + std::fabs(tilt.couple()) : sum;
  }
  /// What a small motion of the rotor is measured by: its unbalances, or the unit of length if it has none.
  double motion_scale() const { return all_unbalances() > 0.0 ? all_unbalances() : 1.0; }
  bool tilts() const { return tilt.transverse_inertia > 0.0; }
  /// Inertia of a ball along the race over its mass; a rolling ball adds its spin's.
  double inertia_along_race() const { return rolls ? 1.0 + sphere_inertia.value() : 1.0; }
  bool isotropic() const { return damping[0] == damping[1] && stiffness[0] == stiffness[1] && tilt.isotropic(); }
  /// Exchanging these two balls makes no difference.
  bool alike(int i, int k) const {
    return mass[i] == mass[k] && drag[i] == drag[k] && rolling[i] == rolling[k] && stiction[i] == stiction[k] &&
           ball_radius[i] == ball_radius[k] && tilt.plane[i] == tilt.plane[k];
  }
  bool equal_balls() const {
    for (int i = 1; i < balls; ++i)
      if (!alike(i, 0)) return false;
    return true;
  }
  bool race_is_centred() const { return race_offset[0] == 0.0 && race_offset[1] == 0.0; }
  bool balls_collide() const { return contact_angle > 0.0; }
  bool balls_stick() const {
    for (int i = 0; i < balls; ++i)
      if (rolling[i] > 0.0 || stiction[i] > 0.0) return true;
    return false;
  }
};

/// Number of state variables: x, y, u, v, phi_1..phi_n, q_1..q_n.
constexpr int dimension(int balls) { return 4 + 2 * balls; }

/// Where each variable sits in a state array.
/// x, y: centre O in the rotating frame; u, v: INERTIAL velocity of O in rotating components, u = x' - psi' y,
/// v = y' + psi' x; phi_i: ball angle in the rotating frame, unwrapped; q_i = phi_i'.
namespace index {
inline constexpr int x = 0, y = 1, u = 2, v = 3;
constexpr int phi(int i) { return 4 + i; }
constexpr int q(int i, int balls) { return 4 + balls + i; }
}  // namespace index

}  // namespace equipoise::model

namespace equipoise {

/// Of the state of any system (machine/model/system.hpp): a driven rotor's angle, speed and speed error come last, then
/// the four variables of a tilt.
inline constexpr int max_dimension = model::dimension(model::max_balls) + 7;

}  // namespace equipoise
