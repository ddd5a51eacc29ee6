// TOML text to trees and back; the only file that uses toml++.
#include "equipoise/study/toml/toml_tree.hpp"

#include <cstdint>
#include <sstream>
#include <utility>

#include <fmt/format.h>

// Malformed text can break some assertions of toml++ (3.3), which reports each as an error right after. A debug build
// with the header-only library must reach those errors too.
#ifndef TOML_ASSERT
#define TOML_ASSERT(condition) static_assert(true)
#endif
#include <toml++/toml.h>

#include "equipoise/study/toml/printable.hpp"
#include "equipoise/study/toml/text_guard.hpp"

namespace equipoise::study {

namespace {

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
                    fmt::format("not TOML: {}", printable(e.description(), longest_description))};
  }
}

std::string value_text(const StudyValue& value) {
  if (const auto* text = value.string()) return in_quotes(*text);
  if (const auto* truth = value.boolean()) return *truth ? "true" : "false";
  if (const auto* whole = value.integer()) return fmt::format("{}", *whole);
  if (const auto* number = value.real()) return number_text(*number);
  if (const auto* other = value.other()) return other->text;
  std::string entries;
  const auto add = [&](const std::string& entry) { entries += (entries.empty() ? "" : ", ") + entry; };
  if (const auto* table = value.table()) {
    for (const auto& [key, member] : *table) add(key_text(key) + " = " + value_text(member));
    return entries.empty() ? "{}" : "{ " + entries + " }";
  }
  if (const auto* array = value.array())
    for (const StudyValue& entry : *array) add(value_text(entry));
  return "[" + entries + "]";
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
