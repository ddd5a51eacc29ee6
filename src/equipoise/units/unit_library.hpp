// Whoever reads units: UDUNITS-2, or where a build has none of it the table of usual units.
#pragma once

#include <memory>
#include <string>

namespace equipoise::study {

/// A library of units may keep its state for the whole process and not be made for threads: whoever has to do with Unit
/// holds one of these meanwhile.
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
  /// `text`: a name, or a product as UnitText has it. Throws RunError if the library cannot be used.
  explicit Unit(const std::string& text);
  ~Unit();
  Unit(const Unit&) = delete;
  Unit& operator=(const Unit&) = delete;

  bool is_known() const { return parts_ != nullptr; }
  /// What one is worth in the other; 0 if that measures something else, or is not in proportion. Both are known.
  double worth_in(const Unit& other) const;
  /// Whether it counts radians, to the first power: speeds of rotation do, frequencies do not.
  bool counts_radians() const;

  /// Who reads them, for messages.
  static const char* reader();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace equipoise::study
