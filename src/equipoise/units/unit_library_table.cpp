// Units from the table, for builds without UDUNITS-2.
#include <cmath>

#include "equipoise/units/unit_library.hpp"
#include "equipoise/units/unit_table.hpp"
#include "equipoise/words/units.hpp"

namespace equipoise::study {

struct UnitLibraryUse::State {};  // the table is constant: any number may read it
UnitLibraryUse::UnitLibraryUse() = default;
UnitLibraryUse::~UnitLibraryUse() = default;

struct Unit::Parts {
  TableUnit unit;
};

Unit::Unit(const std::string& text) {
  if (const auto unit = table_unit(text)) parts_ = std::make_unique<Parts>(Parts{*unit});
}

Unit::~Unit() = default;

double Unit::worth_in(const Unit& other) const {
  const TableUnit &a = parts_->unit, &b = other.parts_->unit;
  const double one = a.si / b.si;
  return a.same_kind(b) && one > 0.0 && std::isfinite(one) ? one : 0.0;
}

bool Unit::counts_radians() const { return parts_->unit.radian == 1; }

const char* Unit::reader() { return words::units::table_of_usual_units; }

}  // namespace equipoise::study
