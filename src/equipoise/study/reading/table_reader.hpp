// Reads values with errors that name file, line, key, value and allowed range, and rejects unknown keys.
// This room: a study file read and checked, and data sheets turned into keys.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "equipoise/core/base/error.hpp"
#include "equipoise/machine/datasheet/scales.hpp"
#include "equipoise/study/toml/study_value.hpp"

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

/// A study's tree with its overrides applied, and the origin of each value.
struct StudyFile {
  StudyValue root;  ///< a table
  std::string name;
  std::set<std::string> overridden;  ///< dotted keys given by --set
  /// A converted value (physical.hpp), by dotted key: its original text and place.
  struct Written {
    std::string value;
    Place where;
  };
  std::map<std::string, Written> written;
  std::optional<model::Scales> scales;  ///< of a physical study, for messages in its units

  Place where(const std::string& dotted_key, const StudyValue* value) const;
  /// The value as it was written, shortened for a message.
  std::string value_text(const std::string& dotted_key, const StudyValue& value) const;
  /// Throws an InputError about the key.
  [[noreturn]] void fail(const std::string& dotted_key, const std::string& problem) const;
};

/// A dimensionless time or speed in a study's own terms: 3.2, or "0.05 s" and "2400 rpm" in a physical study.
std::string time_text(double time, const std::optional<model::Scales>& scales);
std::string speed_text(double speed, const std::optional<model::Scales>& scales);

/// Parses TOML text and applies overrides "dotted.key=value". The value is TOML. Other text that does not begin like an
/// array, table or string counts as a string: --set speed.law=published.
StudyFile parse_study_file(std::string_view text, const std::string& name, const std::vector<std::string>& overrides);
/// The same from a tree.
StudyFile study_file_of(StudyValue tree, const std::string& name, const std::vector<std::string>& overrides);

/// One table of the file. Every read marks its key as known; finish() rejects the others.
class TableReader {
 public:
  /// `prefix`: the table's dotted name; an absent table reads as empty.
  TableReader(const StudyFile& file, std::string prefix);

  bool has(const std::string& key);
  /// A reader of the table that the key holds; empty if it holds none.
  std::optional<TableReader> inner(const std::string& key);
  double number(const std::string& key, const Range& range);
  std::optional<double> optional_number(const std::string& key, const Range& range);
  std::int64_t integer(const std::string& key, std::int64_t low, std::int64_t high);
  std::int64_t integer(const std::string& key, std::int64_t low, std::int64_t high, std::int64_t fallback);
  /// A value of an enumeration by its name; `names` are those of its first values, in order.
  template <class Enumeration>
  Enumeration choice(const std::string& key, std::span<const char* const> names,
                     std::optional<Enumeration> fallback = std::nullopt) {
    return fallback && !has(key) ? *fallback : static_cast<Enumeration>(place_among(key, names));
  }
  bool flag(const std::string& key, bool fallback);
  std::optional<std::string> text(const std::string& key);
  std::vector<double> numbers(const std::string& key, const Range& range);
  /// An array of strings; empty if absent.
  std::vector<std::string> texts(const std::string& key);
  /// `count` numbers from an array of that length, or one number repeated.
  std::vector<double> one_or_each(const std::string& key, const Range& range, int count, const std::string& each);
  /// Throws for the first key that was not read.
  void finish() const;

  /// Throws an InputError about `key`.
  [[noreturn]] void fail(const std::string& key, const std::string& problem) const { file_.fail(dotted(key), problem); }

  /// The same of a text that is none of these names, with the nearest. `wrong`: what to say before that.
  [[noreturn]] void fail_among(const std::string& key, const std::vector<std::string>& names,
                               const std::string& wrong = "");

  std::string time_text(double time) const { return study::time_text(time, file_.scales); }
  std::string speed_text(double speed) const { return study::speed_text(speed, file_.scales); }

 protected:
  bool has_asked(const std::string& key) const;
  const StudyValue* find(const std::string& key);
  const StudyValue& require(const std::string& key, const std::string& number);
  double as_number(const std::string& key, const StudyValue& value, const Range& range,
                   std::optional<std::size_t> entry = std::nullopt) const;
  std::string dotted(const std::string& key) const { return prefix_ + "." + key; }
  /// The type of a value for a message: "a number", "a string".
  static std::string kind(const StudyValue& value);

  const std::string prefix_;

 private:
  bool states_units() const;
  std::string quantity_wanted(const std::string& key) const;
  std::size_t place_among(const std::string& key, std::span<const char* const> names);

  const StudyFile& file_;
  const StudyValue* table_ = nullptr;
  std::vector<std::string> known_;
};

}  // namespace equipoise::study
