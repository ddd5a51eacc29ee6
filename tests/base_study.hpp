// The rotor that most tests start from, as a study's text.
#pragma once

#include <string>

namespace equipoise {

inline const std::string rotor_and_balancer = R"([rotor]
eccentricity = 0.01
damping = 0.5
[balancer]
balls = 2
mass = 0.05
drag = 0.05
)";
inline const std::string constant_speed = rotor_and_balancer + "[speed]\nprofile = \"constant\"\nspeed = 2.4\n";

}  // namespace equipoise
