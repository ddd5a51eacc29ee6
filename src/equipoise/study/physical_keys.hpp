// The keys that hold one quantity (or an array of them) in a physical study and the same quantity over its scale in a
// dimensionless one. [rotor] and [balancer] are read in other ways besides, and the drag of a ball goes with its mass:
// physical.cpp and physical_echo.cpp have that.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "equipoise/study/table_reader.hpp"
#include "equipoise/study/units.hpp"

namespace equipoise::study {

struct QuantityKey {
  const char* key;
  Dimension dimension;
  Range range;
};

struct QuantityTable {
  std::string name;  ///< dotted
  std::vector<QuantityKey> keys;
};

inline std::vector<QuantityTable> quantity_tables() {
  const std::vector<QuantityKey> ramp{
      {"speed", Dimension::speed, any_number},   {"initial", Dimension::speed, any_number},
      {"final", Dimension::speed, any_number},   {"peak", Dimension::speed, any_number},
      {"speeds", Dimension::speed, any_number},  {"duration", Dimension::time, positive},
      {"rise_until", Dimension::time, positive}, {"hold_until", Dimension::time, positive},
      {"fall_until", Dimension::time, positive}, {"times", Dimension::time, not_negative}};
  std::vector<QuantityKey> speed = ramp;
  speed.push_back({"stalled_below", Dimension::speed, any_number});
  const std::vector<QuantityKey> state{
      {"psi", Dimension::angle, any_number},      {"x", Dimension::length, any_number},
      {"y", Dimension::length, any_number},       {"x_dot", Dimension::velocity, any_number},
      {"y_dot", Dimension::velocity, any_number}, {"phi", Dimension::angle, any_number},
      {"phi_dot", Dimension::speed, any_number}};
  return {{"speed", speed},
          {"speed.torque",
           {{"constant", Dimension::torque, any_number},
            {"slope", Dimension::gain, any_number},
            {"until", Dimension::time, not_negative},
            {"stall", Dimension::torque, any_number},
            {"no_load_speed", Dimension::speed, any_number},
            {"times", Dimension::time, not_negative},
            {"values", Dimension::torque, any_number},
            {"gain", Dimension::gain, any_number},
            {"integral", Dimension::torque, any_number},  // torque a second for 1 rad/s
            {"limit", Dimension::torque, not_negative}}},
          {"speed.torque.target", ramp},
          {"release", {{"speed", Dimension::speed, any_number}, {"time", Dimension::time, not_negative}}},
          {"initial", state},
          {"sampling.box", state},
          {"numerics", {{"horizon", Dimension::time, positive}}},
          {"limits",
           {{"displacement", Dimension::length, positive},
            {"force", Dimension::force, positive},
            {"velocity", Dimension::velocity, positive},
            {"settled", Dimension::length, positive}}}};
}

/// A key of [rotor] or [balancer] whose dimensionless value is the quantity over its scale.
struct ScaledKey {
  const char *table, *key;
  Dimension dimension;
};
inline constexpr std::array<ScaledKey, 9> rotor_and_balancer{{
    {"rotor", "stiffness", Dimension::stiffness},
    {"rotor", "damping", Dimension::damping},
    {"rotor", "eccentricity", Dimension::length},
    {"rotor", "gravity", Dimension::acceleration},
    {"rotor", "inertia", Dimension::inertia},
    {"balancer", "mass", Dimension::mass},
    {"balancer", "race_offset", Dimension::length},
    {"balancer", "ball_radius", Dimension::length},
    {"balancer", "contact_angle", Dimension::angle},
}};

/// The table with this dotted name, or null.
inline StudyValue* find_table(StudyValue& root, const std::string& name) {
  StudyValue* table = root.find_path(name);
  return table && table->table() ? table : nullptr;
}

}  // namespace equipoise::study
