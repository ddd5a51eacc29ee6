// The studies that most tests start from, as texts; changes and searches in texts.
#pragma once

#include <stdexcept>
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
inline const std::string ramp_speed =
    rotor_and_balancer + "[speed]\nprofile = \"ramp\"\nfinal = 2.4\nduration = 500.0\n";

/// omega_c = sqrt(48000/12) = 20 sqrt(10) rad/s; each ball 1.8 kg mm, the unbalance 2.4 kg mm. [speed] must be added.
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
inline const std::string constant_machine = machine_rotor + "[speed]\nprofile = \"constant\"\nspeed = \"2000 rpm\"\n";
inline const std::string ramp_machine =
    machine_rotor + "[speed]\nprofile = \"ramp\"\nfinal = \"3000 rpm\"\nduration = \"10 s\"\n";

/// `text` with its first `from` replaced by `to`.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("no \"" + from + "\" in\n" + text);
  return text.replace(at, from.size(), to);
}

inline bool holds(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

}  // namespace equipoise
