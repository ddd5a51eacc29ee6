// Exceptions of the library.
// This room: errors, text, random numbers, the SIMD pack.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "equipoise/core/base/stop_flag.hpp"

namespace equipoise {

/// Where an unusable value stands.
struct Place {
  Place(std::string named) : name(std::move(named)) {}
  Place(const char* named) : name(named) {}
  Place(std::string file, int at_line, int at_column = 0) : name(std::move(file)), line(at_line), column(at_column) {}

  std::string name;          ///< a file, an option, or the name of a study that has neither
  int line = 0, column = 0;  ///< in the file, from 1; 0: unknown
  std::string text() const;  ///< "study.toml:12"
};

/// Unusable input: a study, an option or a file. Thrown before any work starts. what() is one line that names place,
/// key, value and what is allowed.
class InputError : public std::runtime_error {
 public:
  /// `key` (dotted) and `value` may be empty; `problem`: "has 3 entries; must be a number", or only "must be a number".
  InputError(Place place, std::string key, std::string value, std::string problem);

  const Place& place() const noexcept { return place_; }
  const std::string& where() const noexcept { return where_; }  ///< place().text()
  const std::string& key() const noexcept { return key_; }
  const std::string& value() const noexcept { return value_; }
  const std::string& problem() const noexcept { return problem_; }
  /// The problem's two parts: "has 3 entries" and "a number". Either may be empty.
  const std::string& wrong() const noexcept { return wrong_; }
  const std::string& allowed() const noexcept { return allowed_; }

 private:
  Place place_;
  std::string where_, key_, value_, problem_, wrong_, allowed_;
};

/// Work that began and could not finish for a reason outside the input, such as a full disk or a lost file.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace equipoise
