// The study reader's machinery: overrides, ranges, unknown keys.
#include "equipoise/study/table_reader.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/base/angles.hpp"
#include "equipoise/study/text_guard.hpp"

namespace equipoise::study {

namespace {

constexpr std::size_t longest_shown = 60;
// A misspelling is this close to what was meant.
constexpr std::size_t nearest_distance = 2;

// Text from outside as part of a one-line message: control characters escaped, cut at a whole UTF-8 character.
std::string printable(std::string_view text, std::size_t longest = longest_shown) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool continues_character = (byte & 0xC0) == 0x80;
    if (result.size() >= longest && !continues_character) return result + "...";
    if (byte < 0x20 || byte == 0x7F)
      result += fmt::format("\\u{:04X}", byte);
    else
      result += c;
  }
  return result;
}

// A value much as it was written, on one line; no longer than `longest_shown` by more than its last part.
void append_shown(std::string& text, const toml::node& node) {
  if (text.size() > longest_shown) return;
  const char* separator = "";
  if (const auto* array = node.as_array()) {
    text += '[';
    for (const toml::node& entry : *array) {
      if (text.size() > longest_shown) break;
      text += std::exchange(separator, ", ");
      append_shown(text, entry);
    }
    text += ']';
  } else if (const auto* table = node.as_table()) {
    text += "{ ";
    for (const auto& [key, entry] : *table) {
      if (text.size() > longest_shown) break;
      text += fmt::format("{}{} = ", std::exchange(separator, ", "), key.str());
      append_shown(text, entry);
    }
    text += " }";
  } else if (const auto* string = node.as_string()) {
    text += fmt::format("\"{}\"", string->get());
  } else if (const auto* number = node.as_floating_point()) {
    text += number_text(number->get());
  } else {
    std::ostringstream other;
    node.visit([&](const auto& n) { other << n; });
    text += other.str();
  }
}

std::string shown(const toml::node& node) {
  std::string text;
  append_shown(text, node);
  return printable(text);
}

// "12 kg", where a plain number was wanted.
bool looks_physical(const toml::node& node) {
  const auto* text = node.as_string();
  return text && !text->get().empty() &&
         std::string_view("+-.0123456789").find(text->get().front()) != std::string::npos;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

bool nearly_same(std::string_view a, std::string_view b) {
  return a.size() <= longest_shown && b.size() <= longest_shown && edit_distance(a, b) <= nearest_distance;
}

std::string unknown_key(std::string_view key, const std::vector<std::string>& known) {
  std::string text = "unknown key";
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return edit_distance(key.substr(0, longest_shown), a) < edit_distance(key.substr(0, longest_shown), b);
  });
  if (nearest != known.end() && nearly_same(key, *nearest)) text += fmt::format("; did you mean \"{}\"?", *nearest);
  return text + fmt::format(" (allowed: {})", fmt::join(known, ", "));
}

// Throws TextFault for what is not TOML.
toml::table parse_toml(std::string_view text, const std::string& name) {
  if (const auto fault = TextGuard(text).first_fault()) throw *fault;
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& e) {
    constexpr std::size_t longest_description = 300;  // it may quote the text
    throw TextFault{e.source().begin.line, e.source().begin.column,
                    fmt::format("not TOML: {}", printable(e.description(), longest_description))};
  }
}

std::string trimmed(const std::string& text) {
  constexpr std::string_view blank = " \t";
  const std::size_t first = text.find_first_not_of(blank);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

// The value of an override: TOML, or a bare word or a quantity ("published", "12 kg") as a string.
toml::table parse_value(const std::string& key, const std::string& value) {
  toml::table parsed;
  try {
    parsed = parse_toml("value = " + value, "--set");
  } catch (const TextFault& fault) {
    if (std::string_view("[{\"'").find(value.front()) != std::string_view::npos)
      throw InputError("--set", printable(key), printable(value), fault.problem);
    parsed = toml::table{{"value", value}};
  }
  if (parsed.size() != 1) throw InputError("--set", printable(key), printable(value), "must be a single TOML value");
  return parsed;
}

void apply_override(Document& document, const std::string& text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  const std::string key = trimmed(text.substr(0, equals));
  const std::string value = equals == text.size() ? "" : trimmed(text.substr(equals + 1));
  const bool has_empty_part = key.empty() || key.front() == '.' || key.back() == '.' || key.find("..") != key.npos;
  if (has_empty_part || value.empty())
    throw InputError("--set " + printable(text), "", "", "must be key=value, for example rotor.eccentricity=0.02");
  if (std::count(key.begin(), key.end(), '.') >= most_key_parts)
    throw InputError("--set", printable(key), printable(value), "unknown key: more parts than any key of a study has");

  const toml::table parsed = parse_value(key, value);
  toml::table* table = &document.root;
  std::size_t begin = 0;
  for (std::size_t dot; (dot = key.find('.', begin)) != std::string::npos; begin = dot + 1) {
    const std::string part = key.substr(begin, dot - begin);
    toml::node* node = table->get(part);
    if (!node) node = &table->insert(part, toml::table{}).first->second;
    table = node->as_table();
    if (!table)
      throw InputError("--set", printable(key), printable(value),
                       fmt::format("\"{}\" is not a table", printable(key.substr(0, dot))));
  }
  parsed.get("value")->visit([&](const auto& node) { table->insert_or_assign(key.substr(begin), node); });
  document.overridden.insert(key);
}

}  // namespace

