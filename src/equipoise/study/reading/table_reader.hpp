// Reads values with errors that name file, line, key, value and allowed range, and rejects unknown keys.
// This room: a study file read and checked, and data sheets turned into keys.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "equipoise/core/base/error.hpp"
#include "equipoise/study/contents/uncertain.hpp"
#include "equipoise/study/toml/study_value.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise::study {

/// What a message about a distribution offers.
inline constexpr char distribution_forms[] =
    "{ uniform = [low, high] }, { normal = [mean, standard deviation] }, { loguniform = [low, high] } or { values = "
    "[..] }, each entry equally likely";

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

/// A study's tree with its overrides applied, and the origin of each value.
struct StudyFile {
  StudyValue root;  ///< a table
  std::string name;
  std::set<std::string> overridden;         ///< dotted keys given by --set
  std::map<std::string, StudyValue> taken;  ///< medians of the distributions in `root`, by dotted key
  bool physical = false;  ///< a study in physical units: numbers of keys with a dimension are quantities

  Place where(const std::string& dotted_key, const StudyValue* value) const;
  /// The value at a key, or its distribution, for a message.
  std::string value_text(const std::string& dotted_key, const StudyValue& value) const;
  /// Throws an InputError about the key.
  [[noreturn]] void fail(const std::string& dotted_key, const std::string& problem) const;
};

/// The key that states `key` in this tree: speed.final of a constant speed is its speed.
std::string key_here(const StudyValue& root, const std::string& key);

/// Parses TOML text and applies overrides "dotted.key=value". The value is TOML. Other text that does not begin like an
/// array, table or string counts as a string: --set speed.law=published.
StudyFile parse_study_file(std::string_view text, const std::string& name, const std::vector<std::string>& overrides);
/// The same from a tree.
StudyFile study_file_of(StudyValue tree, const std::string& name, const std::vector<std::string>& overrides);

/// Which of several tables with the same keys a dotted name is: of an array of tables, "place.2", its number from 0; a
/// motor's target, whose keys are those of [speed], is of_target; else 0.
std::size_t entry_of(std::string_view table);
inline constexpr std::size_t of_target = 1;

/// One table of the file. Every read marks its key as known; finish() rejects the others.
class TableReader {
 public:
  /// `prefix`: the table's dotted name; an absent table reads as empty.
  TableReader(const StudyFile& file, std::string prefix);

  bool physical() const { return file_.physical; }
  std::size_t entry() const { return entry_of(prefix_); }
  Dimension measured() const { return measured_; }  ///< what the last quantity measures

  bool has(const std::string& key);
  /// A reader of the table that the key holds; empty if it holds none.
  std::optional<TableReader> inner(const std::string& key);
  double number(const std::string& key, const Wanted& wanted);
  std::int64_t integer(const std::string& key, std::int64_t low, std::int64_t high);
  std::int64_t integer(const std::string& key, std::int64_t low, std::int64_t high, std::int64_t fallback);
  /// A value of an enumeration by its name; `names` are those of its first values, in order.
  template <class Enumeration>
  Enumeration choice(const std::string& key, std::span<const char* const> names,
                     std::optional<Enumeration> fallback = std::nullopt) {
    return fallback && !has(key) ? *fallback : static_cast<Enumeration>(place_among(key, names));
  }
  bool flag(const std::string& key);
  std::string text(const std::string& key);
  std::vector<double> numbers(const std::string& key, const Wanted& wanted);
  /// An array of strings; empty if absent.
  std::vector<std::string> texts(const std::string& key);
  /// `count` numbers from an array of that length, or one number repeated.
  std::vector<double> one_or_each(const std::string& key, const Wanted& wanted, int count, const std::string& each);
  /// The value at a key, which must be there; `wanted`: what it would be.
  const StudyValue& require(const std::string& key, const std::string& wanted);
  /// Throws for the first key that was not read.
  void finish() const;

  /// Throws an InputError about `key`.
  [[noreturn]] void fail(const std::string& key, const std::string& problem) const { file_.fail(dotted(key), problem); }

  /// The same of a text that is none of these names, with the nearest. `wrong`: what to say before that.
  [[noreturn]] void fail_among(const std::string& key, const std::vector<std::string>& names,
                               const std::string& wrong = "");

 private:
  bool has_asked(const std::string& key) const;
  const StudyValue* find(const std::string& key);
  double as_number(const std::string& key, const StudyValue& value, const Wanted& wanted,
                   std::optional<std::size_t> entry = std::nullopt);
  /// The type of a value for a message: "a number", "a string".
  static std::string kind(const StudyValue& value);
  bool states_units() const;
  std::string dotted(const std::string& key) const { return prefix_ + "." + key; }
  std::size_t place_among(const std::string& key, std::span<const char* const> names);

  const std::string prefix_;
  const StudyFile& file_;
  const StudyValue* table_ = nullptr;
  Dimension measured_{};
  std::vector<std::string> known_;
};

/// Whether numbers in the table with this dotted name may be distributions.
bool takes_distributions(const std::string& dotted);

/// Lets the reader take the medians of all distributions in rotor, balancer, speed and release. Tables that name no
/// distribution are left to the reader. Throws InputError for numbers that make none.
std::vector<UncertainValue> take_uncertain(StudyFile& file);

/// "unknown key; did you mean "stiffness"? (allowed: ...)". `table`: dotted name of the table that holds it, or empty;
/// `known`: the keys that the table may hold.
std::string unknown_key(std::string_view table, std::string_view key, const std::vector<std::string>& known);

/// Throws for the first unknown table.
void check_tables(const StudyFile& file);

/// Throws for the first key that no study of this kind and profile has in its table. This runs before reading, so that
/// a misspelt key is not reported as another one that is missing.
void check_keys(const StudyFile& file, bool physical);

}  // namespace equipoise::study
