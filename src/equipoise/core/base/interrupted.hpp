// The exception of a wait that a signal ended.
#pragma once

#include <stdexcept>
#include <string>

namespace equipoise {

/// A signal ended the wait for a file, such as a pipe without a reader. Nothing is wrong with the file; what() names
/// it.
class Interrupted : public std::runtime_error {
 public:
  explicit Interrupted(const std::string& path) : std::runtime_error(path + ": stopped while waiting for this file") {}
};

}  // namespace equipoise
