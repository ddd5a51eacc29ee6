// Uncertain values: numbers of a study that every start draws from a distribution.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "equipoise/study/toml/study_value.hpp"

namespace equipoise {

/// uniform: [low, high]. normal: [mean, standard deviation], cut to `between` if that is given. loguniform: [low,
/// high], both greater than 0. values: a list, each entry equally likely.
enum class DistributionKind { uniform, normal, loguniform, values };
inline constexpr std::array<const char*, 4> distribution_names{"uniform", "normal", "loguniform", "values"};

/// A key of rotor, balancer, speed or release with its distribution, in the unit as written.
struct UncertainValue {
  std::string key;  ///< dotted
  DistributionKind kind = DistributionKind::uniform;
  std::vector<double> numbers;
  std::optional<std::array<double, 2>> between;  ///< normal only
  std::string unit;                              ///< of all these numbers, such as "g mm"; empty: plain numbers
  double turn = 0.0;                             ///< of an angle: a whole turn in that unit; else 0

  /// The quantile of a fraction in [0, 1): uniform fractions give draws of the distribution.
  double at(double fraction) const;
  /// The value used where no start is drawn: the median; for an angle without a direction a quarter turn.
  double taken() const;
  /// Whether it is an angle that is drawn all round, so that its middle says nothing: opposite draws nearly cancel.
  bool has_no_direction() const;
  /// The least and the largest value; the study must be valid between them. For a normal distribution without cut, five
  /// standard deviations away: one draw in two million lies beyond.
  std::array<double, 2> ends() const;

  /// The value as a study without units has it: 0.12 for "12 %".
  double plain(double number) const { return unit.empty() ? number : number / 100.0; }
  StudyValue written(double number) const;  ///< a value of the key: a number, or a quantity
  StudyValue written() const;               ///< the distribution: { uniform = [0.005, 0.015] }
  std::string text(double number) const;    ///< "0.012", "300 g mm"
};

/// Everything uncertain in a study; nothing if `values` is empty. The study's own members hold the values taken().
struct Uncertainty {
  std::vector<UncertainValue> values;  ///< by key
  /// For a study in physical units: the whole study as written, which is its echo.
  std::optional<StudyValue> physical;
  std::optional<double> horizon;  ///< stated in `physical`, dimensionless
  bool rests = false;             ///< [initial] states no position: each draw starts at rest under its own weight

  bool empty() const { return values.empty(); }
};

}  // namespace equipoise
