// What a data sheet states of a machine in other terms than the equations have.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "equipoise/machine/model/bearings.hpp"
#include "equipoise/machine/model/parameters.hpp"

namespace equipoise {

/// Of a study in physical units: its quantities as stated, in SI units. What several keys may state, in one way each,
/// is one member: Study::states() says in which.
struct DataSheet {
  // [rotor]
  double mass = 0.0;                   ///< M, kg
  std::array<double, 2> stiffness{};   ///< N/m; or the natural frequency, rad/s; or the static sag, m
  std::array<double, 2> damping{};     ///< N s/m; or the damping ratio, decrement, quality or loss factor
  double unbalance = 0.0;              ///< M times the eccentricity, kg m; or the eccentricity, m
  double grade = 0.0, grade_at = 0.0;  ///< rotor.balance_grade: m/s, at this speed in rad/s
  double inertia = 0.0;                ///< J, kg m^2; or the radius of gyration, m; or GD^2
  bool gd2_of_weight = false;          ///< GD^2 in N m^2

  std::vector<model::Bearing> bearings;
  struct Plane {
    double at = 0.0, size = 0.0, angle = 0.0;  ///< m, kg m, rad
  };
  std::vector<Plane> unbalances;
  struct Place {
    double mass = 0.0, radius = 0.0, angle = 0.0, at = 0.0;
    std::string name;
  };
  std::vector<Place> places;

  // [balancer]; one entry a ball
  using Balls = std::array<double, model::max_balls>;
  double race = 0.0;           ///< radius, or diameter, m
  Balls diameter{};            ///< m
  Balls mass_of_balls{};       ///< kg; or the density, kg/m^3
  std::string material;        ///< whose density it is
  Balls drag{};                ///< torque per rate relative to the race, N m s; or force per velocity, N s/m
  bool drag_of_force = false;  ///< the latter
  double oil_viscosity = 0.0;  ///< dynamic, Pa s; or kinematic, m^2/s
  bool kinematic = false;      ///< the latter
  std::string oil_grade;
  double oil_at = 0.0, oil_viscosity_100 = 0.0;  ///< K; m^2/s
  double oil_density = 0.0, channel = 0.0;       ///< kg/m^3; m
  bool contact = false;

  // [speed]: of the motor, at its own shaft
  double gear_ratio = 1.0, motor_inertia = 0.0;  ///< motor speed over rotor speed; kg m^2
  double power = 0.0, rated_torque = 0.0, rated_speed = 0.0, synchronous_speed = 0.0;
  double breakdown_ratio = 0.0, locked_rotor_ratio = 0.0;
};

}  // namespace equipoise
