// The one-line form of an input error, and its parts.
#include "equipoise/core/base/error.hpp"

#include <string_view>

#include "equipoise/core/base/display_text.hpp"

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
  return display_text(line);  // parts of it may come from a file
}

struct Parts {
  std::string_view wrong, allowed;
};

// A problem says what is wrong, then "must be" (or "must have" and so on) and what is allowed. For an unknown key the
// allowed ones come last, in parentheses.
Parts parts_of(std::string_view problem) {
  constexpr std::string_view list = "(allowed: ", be = "must be ", must = "must ";
  if (const std::size_t at = problem.find(list); at != std::string_view::npos && problem.ends_with(')'))
    return {problem.substr(0, at), problem.substr(at + list.size(), problem.size() - at - list.size() - 1)};
  std::size_t at = problem.find(must);
  while (at != std::string_view::npos && at > 0 && problem[at - 1] != ' ' && problem[at - 1] != '(')
    at = problem.find(must, at + 1);
  if (at == std::string_view::npos) return {problem, {}};
  const std::string_view rest = problem.substr(at);
  return {problem.substr(0, at), rest.starts_with(be) ? rest.substr(be.size()) : rest};
}

std::string without_end(std::string_view text) {
  const std::size_t last = text.find_last_not_of(" ;:,(");
  return std::string(last == std::string_view::npos ? std::string_view() : text.substr(0, last + 1));
}

}  // namespace

std::string Place::text() const {
  std::string text = name;
  if (line > 0) text.append(1, ':').append(std::to_string(line));
  if (line > 0 && column > 0) text.append(1, ':').append(std::to_string(column));
  return text;
}

InputError::InputError(Place place, std::string key, std::string value, std::string problem)
    : std::runtime_error(one_line(place.text(), key, value, problem)),
      place_(std::move(place)),
      where_(place_.text()),
      key_(std::move(key)),
      value_(std::move(value)),
      problem_(std::move(problem)) {
  const Parts parts = parts_of(problem_);
  wrong_ = without_end(parts.wrong);
  allowed_ = std::string(parts.allowed);
}

}  // namespace equipoise
