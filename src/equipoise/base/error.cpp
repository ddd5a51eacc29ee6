// The one-line form of an input error.
#include "equipoise/base/error.hpp"

#include <utility>

namespace equipoise {

namespace {
std::string one_line(const std::string& where, const std::string& key, const std::string& value,
                     const std::string& problem) {
  std::string line = where;
  if (!key.empty()) line += ": " + key;
  if (!value.empty()) line += " = " + value;
  line += ": " + problem;
  for (char& c : line)
    if (c == '\n' || c == '\r') c = ' ';
  return line;
}
}  // namespace

InputError::InputError(std::string where, std::string key, std::string value, std::string problem)
    : std::runtime_error(one_line(where, key, value, problem)),
      where_(std::move(where)),
      key_(std::move(key)),
      value_(std::move(value)),
      problem_(std::move(problem)) {}

}  // namespace equipoise
