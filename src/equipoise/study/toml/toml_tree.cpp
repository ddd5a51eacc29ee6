// TOML text to trees and back; the only file that uses toml++.
#include "equipoise/study/toml/toml_tree.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <sstream>
#include <utility>

#include <fmt/format.h>

// Malformed text can break some assertions of toml++ (3.3), which reports each as an error right after. A debug build
// with the header-only library must also reach those errors.
#ifndef TOML_ASSERT
#define TOML_ASSERT(condition) static_assert(true)
#endif
#include <toml++/toml.h>

#include "equipoise/core/base/display_text.hpp"

namespace equipoise::study {

namespace {

// Rejects text that toml++ 3.3 meets with undefined behaviour or an exhausted stack instead of an error
// (github.com/marzer/tomlplusplus, issues 190 and 295). Follows only TOML's strings and comments. Up to
// the parser's first error both see the text alike.
class TextGuard {
 public:
  explicit TextGuard(std::string_view text) : text_(text) {}

  // Empty if the text is safe to parse.
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

StudyValue tree_of(const toml::node& node);

StudyValue bare_tree_of(const toml::node& node) {
  if (const auto* table = node.as_table()) {
    StudyValue::Table members;
    for (const auto& [key, entry] : *table) members.push_back({std::string(key.str()), tree_of(entry)});
    return StudyValue::of_members(std::move(members));
  }
  if (const auto* array = node.as_array()) {
    StudyValue::Array entries;
    for (const toml::node& entry : *array) entries.push_back(tree_of(entry));
    return entries;
  }
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* truth = node.as_boolean()) return truth->get();
  if (const auto* whole = node.as_integer()) return whole->get();
  if (const auto* number = node.as_floating_point()) return number->get();
  std::ostringstream date;
  node.visit([&](const auto& n) { date << n; });
  return StudyValue::Other{"a date or time", date.str()};
}

StudyValue tree_of(const toml::node& node) {
  StudyValue result = bare_tree_of(node);
  result.set_line(static_cast<int>(node.source().begin.line));
  return result;
}

// A TOML string in ASCII, as the reader requires; other characters become escaped code points.
std::string in_quotes(std::string_view text) {
  std::string result = "\"";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte >= 0x20 && byte < 0x7f) {
      if (byte == '"' || byte == '\\') result += '\\';
      result += text[i];
      continue;
    }
    const int more = byte < 0xc0 ? 0 : byte < 0xe0 ? 1 : byte < 0xf0 ? 2 : 3;
    std::uint32_t point = more == 0 ? byte : byte & (0x3fu >> more);
    for (int k = 0; k < more && i + 1 < text.size(); ++k) point = point << 6 | (text[++i] & 0x3f);
    result += fmt::format("\\U{:08X}", point);
  }
  return result + '"';
}

// "balancer.drag" as one key, of [design.vary], has quotes.
std::string key_text(const std::string& key) {
  constexpr std::string_view bare = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  return key.empty() || key.find_first_not_of(bare) != std::string::npos ? in_quotes(key) : key;
}

void append_named(std::string& text, const std::string& name, const StudyValue::Table& members);

// A table's own keys, then its tables, separated by a blank line. `head`: its name in brackets.
void append_table(std::string& text, const std::string& head, const std::string& name,
                  const StudyValue::Table& members) {
  text += fmt::format("{}{}\n", text.empty() ? "" : "\n", head);
  for (const auto& [key, value] : members)
    if (!value.table()) text += fmt::format("{} = {}\n", key_text(key), value_text(value));
  for (const auto& [key, value] : members)
    if (const auto* inner = value.table()) append_named(text, fmt::format("{}.{}", name, key_text(key)), *inner);
}

void append_named(std::string& text, const std::string& name, const StudyValue::Table& members) {
  append_table(text, fmt::format("[{}]", name), name, members);
}

}  // namespace

StudyValue parse_toml(std::string_view text) {
  if (const auto fault = TextGuard(text).first_fault()) throw *fault;
  try {
    return tree_of(toml::parse(text));
  } catch (const toml::parse_error& e) {
    constexpr std::size_t longest_description = 300;  // it may quote the text
    throw TextFault{e.source().begin.line, e.source().begin.column,
                    fmt::format("not TOML: {}", display_text(e.description(), longest_description))};
  }
}

namespace {
// `quoted`: how a string is written.
std::string text_of(const StudyValue& value, std::string (*quoted)(std::string_view)) {
  if (const auto* text = value.string()) return quoted(*text);
  if (const auto* truth = value.boolean()) return *truth ? "true" : "false";
  if (const auto* whole = value.integer()) return fmt::format("{}", *whole);
  if (const auto* number = value.real()) return number_text(*number);
  if (const auto* other = value.other()) return other->text;
  std::string entries;
  const auto add = [&](const std::string& entry) { entries += (entries.empty() ? "" : ", ") + entry; };
  if (const auto* table = value.table()) {
    for (const auto& [key, member] : *table) add(key_text(key) + " = " + text_of(member, quoted));
    return entries.empty() ? "{}" : "{ " + entries + " }";
  }
  if (const auto* array = value.array())
    for (const StudyValue& entry : *array) add(text_of(entry, quoted));
  return "[" + entries + "]";
}
}  // namespace

std::string value_text(const StudyValue& value) { return text_of(value, in_quotes); }

std::string shown(const StudyValue& value) {
  return shown_text(text_of(value, [](std::string_view text) { return fmt::format("\"{}\"", text); }));
}

std::string number_text(double v) {
  std::string text = fmt::format("{}", v);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string toml_text(const StudyValue& tables) {
  std::string text;
  const auto* members = tables.table();
  if (!members) return text;
  for (const auto& [name, value] : *members) {
    if (const auto* table = value.table()) append_named(text, name, *table);
    if (!value.array()) continue;
    for (const StudyValue& entry : *value.array())  // an array of tables
      if (entry.table()) append_table(text, fmt::format("[[{}]]", name), name, *entry.table());
  }
  return text;
}

}  // namespace equipoise::study
