// What the library throws, and the word by which a caller asks running work to stop.
#pragma once

#include <atomic>
#include <stdexcept>
#include <string>

namespace equipoise {

/// Unusable input: a study, an option or a file. Thrown before any work starts.
/// what() is one line that names the place (file and line, or option), the key, the value and what is allowed.
class InputError : public std::runtime_error {
 public:
  /// `where`: file (and line) or option; `key`: dotted key, may be empty; `value`: as given, may be empty;
  /// `problem`: what is wrong and what is allowed.
  InputError(std::string where, std::string key, std::string value, std::string problem);

  const std::string& where() const noexcept { return where_; }
  const std::string& key() const noexcept { return key_; }
  const std::string& value() const noexcept { return value_; }
  const std::string& problem() const noexcept { return problem_; }

 private:
  std::string where_, key_, value_, problem_;
};

/// Work that began and could not be finished for a reason outside the input (a full disk, a lost file).
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Set it (from a signal handler, another thread) and running work ends soon, keeping what is done.
using StopFlag = std::atomic<bool>;

}  // namespace equipoise