std::string number_text(double v) {
  std::string text = fmt::format("{}", v);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

bool Range::contains(double v) const {
  return std::isfinite(v) && (low_open ? v > low : v >= low) && (high_open ? v < high : v <= high);
}

std::string Range::text() const {
  const bool has_low = low > -unbounded, has_high = high < unbounded;
  const std::string below = high_open ? fmt::format("less than {}", high) : fmt::format("at most {}", high);
  const std::string above = low_open ? fmt::format("greater than {}", low) : fmt::format("at least {}", low);
  if (has_low && has_high) return fmt::format("a number {} and {}", above, below);
  if (has_low) return "a finite number " + above;
  if (has_high) return "a finite number " + below;
  return "a finite number";
}

std::string Document::value_text(const std::string& dotted_key, const toml::node& node) const {
  const auto found = written.find(dotted_key);
  return found == written.end() ? shown(node) : found->second.value;
}

std::string Document::where(const std::string& dotted_key, const toml::node* node) const {
  if (const auto found = written.find(dotted_key); found != written.end()) return found->second.where;
  for (std::size_t dot = 0; dot != std::string::npos;) {
    dot = dotted_key.find('.', dot + 1);
    if (overridden.count(dotted_key.substr(0, dot))) return "--set";
  }
  if (!node) return name;
  const auto line = node->source().begin.line;
  if (line == 0) return overridden.empty() ? name : "--set";  // a table that an override made comes from no line
  return fmt::format("{}:{}", name, line);
}

Document parse_document(std::string_view text, const std::string& name, const std::vector<std::string>& overrides) {
  Document document;
  document.name = name;
  try {
    document.root = parse_toml(text, name);
  } catch (const TextFault& fault) {
    throw InputError(fmt::format("{}:{}:{}", name, fault.line, fault.column), "", "", fault.problem);
  }
  for (const std::string& item : overrides) apply_override(document, item);
  return document;
}

TableReader::TableReader(const Document& document, std::string prefix)
    : document_(document), prefix_(std::move(prefix)) {
  const toml::node* node = document.root.get(prefix_.substr(0, prefix_.find('.')));
  for (std::size_t dot = prefix_.find('.'); node && dot != std::string::npos;) {
    const std::size_t begin = dot + 1;
    dot = prefix_.find('.', begin);
    node = node->as_table() ? node->as_table()->get(prefix_.substr(begin, dot - begin)) : nullptr;
  }
  if (!node) return;
  table_ = node->as_table();
  if (!table_)
    throw InputError(document.where(prefix_, node), prefix_, shown(*node),
                     fmt::format("must be a table, [{}]", prefix_));
}

std::string TableReader::dotted(const std::string& key) const { return prefix_ + "." + key; }

const toml::node* TableReader::find(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  return table_ ? table_->get(key) : nullptr;
}

bool TableReader::has(const std::string& key) { return find(key) != nullptr; }

const toml::node& TableReader::require(const std::string& key, const std::string& wanted) {
  if (const toml::node* node = find(key)) return *node;
  std::string hint;
  if (table_)
    for (const auto& [other, node] : *table_)
      if (nearly_same(key, other.str())) hint = fmt::format(" (is \"{}\" meant for it?)", printable(other.str()));
  throw InputError(document_.where(dotted(key), nullptr), dotted(key), "",
                   fmt::format("missing{}; must be {}", hint, wanted));
}

void TableReader::fail(const std::string& key, const std::string& problem) const {
  const toml::node* node = table_ ? table_->get(key) : nullptr;
  throw InputError(document_.where(dotted(key), node), dotted(key),
                   node ? document_.value_text(dotted(key), *node) : "", problem);
}

std::string TableReader::time_text(double time) const {
  return document_.scales ? fmt::format("{:.6g} s", time * document_.scales->time()) : fmt::format("{}", time);
}

std::string TableReader::speed_text(double speed) const {
  constexpr double rpm = pi / 30.0;
  return document_.scales ? fmt::format("{:.6g} rpm", speed * document_.scales->frequency / rpm)
                          : fmt::format("{}", speed);
}

std::string TableReader::kind(const toml::node& node) {
  if (node.is_string()) return "a string";
  if (node.is_table()) return "a table";
  if (node.is_array()) return "an array";
  if (node.is_boolean()) return "a boolean";
  if (node.is_integer() || node.is_floating_point()) return "a number";
  return "a date or time";
}

double TableReader::as_number(const std::string& key, const toml::node& node, const Range& range,
                              std::optional<std::size_t> entry) const {
  const std::string which = entry ? fmt::format("entry {} ", *entry + 1) : "";
  const auto reject = [&](const std::string& problem) {
    throw InputError(document_.where(dotted(key), &node), dotted(key), document_.value_text(dotted(key), node),
                     which + problem);
  };
  if (!node.is_number())
    reject(fmt::format("is {}; must be {}{}", kind(node), range.text(),
                       looks_physical(node) ? " (a study in physical units states rotor.mass)" : ""));
  const double value =
      node.is_integer() ? static_cast<double>(node.as_integer()->get()) : node.as_floating_point()->get();
  if (!range.contains(value)) {
    const bool too_large = std::isfinite(value) && std::abs(value) > unbounded;
    reject("must be " + range.text() + (too_large ? fmt::format(", at most {} in size", unbounded) : ""));
  }
  return value;
}

double TableReader::number(const std::string& key, const Range& range) {
  return as_number(key, require(key, range.text()), range);
}

double TableReader::number(const std::string& key, const Range& range, double fallback) {
  return optional_number(key, range).value_or(fallback);
}

std::optional<double> TableReader::optional_number(const std::string& key, const Range& range) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  return as_number(key, *node, range);
}

