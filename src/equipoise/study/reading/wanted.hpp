// What a number of a study must be: in a range, plain or a quantity with its unit.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "equipoise/study/toml/study_value.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise::study {

/// The allowed range of a number.
struct Range {
  double low, high;
  bool low_open = false, high_open = false;

  bool contains(double v) const;  ///< false for NaN and infinity
  std::string text() const;       ///< "a finite number greater than 0"
};

/// Far beyond any use, yet small enough that the difference of two numbers stays finite.
inline constexpr double unbounded = 1e300;
inline constexpr Range any_number{-unbounded, unbounded};
inline constexpr Range not_negative{0.0, unbounded};
inline constexpr Range positive{0.0, unbounded, true};

/// Every SI value of a machine lies well within these bounds: results computed from them stay finite and nonzero.
inline constexpr double largest_si = 1e30, smallest_si = 1e-30;

/// A plain number, or a quantity of one of these dimensions, whose sign alone is in the range.
struct Wanted {
  Wanted(const Range& of = any_number, std::vector<Dimension> measured = {}) : range(of), dimensions(measured) {}

  bool is_quantity() const { return !dimensions.empty(); }
  std::string text() const;  ///< "a length of 0 or more, such as "0.2 mm"", or as of the range

  Range range;
  std::vector<Dimension> dimensions;
};

/// The SI value of a quantity (a string or an array's entry), checked; `reject` throws. Angles may be plain numbers.
Measured measure_value(const StudyValue& value, const Wanted& wanted,
                       const std::function<void(const std::string&)>& reject);

}  // namespace equipoise::study
