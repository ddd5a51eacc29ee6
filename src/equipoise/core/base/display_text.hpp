// Text fit for any output: names from outside, such as file names; numbers for sentences; the ending of a counted noun.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace equipoise {

/// Valid UTF-8 on one line. Other bytes become U+FFFD. Control characters, and those that begin a line or change the
/// direction of writing, become escapes such as \u001B. What is longer is cut at a whole character and ends in "...".
std::string display_text(std::string_view text, std::size_t longest = std::string_view::npos);
/// The same of what a message quotes.
inline constexpr std::size_t longest_shown = 60;
inline std::string shown_text(std::string_view text) { return display_text(text, longest_shown); }
/// The same, but line ends and tabs stay.
std::string display_lines(std::string_view text);

/// Characters of valid UTF-8: columns on a terminal, for the alphabets and signs used here.
inline std::size_t display_width(std::string_view text) {
  std::size_t count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xc0u) != 0x80u;
  return count;
}

/// Without blanks at either end.
inline std::string_view trimmed(std::string_view text, std::string_view blanks = " ") {
  const std::size_t first = std::min(text.find_first_not_of(blanks), text.size());
  return text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

/// What stands between the separators, one part or more.
inline std::vector<std::string> parts_of(std::string_view text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

/// Bytes of the UTF-8 character that begins at `at`; 0 if none does.
std::size_t character_length(std::string_view text, std::size_t at);

/// `digits` significant digits, but never fewer than stand before the point.
inline std::string plain_number(double value, int digits) {
  return std::fabs(value) < std::pow(10.0, digits) ? fmt::format("{:.{}g}", value, digits)
                                                   : fmt::format("{:.0f}", value);
}

/// "0.15 %", "3.2 %", "47 %"; "more than 99 %" or "less than 0.01 %" where rounding would give all or none.
inline std::string percent_text(double share) {
  const double percent = 100.0 * share;
  if (percent > 99.0 && share < 1.0) return "more than 99 %";
  if (percent < 0.01 && share > 0.0) return "less than 0.01 %";
  return fmt::format("{:.{}f} %", percent, percent >= 10.0 || share <= 0.0 ? 0 : percent >= 1.0 ? 1 : 2);
}

/// "" after one, "s" after any other number: "1 cell", "0 cells".
template <class Number>
constexpr const char* plural(Number count) {
  return count == 1 ? "" : "s";
}

}  // namespace equipoise
