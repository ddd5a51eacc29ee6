// Quantities in the units that engineers use: five digits in text; three on a page, in the machine's units if it has
// them.
#pragma once

#include <optional>
#include <string>

#include "equipoise/report/drawing/svg.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise {

/// A unit as written, and its value in SI units.
struct EngineeringUnit {
  const char* name;
  double si;
};

/// The largest unit in which `si` is at least 1; speeds of rotation in rpm.
EngineeringUnit engineering_unit(double si, study::Dimension dimension);

/// "0.2 mm": five digits, in that unit.
std::string engineering(double si, study::Dimension dimension);
/// The same of a study's own number; without scales its five digits alone.
std::string engineering(const std::optional<model::Scales>& scales, double value, study::Dimension dimension);

/// Three digits; four if there are as many before the point: "0.0331", "3573", "12350".
std::string page_number(double value);

/// A key of a study in words: "final speed", "unbalance", "ball drag", "initial angle of ball 1".
std::string key_words(const std::string& key);
/// A key's value as it was given; a plain number gets its symbol, if there is one: "2.4 ω_c".
std::string value_words(const std::string& key, const std::string& value);

/// The unit in which tables and JSON show a study's numbers.
inline study::ShownUnit unit_of(const Study& study, study::Dimension d) { return study::shown_unit(d, study.scales); }

class PageQuantities {
 public:
  explicit PageQuantities(const Study& study) : scales_(study.scales) {}

  /// "0.2 mm"; in a dimensionless study "0.2 R".
  std::string text(double value, study::Dimension dimension) const;
  /// "0.1 to 0.3 mm"; "0.2 mm" if three digits show no difference.
  std::string range(double low, double high, study::Dimension dimension) const;
  /// "peak displacement, mm", in the unit that suits the largest value.
  AxisWords axis(const std::string& name, double largest, study::Dimension dimension) const;

 private:
  struct Unit {
    std::string name;
    double factor;  // from the dimensionless value
  };
  Unit unit(double value, study::Dimension dimension) const;

  std::optional<model::Scales> scales_;
};

}  // namespace equipoise