std::int64_t TableReader::integer(const std::string& key, std::int64_t low, std::int64_t high) {
  const std::string wanted = fmt::format("a whole number from {} to {}", low, high);
  const toml::node& node = require(key, wanted);
  if (node.is_floating_point()) fail(key, fmt::format("must be {}, without point or exponent", wanted));
  if (!node.is_integer()) fail(key, fmt::format("is {}; must be {}", kind(node), wanted));
  const std::int64_t value = node.as_integer()->get();
  if (value < low || value > high) fail(key, "must be " + wanted);
  return value;
}

std::int64_t TableReader::integer(const std::string& key, std::int64_t low, std::int64_t high, std::int64_t fallback) {
  return has(key) ? integer(key, low, high) : fallback;
}

std::string TableReader::choice(const std::string& key, std::initializer_list<std::string_view> allowed,
                                std::optional<std::string> fallback) {
  const std::string wanted = fmt::format("one of: {}", fmt::join(allowed, ", "));
  if (fallback && !has(key)) return *fallback;
  const auto value = require(key, wanted).value<std::string>();
  if (!value || std::find(allowed.begin(), allowed.end(), *value) == allowed.end()) fail(key, "must be " + wanted);
  return *value;
}

std::vector<double> TableReader::numbers(const std::string& key, const Range& range) {
  const toml::node& node = require(key, "an array of numbers");
  const toml::array* array = node.as_array();
  if (!array || array->empty()) fail(key, fmt::format("must be an array, each entry {}", range.text()));
  std::vector<double> result;
  for (const toml::node& entry : *array) result.push_back(as_number(key, entry, range, result.size()));
  return result;
}

std::vector<double> TableReader::one_or_each(const std::string& key, const Range& range, int count,
                                             const std::string& each, std::optional<double> fallback) {
  if (fallback && !has(key)) return std::vector<double>(count, *fallback);
  const toml::node& node = require(key, fmt::format("{}, or an array of {}, one a {}", range.text(), count, each));
  if (!node.is_array()) return std::vector<double>(count, as_number(key, node, range));
  std::vector<double> result = numbers(key, range);
  if (static_cast<int>(result.size()) != count)
    fail(key, fmt::format("has {} entries; must be {}, or an array of {}, one a {}", result.size(), range.text(), count,
                          each));
  return result;
}

void TableReader::finish() const {
  if (!table_) return;
  for (const auto& [key, node] : *table_) {
    const std::string name(key.str());
    if (std::find(known_.begin(), known_.end(), name) == known_.end())
      throw InputError(document_.where(dotted(name), &node), dotted(printable(name)),
                       document_.value_text(dotted(name), node), unknown_key(name, known_));
  }
}

void check_tables(const Document& document, std::initializer_list<std::string_view> tables) {
  const std::vector<std::string> known(tables.begin(), tables.end());
  for (const auto& [key, node] : document.root) {
    const std::string name(key.str());
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(document.where(name, &node), printable(name), shown(node), unknown_key(name, known));
  }
}

}  // namespace equipoise::study
