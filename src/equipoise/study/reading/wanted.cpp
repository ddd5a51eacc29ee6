// Ranges and quantities in words, and quantities measured.
#include <cmath>

#include <fmt/format.h>

#include "equipoise/study/reading/table_reader.hpp"

namespace equipoise::study {

bool Range::contains(double v) const {
  return std::isfinite(v) && (low_open ? v > low : v >= low) && (high_open ? v < high : v <= high);
}

std::string Range::text() const {
  const bool has_low = low > -unbounded, has_high = high < unbounded;
  const std::string below = high_open ? fmt::format("less than {}", high) : fmt::format("at most {}", high);
  const std::string above = low_open ? fmt::format("greater than {}", low) : fmt::format("at least {}", low);
  if (has_low && has_high) return fmt::format("a number {} and {}", above, below);
  if (has_low) return "a finite number " + above;
  if (has_high) return "a finite number " + below;
  return "a finite number";
}

std::string Wanted::text() const {
  if (!is_quantity()) return range.text();
  const std::string bound = range.low != 0.0 ? "" : range.low_open ? " greater than 0" : " of 0 or more";
  std::string text;
  for (const Dimension d : dimensions)
    text += fmt::format("{}{}{}, such as \"{}\"", text.empty() ? "" : ", or ", words(d).name, bound, words(d).example);
  return text;
}

Measured measure_value(const StudyValue& value, const Wanted& wanted,
                       const std::function<void(const std::string&)>& reject) {
  if (wanted.dimensions.front() == Dimension::angle && value.is_number()) {  // in radians
    const double angle = value.number();
    if (!wanted.range.contains(angle)) reject("must be " + wanted.text());
    return {angle, Dimension::angle, ""};
  }
  if (!value.string())
    reject(fmt::format("is {} and rotor.mass makes this a study in physical units; must be {}",
                       value.is_number() ? "a plain number" : "no quantity", wanted.text()));
  const Measured result = measure(*value.string(), wanted.dimensions);
  if (!result.problem.empty()) reject(result.problem);
  const auto must_be = [&] { return Wanted(wanted.range, {result.dimension}).text(); };
  if (!wanted.range.contains(result.value)) reject("must be " + must_be());
  const double size = std::abs(result.value);
  if (size > largest_si || (size < smallest_si && (size > 0.0 || wanted.range.low_open)))
    reject(fmt::format("must be {}; its size in SI units must be {} to {}", must_be(), smallest_si, largest_si));
  return result;
}

}  // namespace equipoise::study
