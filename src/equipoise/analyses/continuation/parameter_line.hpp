// A parameter of a study and the values it takes, as in --along.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/machine/model/system.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

inline constexpr std::size_t most_line_values = 2000;

/// The number of `start` that a key names: initial.phi_1 to initial.phi_n, initial.phi_dot_1 and so on, initial.x, y,
/// x_dot, y_dot, psi. Null for other keys.
double* initial_value(InitialState& start, int balls, const std::string& key);

/// `study` at its medians, with another value of a number, as --set would give it. Also takes speed.final, the final
/// speed whatever the profile, and keys of one ball's initial angle or rate (initial_value()). Throws InputError if the
/// result is invalid.
Study study_with(const Study& study, const std::string& key, double value);

class ParameterLine {
 public:
  /// `text`: KEY=FROM:TO:STEP. KEY is a key of rotor, balancer or speed that takes a number, or speed.final, the final
  /// speed whatever the profile. FROM, TO and STEP are dimensionless numbers, or quantities ("900 rpm") if the study
  /// has scales. Throws InputError for anything else, and if the study cannot be decided at one of the values; `where`
  /// names the text in errors.
  ParameterLine(const Study& study, const std::string& text, const std::string& where = "parameter");

  const std::string& key() const { return key_; }
  /// Rising, whichever way FROM and TO were given, rounded to twelve digits.
  const std::vector<double>& values() const { return values_; }
  double step() const { return step_; }
  /// Half-way to the next value; empty if there is none, or if the study cannot be decided there.
  std::optional<double> half_way(std::size_t value) const;

  Study study_at(double value) const;
  model::System system_at(double value) const;

 private:
  void parse(const std::string& text, const std::string& where);
  void check_at(double value, const std::string& where) const;

  Study study_;
  std::string key_;
  std::vector<double> values_;
  double step_ = 0.0;
};

}  // namespace equipoise
