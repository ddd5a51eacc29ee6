// A machine as its data sheet states it: rotor, unbalance in places and balancer in SI units.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/study/ball_details.hpp"
#include "equipoise/study/table_reader.hpp"
#include "equipoise/units/units.hpp"

namespace equipoise::study {

/// A key of a dimensionless table: its values, the physical key behind them, and their dimension, if any.
struct Derived {
  std::string key, from;
  std::vector<double> values;
  std::optional<Dimension> dimension = std::nullopt;
};

struct RotorSheet {
  double mass = 0.0;            ///< M, kg
  double mean_stiffness = 0.0;  ///< k, N/m
  std::vector<Derived> derived;
  /// From the axis along which the rotor's own unbalance lies to the resultant with all places: x of the model.
  double turn = 0.0;
};
/// Reads [rotor] and every [[place]].
RotorSheet read_rotor_sheet(const Document& document);

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
BalancerSheet read_balancer_sheet(const Document& document);

}  // namespace equipoise::study
