// Compares two studies member by member, for the tests of the study reader and its fuzz target.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Bit-identical, or numbers within a relative difference.
struct SameStudy {
  double within = 0.0;

  template <class T>
  bool operator()(const T& a, const T& b) const {
    if constexpr (std::is_same_v<T, double>)
      return a == b || std::fabs(a - b) <= within * std::fabs(a);
    else if constexpr (requires { a.has_value(); })
      return a.has_value() == b.has_value() && (!a || (*this)(*a, *b));
    else if constexpr (requires { a.low; })
      return (*this)(a.low, b.low) && (*this)(a.high, b.high);
    else if constexpr (requires { a.begin()->key; })
      return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& u, const auto& v) {
        return u.key == v.key && u.kind == v.kind && u.numbers == v.numbers && u.between == v.between &&
               u.unit == v.unit;
      });
    else if constexpr (requires { *a.begin() - *b.begin(); } && !std::is_same_v<T, std::string>)
      return std::equal(a.begin(), a.end(), b.begin(), b.end(), *this);
    else
      return a == b;
  }
};

/// The first member that differs, or empty. Ignores the name, and what the profile does not use.
inline std::string first_difference(const Study& a, const Study& b, double within = 0.0) {
  const SameStudy same{within};
  const SamplingMethod random = SamplingMethod::random;  // what the echo states for an unset method
#define COMPARED(member) \
  if (!same(a.member, b.member)) return #member
  COMPARED(parameters.balls);
  COMPARED(parameters.eccentricity);
  COMPARED(parameters.damping);
  COMPARED(parameters.stiffness);
  COMPARED(parameters.gravity);
  COMPARED(parameters.inertia);
  COMPARED(parameters.mass);
  COMPARED(parameters.drag);
  COMPARED(parameters.race_offset);
  COMPARED(parameters.contact_angle);
  COMPARED(parameters.restitution);
  COMPARED(parameters.rolling);
  COMPARED(parameters.stiction);
  COMPARED(parameters.rolls);
  COMPARED(parameters.ball_radius);
  COMPARED(parameters.eccentricity_angle);
  COMPARED(parameters.tilt.transverse_inertia);
  COMPARED(parameters.tilt.polar_inertia);
  COMPARED(parameters.tilt.misalignment);
  for (const std::size_t k : {0, 1}) {
    COMPARED(parameters.tilt.stiffness[k]);
    COMPARED(parameters.tilt.damping[k]);
  }
  COMPARED(parameters.tilt.plane);
  COMPARED(bearings);
  COMPARED(speed.profile);
  COMPARED(speed.law);
  COMPARED(speed.stalled_below);
  if (a.speed.driven()) {
    COMPARED(motor().constant);
    COMPARED(motor().slope);
    COMPARED(motor().times);
    COMPARED(motor().values);
    COMPARED(motor().speeds);
    COMPARED(motor().load.constant);
    COMPARED(motor().load.linear);
    COMPARED(motor().load.quadratic);
  }
  COMPARED(speed_profile().times);
  COMPARED(speed_profile().speeds);
  COMPARED(release_time());
  COMPARED(release.speed);
  COMPARED(release.time);
  COMPARED(initial.psi);
  COMPARED(initial.x);
  COMPARED(initial.y);
  COMPARED(initial.x_dot);
  COMPARED(initial.y_dot);
  COMPARED(initial.phi);
  COMPARED(initial.phi_dot);
  COMPARED(initial.tilt_x);
  COMPARED(initial.tilt_y);
  COMPARED(initial.tilt_x_dot);
  COMPARED(initial.tilt_y_dot);
  COMPARED(sampling.starts);
  COMPARED(sampling.seed);
  COMPARED(sampling.method.value_or(random));
  for (const auto& [key, side] : box_sides)
    if (!same(a.sampling.box.*side, b.sampling.box.*side)) return key;
  COMPARED(numerics.tolerance);
  COMPARED(numerics.horizon);
  COMPARED(numerics.decide);
  COMPARED(limits.displacement);
  COMPARED(limits.force);
  COMPARED(limits.velocity);
  COMPARED(limits.settled);
  if (a.scales.has_value() != b.scales.has_value()) return "scales";
  if (a.scales) {
    COMPARED(scales->mass);
    COMPARED(scales->length);
    COMPARED(scales->frequency);
  }
  COMPARED(uncertain.values);
#undef COMPARED
  return "";
}

}  // namespace equipoise
