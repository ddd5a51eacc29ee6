// Labels of the parameters that branches are continued along.
#include "equipoise/results/branches_result.hpp"

namespace equipoise {

std::string parameter_label(const std::string& key) {
  if (key == "speed.final" || key == "speed.speed") return "final rotor speed Omega / critical speed";
  if (key == "rotor.eccentricity") return "eccentricity lambda / race radius";
  if (key == "rotor.damping") return "external damping zeta = c / sqrt(k M)";
  if (key == "rotor.stiffness") return "support stiffness kappa";
  if (key == "balancer.mass") return "mass of a ball mu / rotor mass";
  if (key == "balancer.drag") return "drag of a ball beta";
  return key;
}

}  // namespace equipoise
