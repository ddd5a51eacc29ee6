// A study as a tree of plain values, read from TOML, JSON or a language's dictionary.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace equipoise {

/// A boolean, an integer, a real number, a string, an array or a table. A table keeps the order of its members; no two
/// have the same key.
///
///     StudyValue tree{{"rotor", {{"eccentricity", 0.01}, {"damping", 0.5}}}};
///     tree.find("rotor")->set("gravity", 0.001);
class StudyValue {
 public:
  struct Member;
  using Array = std::vector<StudyValue>;
  using Table = std::vector<Member>;
  /// Values that no study holds but messages must show, such as TOML's dates ("a date or time") or JSON's null.
  struct Other {
    std::string kind, text;
  };

  StudyValue();  ///< an empty table
  StudyValue(bool value);
  StudyValue(double value);
  template <std::integral T>
  StudyValue(T value) : StudyValue(whole(value)) {}
  StudyValue(const char* text);
  StudyValue(std::string text);
  StudyValue(Array entries);
  StudyValue(const std::vector<double>& entries);
  StudyValue(Other other);
  StudyValue(std::initializer_list<Member> members);  ///< a table; of equal keys the last one counts
  static StudyValue of_members(Table members);        ///< a table, whose keys must differ

  const bool* boolean() const { return std::get_if<bool>(&value_); }
  const std::int64_t* integer() const { return std::get_if<std::int64_t>(&value_); }
  const double* real() const { return std::get_if<double>(&value_); }
  const std::string* string() const { return std::get_if<std::string>(&value_); }
  const Array* array() const { return std::get_if<Array>(&value_); }
  const Table* table() const { return std::get_if<Table>(&value_); }
  const Other* other() const { return std::get_if<Other>(&value_); }
  bool is_number() const { return integer() || real(); }
  double number() const;  ///< an integer as its nearest double; 0 if this is not a number

  /// A table's member, or an array's entry by its number from 1; null if absent, or if this is neither.
  const StudyValue* find(std::string_view key) const;
  StudyValue* find(std::string_view key);
  /// A nested member by its dotted path, "speed.torque.target", "place.2.mass"; null if absent.
  const StudyValue* find_path(std::string_view dotted) const;
  StudyValue* find_path(std::string_view dotted);
  /// The string there; null if there is none.
  const std::string* find_text(std::string_view dotted) const {
    const StudyValue* value = find_path(dotted);
    return value ? value->string() : nullptr;
  }
  /// Replaces a table's member in place, or appends it, and returns it. Throws std::logic_error if this is no table.
  StudyValue& set(std::string key, StudyValue value);
  void erase(std::string_view key);

  /// Line of the value in its source text, from 1; 0: it has no source text.
  int line() const { return line_; }
  void set_line(int line) { line_ = line; }

 private:
  template <std::integral T>
  static StudyValue whole(T value);

  std::variant<Table, bool, std::int64_t, double, std::string, Array, Other> value_;
  int line_ = 0;
};

struct StudyValue::Member {
  std::string key;
  StudyValue value;
};

// Here a member is complete, as what a constructor must be able to destroy has to be.
inline StudyValue::StudyValue() = default;
inline StudyValue::StudyValue(bool value) : value_(value) {}
inline StudyValue::StudyValue(double value) : value_(value) {}
inline StudyValue::StudyValue(const char* text) : value_(std::string(text)) {}
inline StudyValue::StudyValue(std::string text) : value_(std::move(text)) {}
inline StudyValue::StudyValue(Other other) : value_(std::move(other)) {}
inline StudyValue StudyValue::of_members(Table members) {
  StudyValue result;
  result.value_ = std::move(members);
  return result;
}

template <std::integral T>
StudyValue StudyValue::whole(T value) {
  StudyValue result;
  if (std::cmp_greater(value, std::numeric_limits<std::int64_t>::max()))
    result.value_ = Other{"too large a number", std::to_string(value)};
  else
    result.value_ = static_cast<std::int64_t>(value);
  return result;
}

}  // namespace equipoise
