// What TOML text must not hold when it reaches the parser: the few faults that toml++ meets with undefined behaviour, a
// failed assertion or an exhausted stack instead of an error (3.3; github.com/marzer/tomlplusplus issues 190 and 295).
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace equipoise::study {

/// Why text cannot be read, and where; line and column count from 1.
struct TextFault {
  std::size_t line, column;
  std::string problem;
};

/// A study needs four parts at most; the parser and its trees recurse once a part, on a stack that ends.
inline constexpr int most_key_parts = 16;

/// Walks over text by TOML's strings, comments and brackets, and nothing else of its grammar. Up to the first fault that
/// the parser itself would report, both see the text alike.
class TextGuard {
 public:
  explicit TextGuard(std::string_view text) : text_(text) {}

  std::optional<TextFault> first_fault() {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // a byte order mark
    for (; at_ < text_.size() && !fault_; ++at_) step(text_[at_]);
    return fault_;
  }

 private:
  void step(char c) {
    if (static_cast<unsigned char>(c) >= 0x80) return fail("not TOML: a character that is not ASCII, outside of quotes");
    switch (c) {
      case '#': at_ = std::min(text_.find('\n', at_), text_.size()) - 1; break;
      case '"':
      case '\'': skip_string(c); break;
      case '.':
        if (++parts_ > most_key_parts) fail("a key has more than 16 parts; no key of a study does");
        break;
      case '\n':
        if (depth_ == 0) in_value_ = false;
        parts_ = 1;
        break;
      case '=':
        in_value_ = true;
        parts_ = 1;
        break;
      case '[':
        if (in_value_) ++depth_;
        else check_header();
        parts_ = 1;
        break;
      case '{': ++depth_; parts_ = 1; break;
      case ']':
      case '}': depth_ = std::max(depth_ - 1, 0); parts_ = 1; break;
      case ',': parts_ = 1; break;
      default: break;
    }
  }

  // Leaves at_ on the last character of the string.
  void skip_string(char quote) {
    const bool many_lines = text_.substr(at_, 3) == std::string(3, quote);
    const std::string_view end = text_.substr(at_, many_lines ? 3 : 1);
    for (at_ += end.size(); at_ < text_.size() && text_.substr(at_, end.size()) != end; ++at_) {
      if (!many_lines && text_[at_] == '\n') break;
      if (many_lines && static_cast<unsigned char>(text_[at_]) >= 0x80)
        return fail("a character that is not ASCII, in a string of many lines; no string of a study has them");
      if (quote == '"' && text_[at_] == '\\') ++at_;
    }
    const bool closed = text_.substr(at_, end.size()) == end;
    at_ = closed ? at_ + end.size() - 1 : at_ - 1;
  }

  // A table's name begins after "[" or "[[" and blanks.
  void check_header() {
    std::size_t begin = std::min(text_.find_first_not_of(" \t", at_ + 1), text_.size());
    if (begin == at_ + 1 && begin < text_.size() && text_[begin] == '[')
      begin = std::min(text_.find_first_not_of(" \t", begin + 1), text_.size());
    if (begin == text_.size() || text_[begin] == '[') return;  // the parser has errors for these
    constexpr std::string_view may_begin =
        "]\"'-_0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
    if (may_begin.find(text_[begin]) != std::string_view::npos) {
      at_ = begin - 1;
    } else {
      at_ = begin;
      fail("not TOML: a table's name must follow its bracket");
    }
  }

  void fail(const char* problem) {
    const std::string_view before = text_.substr(0, at_);
    const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 = 0
    fault_ = TextFault{1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')),
                       1 + at_ - line_begin, problem};
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int parts_ = 1;   // of the key here, if it is one
  int depth_ = 0;   // of brackets within a value
  bool in_value_ = false;
  std::optional<TextFault> fault_;
};

}  // namespace equipoise::study
