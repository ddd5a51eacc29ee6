// The interface to a library of units: UDUNITS-2, or the table of usual units in builds without it.
#pragma once

#include <memory>
#include <string>

namespace equipoise::study {

/// A library of units may have global state and lack thread safety. Hold one of these while using Unit.
class UnitLibraryUse {
 public:
  UnitLibraryUse();
  ~UnitLibraryUse();
  UnitLibraryUse(const UnitLibraryUse&) = delete;
  UnitLibraryUse& operator=(const UnitLibraryUse&) = delete;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

class Unit {
 public:
  /// `text`: a name, or a product as defined by UnitText. Throws RunError if the library cannot be used.
  explicit Unit(const std::string& text);
  ~Unit();
  Unit(const Unit&) = delete;
  Unit& operator=(const Unit&) = delete;

  bool is_known() const { return parts_ != nullptr; }
  /// One of this unit in the other; 0 if that measures something else or is not proportional. Both must be known.
  double worth_in(const Unit& other) const;
  /// Whether the unit contains radians to the first power: speeds of rotation do, frequencies do not.
  bool counts_radians() const;

  /// Name of the library, for messages.
  static const char* reader();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace equipoise::study
