// Uncertain values: a number of a study that every start draws from a distribution.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "equipoise/toml/study_value.hpp"

namespace equipoise {

/// Uniform: [low, high]. Normal: [mean, standard deviation], cut to `between` if that is given. Log-uniform: [low,
/// high], both greater than 0. Values: a list, each entry equally likely.
enum class DistributionKind { uniform, normal, loguniform, values };
inline constexpr std::array<const char*, 4> distribution_names{"uniform", "normal", "loguniform", "values"};

/// A key of rotor, balancer, speed or release with its distribution, in the unit in which it is written.
struct UncertainValue {
  std::string key;  ///< dotted
  DistributionKind kind = DistributionKind::uniform;
  std::vector<double> numbers;
  std::optional<std::array<double, 2>> between;  ///< normal only
  std::string unit;                              ///< of all these numbers, as "g mm"; empty: plain ones

  /// The quantile of a fraction from 0 to below 1: evenly drawn fractions give draws of the distribution.
  double at(double fraction) const;
  /// Stands for the distribution where no start is drawn.
  double median() const;
  /// The least and the largest value, between which a study must hold; of a normal one that is not cut, five standard
  /// deviations away: farther out lies one draw of two million.
  std::array<double, 2> ends() const;

  StudyValue written(double number) const;  ///< a value of the key: a number, or a quantity
  StudyValue written() const;               ///< the distribution: { uniform = [0.005, 0.015] }
  std::string text(double number) const;    ///< "0.012", "300 g mm"
};

/// All that is uncertain in a study; nothing if `values` is empty. The study's own members hold the medians.
struct Uncertainty {
  std::vector<UncertainValue> values;  ///< by key
  /// Of a study in physical units: all that it says, as it was written, since what a quantity changes (a ball's mass
  /// its drag over its mass) is known there alone.
  std::optional<StudyValue> physical;
  std::optional<double> horizon;  ///< that `physical` states, dimensionless
  bool rests = false;             ///< [initial] states no place: each draw rests under its own weight at first

  bool empty() const { return values.empty(); }
};

}  // namespace equipoise
