// Rejects text that toml++ 3.3 meets with undefined behaviour or an exhausted stack instead of an error
// (github.com/marzer/tomlplusplus, issues 190 and 295).
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace equipoise::study {

/// Why a text cannot be read, and where; line and column (in bytes) count from 1.
struct TextFault {
  std::size_t line, column;
  std::string problem;
};

/// A study needs at most four parts. The parser and its trees recurse once per part on a limited stack.
inline constexpr int most_key_parts = 16;

/// Follows only TOML's strings and comments. Up to the parser's first error both see the text alike.
class TextGuard {
 public:
  explicit TextGuard(std::string_view text) : text_(text) {}

  /// Empty if the text is safe to parse.
  std::optional<TextFault> first_fault() {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text_.starts_with(byte_order_mark)) text_.remove_prefix(byte_order_mark.size());
    for (; at_ < text_.size() && !fault_; ++at_) {
      const char c = text_[at_];
      if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size()) - 1;
      } else if (c == '"' || c == '\'') {
        skip_string(c);
      } else if (c == '.') {
        if (++key_parts_ > most_key_parts)
          fail(fmt::format("a key has more than {} parts; no key of a study does", most_key_parts));
      } else if (std::string_view(",=\n[]{}").find(c) != std::string_view::npos) {
        key_parts_ = 1;
      } else {
        check_ascii();
      }
    }
    return fault_;
  }

 private:
  void check_ascii() {
    if (at_ < text_.size() && static_cast<unsigned char>(text_[at_]) >= 0x80)
      fail("a character that is not ASCII, outside of comments and values in quotes; no study needs one");
  }

  // A quote elsewhere does not begin a string for the parser.
  bool begins_value() const {
    const std::size_t before = text_.substr(0, at_).find_last_not_of(" \t");
    return before != std::string_view::npos && std::string_view("=,[").find(text_[before]) != std::string_view::npos;
  }

  // Leaves at_ on the last character of the string, or before the line end that cuts it off.
  void skip_string(char quote) {
    const bool many_lines = text_.substr(at_).starts_with(std::string(3, quote));
    const std::string_view end = text_.substr(at_, many_lines ? 3 : 1);
    const bool may_hold_units = !many_lines && begins_value();  // "20 µm"
    for (at_ += end.size(); at_ < text_.size() && !fault_; ++at_) {
      if (text_.substr(at_).starts_with(end)) {
        at_ += end.size() - 1;
        return;
      }
      if (!many_lines && text_[at_] == '\n') {
        --at_;
        return;
      }
      if (!may_hold_units) check_ascii();
      if (quote != '"' || text_[at_] != '\\') continue;
      ++at_;
      check_ascii();
    }
  }

  void fail(const std::string& problem) {
    const std::string_view before = text_.substr(0, at_);
    const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 = 0
    fault_ = TextFault{1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')),
                       1 + at_ - line_begin, problem};
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int key_parts_ = 1;  // of the key here, if it is one
  std::optional<TextFault> fault_;
};

}  // namespace equipoise::study
