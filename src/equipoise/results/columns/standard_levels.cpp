// From a study's [standards] to levels in its own units.
#include "equipoise/results/columns/transient_figures.hpp"

#include <cmath>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/standards/severity.hpp"

namespace equipoise {

std::optional<double> zone_boundary(const Study& study, int boundary) {
  if (!study.standards.severity_class || !study.scales) return std::nullopt;
  const double turns = std::fabs(study.speed_profile().final_speed()) * study.scales->frequency / two_pi;
  if (turns < standards::lowest_severity_frequency) return std::nullopt;
  const auto& machine = standards::severity_classes[static_cast<std::size_t>(*study.standards.severity_class)];
  const double velocity = 1e-3 * machine.boundaries[static_cast<std::size_t>(boundary)];
  return velocity / study.scales->velocity();
}

std::optional<double> sliding_level(const Study& study) {
  const Standards& s = study.standards;
  if (!s.standing_mass || !s.friction || !study.scales) return std::nullopt;
  const double mass = *s.standing_mass * study.scales->mass, weight = mass * standard_gravity;
  const model::Parameters& p = study.parameters;
  // Without gravity in the plane the force turns in a level plane: it pushes and never lifts.
  if (p.gravity == 0.0) return *s.friction * weight / study.scales->force();
  return standards::sliding_force(mass, *s.friction) / study.scales->force() + (1.0 + p.total_mass()) * p.gravity;
}

}  // namespace equipoise
