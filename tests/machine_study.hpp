// The machine in physical units that several tests start from, and how those of texts look for words.
#pragma once

#include <string>

namespace equipoise {

/// omega_c = sqrt(48000/12) = 20 sqrt(10) rad/s; each ball 1.8 kg mm, the unbalance 2.4 kg mm. [speed] is to follow.
inline const std::string machine_rotor = R"([rotor]
mass = "12 kg"
stiffness = "48 kN/m"
damping = "400 N s/m"
eccentricity = "0.2 mm"
[balancer]
balls = 2
race_radius = "30 mm"
mass = "60 g"
drag = "2e-4 N m s"
)";
inline constexpr double machine_omega_c = 63.245553203367585;

inline bool holds(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

}  // namespace equipoise
