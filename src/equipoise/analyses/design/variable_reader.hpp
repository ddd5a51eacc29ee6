// Reads [design.vary] and [design.require].
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "equipoise/results/commands/design_result.hpp"
#include "equipoise/study/reading/table_reader.hpp"

namespace equipoise {

/// A number or a quantity as written.
struct WrittenNumber {
  double value = 0.0;
  std::string unit;  ///< empty: a plain number
};

/// One entry of a table of the design, with errors that name it.
class DesignEntry {
 public:
  DesignEntry(const study::StudyFile& file, std::string table, std::string key, const StudyValue& value)
      : file_(file), table_(std::move(table)), key_(std::move(key)), value_(value) {}

  const std::string& key() const { return key_; }
  const StudyValue& value() const { return value_; }
  [[noreturn]] void fail(const std::string& problem) const;
  /// For a table: fails for a member that is none of these.
  void allow_only(std::initializer_list<std::string_view> members) const;
  /// A value of the study itself; null if it states none.
  const StudyValue* stated(std::string_view path) const { return file_.root.find_path(path); }
  std::optional<WrittenNumber> number(const StudyValue& written) const;
  /// For a table: the member, which must be a number of this kind.
  WrittenNumber need(std::string_view member, const char* wanted) const;
  /// Two numbers of one unit, the first below the second.
  std::array<WrittenNumber, 2> range(const StudyValue& written) const;

 private:
  const study::StudyFile& file_;
  std::string table_, key_;
  const StudyValue& value_;
};

/// `study`: the study to vary; a spin-up begins and ends at its speeds.
DesignVariable read_variable(const DesignEntry& entry, const Study& study);

}  // namespace equipoise
