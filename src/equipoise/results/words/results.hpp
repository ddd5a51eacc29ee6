// Names of parameters and of states, as results tell them.
#pragma once

namespace equipoise::words::results {

// Axes of branches.
inline constexpr char final_speed[] = "final rotor speed Omega / sqrt(k/M)";
inline constexpr char eccentricity[] = "eccentricity lambda / race radius";
inline constexpr char damping[] = "external damping zeta = c / sqrt(k M)";
inline constexpr char stiffness[] = "support stiffness kappa";
inline constexpr char mass_of_ball[] = "mass of a ball mu / rotor mass";
inline constexpr char drag_of_ball[] = "drag of a ball beta";

// Behind a statement about one balanced state of many.
inline constexpr char one_of_a_continuum[] = ", in the state shown of a continuum";

}  // namespace equipoise::words::results
