// Labels of the parameters that branches are continued along.
#include "equipoise/results/commands/branches_result.hpp"

#include "equipoise/results/words/results.hpp"

namespace equipoise {

std::string parameter_label(const std::string& key) {
  if (key == "speed.final" || key == "speed.speed") return words::results::final_speed;
  if (key == "rotor.eccentricity") return words::results::eccentricity;
  if (key == "rotor.damping") return words::results::damping;
  if (key == "rotor.stiffness") return words::results::stiffness;
  if (key == "balancer.mass") return words::results::mass_of_ball;
  if (key == "balancer.drag") return words::results::drag_of_ball;
  return key;
}

}  // namespace equipoise
