// Whether two studies ask the same, member by member; for the tests of the study reader and its fuzz target.
#pragma once

#include <string>

#include "equipoise/study/study.hpp"

namespace equipoise {

/// The first member that differs by so much as a bit, or empty. Not the name, nor what the profile does not use.
inline std::string first_difference(const Study& a, const Study& b) {
  const model::Parameters &p = a.parameters, &q = b.parameters;
  if (p.balls != q.balls) return "parameters.balls";
  if (p.eccentricity != q.eccentricity) return "parameters.eccentricity";
  if (p.damping != q.damping) return "parameters.damping";
  if (p.stiffness != q.stiffness) return "parameters.stiffness";
  if (p.gravity != q.gravity) return "parameters.gravity";
  if (p.mass != q.mass) return "parameters.mass";
  if (p.drag != q.drag) return "parameters.drag";
  if (p.rolls != q.rolls) return "parameters.rolls";
  if (p.ball_radius != q.ball_radius) return "parameters.ball_radius";
  if (a.speed.profile != b.speed.profile) return "speed.profile";
  if (a.speed.law != b.speed.law) return "speed.law";
  if (a.speed_profile().times != b.speed_profile().times) return "the profile's times";
  if (a.speed_profile().speeds != b.speed_profile().speeds) return "the profile's speeds";
  if (a.release.speed != b.release.speed) return "release.speed";
  if (a.release.time != b.release.time) return "release.time";
  if (a.release_time() != b.release_time()) return "release_time()";
  if (a.initial.psi != b.initial.psi) return "initial.psi";
  if (a.initial.x != b.initial.x) return "initial.x";
  if (a.initial.y != b.initial.y) return "initial.y";
  if (a.initial.x_dot != b.initial.x_dot) return "initial.x_dot";
  if (a.initial.y_dot != b.initial.y_dot) return "initial.y_dot";
  if (a.initial.phi != b.initial.phi) return "initial.phi";
  if (a.initial.phi_dot != b.initial.phi_dot) return "initial.phi_dot";
  if (a.sampling.starts != b.sampling.starts) return "sampling.starts";
  if (a.sampling.seed != b.sampling.seed) return "sampling.seed";
  const SamplingMethod random = SamplingMethod::random;  // what an unset method says in the echo
  if (a.sampling.method.value_or(random) != b.sampling.method.value_or(random)) return "sampling.method";
  for (const auto& [key, side] : box_sides) {
    const auto &s = a.sampling.box.*side, &t = b.sampling.box.*side;
    if (s.has_value() != t.has_value() || (s && (s->low != t->low || s->high != t->high))) return key;
  }
  if (a.numerics.tolerance != b.numerics.tolerance) return "numerics.tolerance";
  if (a.numerics.horizon != b.numerics.horizon) return "numerics.horizon";
  if (a.numerics.decide != b.numerics.decide) return "numerics.decide";
  if (a.limits.displacement != b.limits.displacement) return "limits.displacement";
  if (a.limits.force != b.limits.force) return "limits.force";
  if (a.limits.velocity != b.limits.velocity) return "limits.velocity";
  if (a.limits.settled != b.limits.settled) return "limits.settled";
  if (a.scales.has_value() != b.scales.has_value()) return "scales";
  if (a.scales && a.scales->mass != b.scales->mass) return "scales.mass";
  if (a.scales && a.scales->length != b.scales->length) return "scales.length";
  if (a.scales && a.scales->frequency != b.scales->frequency) return "scales.frequency";
  const auto &of_a = a.uncertain.values, &of_b = b.uncertain.values;
  if (of_a.size() != of_b.size()) return "uncertain";
  for (std::size_t k = 0; k < of_a.size(); ++k)
    if (of_a[k].key != of_b[k].key || of_a[k].kind != of_b[k].kind || of_a[k].numbers != of_b[k].numbers ||
        of_a[k].between != of_b[k].between || of_a[k].unit != of_b[k].unit)
      return "uncertain " + of_a[k].key;
  return "";
}

}  // namespace equipoise
