// Names of events on a branch, its ranges, its numbers.
#include "equipoise/results/commands/branch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>


namespace equipoise {

const char* name_of(BranchChange change) {
  constexpr std::array<const char*, 7> names{"birth",          "death", "first seen", "last seen", "stability gained",
                                             "stability lost", "kind"};
  return names[static_cast<std::size_t>(change)];
}

const char* name_of(BranchCause cause) {
  constexpr std::array<const char*, 11> names{"fold",
                                              "pitchfork",
                                              "period doubling",
                                              "Neimark-Sacker",
                                              "Hopf",
                                              "torus to chaos",
                                              "chaos to torus",
                                              "to periodic",
                                              "from periodic",
                                              "no longer attracting",
                                              "not followed further"};
  return names[static_cast<std::size_t>(cause)];
}

std::vector<ValueRange> ranges_of(const Branch& branch) {
  const auto& points = branch.points;
  const auto first = std::find_if(branch.events.begin(), branch.events.end(), [](const BranchEvent& e) {
    return e.change == BranchChange::stability_gained || e.change == BranchChange::stability_lost;
  });
  const bool before_points = first != branch.events.end() && first->middle() < points.front().value;
  const bool stable = before_points ? first->change == BranchChange::stability_lost : points.front().motion.stable;
  std::vector<ValueRange> ranges{{points.front().value, points.front().value, stable}};
  // Stability may be lost and regained between two points, or between the last point and the end.
  auto event = branch.events.begin();
  const auto pass_events = [&](double until) {
    for (; event != branch.events.end() && event->middle() < until; ++event) {
      if (event->change != BranchChange::stability_gained && event->change != BranchChange::stability_lost) continue;
      ranges.back().end = event->middle();
      ranges.push_back({event->middle(), event->middle(), event->change == BranchChange::stability_gained});
    }
  };
  for (const BranchPoint& point : points) {
    pass_events(point.value);
    if (point.motion.stable != ranges.back().stable) ranges.push_back({point.value, point.value, point.motion.stable});
    ranges.back().end = point.value;
  }
  pass_events(std::numeric_limits<double>::infinity());
  for (const BranchEvent& e : branch.events) {
    if (e.change == BranchChange::birth || e.change == BranchChange::first_seen) ranges.front().begin = e.place();
    if (e.change == BranchChange::death || e.change == BranchChange::last_seen) ranges.back().end = e.place();
  }
  return ranges;
}

double growth_rate(const Motion& motion) {
  double rate = -std::numeric_limits<double>::infinity();
  if (motion.orbit.nodes.empty() && motion.kind == MotionKind::equilibrium && motion.spectrum.size() > 0) {
    for (const auto& value : motion.spectrum)
      if (std::abs(value) >= zero_eigenvalue) rate = std::max(rate, value.real());
    return rate;
  }
  if (!motion.orbit.nodes.empty()) return std::log(largest_multiplier(motion)) / motion.orbit.period;
  const std::size_t zeros = motion.kind == MotionKind::quasi_periodic ? 2 : 0;
  return motion.exponents.size() > zeros ? motion.exponents[zeros] : std::numeric_limits<double>::quiet_NaN();
}

double largest_multiplier(const Motion& motion) {
  constexpr double unit_multiplier = 1e-7;  // along a continuum of balanced states multipliers differ from 1 by less
  if (motion.orbit.nodes.empty()) return std::numeric_limits<double>::quiet_NaN();
  for (const auto& value : motion.orbit.decays())
    if (motion.kind == MotionKind::periodic || std::abs(value - 1.0) >= unit_multiplier) return std::abs(value);
  return std::numeric_limits<double>::quiet_NaN();
}

std::string parameter_label(const std::string& key) {
  if (key == "speed.final" || key == "speed.speed") return "final rotor speed Omega / sqrt(k/M)";
  if (key == "rotor.eccentricity") return "eccentricity lambda / race radius";
  if (key == "rotor.damping") return "external damping zeta = c / sqrt(k M)";
  if (key == "rotor.stiffness") return "support stiffness kappa";
  if (key == "balancer.mass") return "mass of a ball mu / rotor mass";
  if (key == "balancer.drag") return "drag of a ball beta";
  return key;
}

}  // namespace equipoise
