// A machine as its data sheet states it: rotor, unbalance in places and balancer in SI units.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/reading/table_reader.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise::study {

/// A key of a dimensionless table: its values, the physical key behind them, and their dimension, if any.
struct Derived {
  std::string key, from;
  std::vector<double> values;
  std::optional<Dimension> dimension = std::nullopt;
  bool is_list = false;  ///< an array even of one value
};

/// What [rotor.tilt] gets beside numbers: {k12, k22} and {c12, c22} of the supports in X and Y, N and N m, N s and N m
/// s.
struct TiltSupports {
  std::array<std::array<double, 2>, 2> stiffness{}, damping{};
  std::string stiffness_from, damping_from;
};

struct RotorSheet {
  double mass = 0.0;            ///< M, kg
  double mean_stiffness = 0.0;  ///< k, N/m
  std::vector<Derived> derived;
  std::vector<Derived> tilt;             ///< of [rotor.tilt]
  std::optional<TiltSupports> supports;  ///< of a rotor that tilts
  /// From the axis along which the rotor's own unbalance lies to the resultant with all places: x of the model. Of a
  /// rotor that tilts: from its angle 0 to the resultant couple unbalance.
  double turn = 0.0;
};
/// Reads [rotor], [rotor.tilt] and every [[place]].
RotorSheet read_rotor_sheet(const StudyFile& file);

struct BalancerSheet {
  int balls = 0;
  double radius = 0.0;              ///< R, m
  std::vector<double> mass;         ///< kg
  std::vector<double> drag_torque;  ///< drag torque per rate relative to the race, N m s
  std::map<std::string, std::vector<double>> others;
  bool rolls = false;
  std::vector<double> radius_of_balls;  ///< m, if they roll
  BallDetails details;
  std::optional<double> contact_angle;
  std::string mass_from, drag_from, rolls_from, contact_from;
};
BalancerSheet read_balancer_sheet(const StudyFile& file);

}  // namespace equipoise::study
