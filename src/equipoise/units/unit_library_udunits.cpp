// Units by UDUNITS-2; the only file that uses it.
#include <array>
#include <cmath>
#include <mutex>
#include <string_view>

#include <udunits2.h>

#include "equipoise/base/error.hpp"
#include "equipoise/units/unit_library.hpp"
#include "equipoise/words/units.hpp"

namespace equipoise::study {

namespace {

using UnitPointer = std::unique_ptr<ut_unit, decltype(&ut_free)>;
using ConverterPointer = std::unique_ptr<cv_converter, decltype(&cv_free)>;

std::mutex& library_mutex() {
  static std::mutex mutex;
  return mutex;
}

ut_system* unit_system() {
  static const std::unique_ptr<ut_system, decltype(&ut_free_system)> system(ut_read_xml(nullptr), &ut_free_system);
  if (!system) throw RunError(words::units::no_udunits_database);
  return system.get();
}

}  // namespace

// UDUNITS prints what it cannot read, which the status and null pointers report as well. Its messages are silenced
// here; the process's own handler and status are restored afterwards.
struct UnitLibraryUse::State {
  const std::lock_guard<std::mutex> lock{library_mutex()};
  const ut_status status = ut_get_status();
  const ut_error_message_handler handler = ut_set_error_message_handler(ut_ignore);
};

UnitLibraryUse::UnitLibraryUse() : state_(std::make_unique<State>()) {}

UnitLibraryUse::~UnitLibraryUse() {
  ut_set_error_message_handler(state_->handler);
  ut_set_status(state_->status);
}

struct Unit::Parts {
  UnitPointer unit;
};

Unit::Unit(const std::string& text) {
  UnitPointer unit{ut_parse(unit_system(), text.c_str(), UT_UTF8), &ut_free};
  if (unit) parts_ = std::make_unique<Parts>(Parts{std::move(unit)});
}

Unit::~Unit() = default;

double Unit::worth_in(const Unit& other) const {
  const ConverterPointer converter(ut_get_converter(parts_->unit.get(), other.parts_->unit.get()), &cv_free);
  if (!converter) return 0.0;
  const double one = cv_convert_double(converter.get(), 1.0);
  // Reciprocal units (s for 1/s), offsets and logarithms also convert, but not proportionally.
  return cv_convert_double(converter.get(), 0.0) != 0.0 || !(one > 0.0) || !std::isfinite(one) ? 0.0 : one;
}

// UDUNITS treats angles as pure numbers. Only a unit's definition, such as "0.104719755 s-1.rad", shows radians.
bool Unit::counts_radians() const {
  std::array<char, 256> text{};
  const int length = ut_format(parts_->unit.get(), text.data(), text.size() - 1, UT_ASCII | UT_DEFINITION);
  if (length < 0 || length >= static_cast<int>(text.size())) return false;
  const std::string_view definition(text.data(), static_cast<std::size_t>(length));
  const std::size_t at = definition.find("rad");
  if (at == std::string_view::npos) return false;
  const std::string_view after = definition.substr(at + 3);
  return after.empty() || after.front() == '.' || after.front() == ' ';
}

const char* Unit::reader() { return "UDUNITS"; }

}  // namespace equipoise::study
