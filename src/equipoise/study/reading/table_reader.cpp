// The study reader's machinery: overrides, ranges, unknown keys.
#include "equipoise/study/reading/table_reader.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/nearest_name.hpp"
#include "equipoise/core/base/read_number.hpp"
#include "equipoise/study/contents/keys.hpp"
#include "equipoise/study/reading/rules.hpp"
#include "equipoise/study/toml/overrides.hpp"
#include "equipoise/study/toml/toml_tree.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise::study {

namespace {

// The line number of a table made by an override.
constexpr int line_of_override = -1;

// "12 kg", where a plain number was wanted.
bool looks_physical(const StudyValue& value) {
  const auto* text = value.string();
  return text && !text->empty() && std::string_view("+-.0123456789").find(text->front()) != std::string::npos;
}

// A number as people also type it: ".05", "5.", which TOML has not.
std::optional<double> number_beside_point(const std::string& text) {
  return text.find('.') == std::string::npos ? std::nullopt : number_of_all(text);
}

// The value of an override: TOML, a number, or a bare word or quantity ("published", "12 kg") as a string.
StudyValue parse_value(const std::string& key, const std::string& value) {
  try {
    const StudyValue parsed = parse_toml("value = " + value);
    if (parsed.table()->size() == 1) return *parsed.find("value");
  } catch (const TextFault& fault) {
    if (const auto number = number_beside_point(value)) return *number;
    if (std::string_view("[{\"'").find(value.front()) == std::string_view::npos) return value;
    throw InputError(overrides_name, shown_text(key), shown_text(value), fault.problem);
  }
  throw InputError(overrides_name, shown_text(key), shown_text(value), "must be a single TOML value");
}

bool holds_tables(const StudyValue& value) {
  return value.array() && !value.array()->empty() && value.array()->front().table();
}

void apply_override(StudyFile& file, const std::string& text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  const std::string key = key_here(file.root, std::string(trimmed(text.substr(0, equals), " \t")));
  const std::string value = equals == text.size() ? "" : std::string(trimmed(text.substr(equals + 1), " \t"));
  const bool has_empty_part =
      key.empty() || key.front() == '.' || key.back() == '.' || key.find("..") != std::string::npos;
  if (has_empty_part || value.empty())
    throw InputError(std::string(overrides_name) + " " + shown_text(text), "", "",
                     "must be key=value, for example rotor.eccentricity=0.02");
  if (std::count(key.begin(), key.end(), '.') >= most_key_parts)
    throw InputError(overrides_name, shown_text(key), shown_text(value),
                     "unknown key: more parts than any key of a study has");

  StudyValue parsed = parse_value(key, value);
  StudyValue* table = &file.root;
  std::size_t begin = 0;
  const auto entry_of_array = [&](const std::string& part) {
    const std::string name = shown_text(key.substr(0, begin - 1));
    StudyValue* entry = table->find(part);
    if (!entry)
      throw InputError(overrides_name, shown_text(key), shown_text(value),
                       fmt::format("{} has entries {}.1 to {}.{}", name, name, name, table->array()->size()));
    return entry;
  };
  for (std::size_t dot; (dot = key.find('.', begin)) != std::string::npos; begin = dot + 1) {
    const std::string part = key.substr(begin, dot - begin);
    StudyValue* inner = table->array() ? entry_of_array(part) : table->find(part);
    if (!inner) {
      inner = &table->set(part, {});
      inner->set_line(line_of_override);
    }
    table = inner;
    if (!table->table() && !holds_tables(*table))
      throw InputError(overrides_name, shown_text(key), shown_text(value),
                       fmt::format("\"{}\" is not a table", shown_text(key.substr(0, dot))));
  }
  if (table->array())
    *entry_of_array(key.substr(begin)) = std::move(parsed);
  else
    table->set(key.substr(begin), std::move(parsed));
  file.overridden.insert(key);
}

}  // namespace

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

std::string Wanted::text() const {
  if (!is_quantity()) return range.text();
  return wanted_text(dimensions, range.low != 0.0 ? "" : range.low_open ? " greater than 0" : " of 0 or more");
}

Measured measure_value(const StudyValue& value, const Wanted& wanted,
                       const std::function<void(const std::string&)>& reject) {
  if (wanted.dimensions.front() == Dimension::angle && value.is_number()) {  // in radians
    const double angle = value.number();
    if (!wanted.range.contains(angle)) reject("must be " + wanted.text());
    return {angle, Dimension::angle, ""};
  }
  if (!value.string())
    reject(fmt::format("is {} and rotor.mass makes this a study in physical units; must be {}",
                       value.is_number() ? "a plain number" : "no quantity", wanted.text()));
  Measured result = measure(*value.string(), wanted.dimensions);
  if (!result.problem.empty()) reject(result.problem);
  const auto must_be = [&] { return Wanted(wanted.range, {result.dimension}).text(); };
  if (!wanted.range.contains(result.value)) reject("must be " + must_be());
  const double size = std::abs(result.value);
  if (size > largest_si || (size < smallest_si && (size > 0.0 || wanted.range.low_open)))
    reject(fmt::format("must be {}; its size in SI units must be {} to {}", must_be(), smallest_si, largest_si));
  return result;
}

std::string key_here(const StudyValue& root, const std::string& key) {
  const std::string* profile = key == "speed.final" ? root.find_text("speed.profile") : nullptr;
  return profile && *profile == "constant" ? "speed.speed" : key;
}

std::string StudyFile::value_text(const std::string& dotted_key, const StudyValue& value) const {
  return shown(taken.contains(dotted_key) ? *root.find_path(dotted_key) : value);
}

Place StudyFile::where(const std::string& dotted_key, const StudyValue* value) const {
  for (std::size_t dot = 0; dot != std::string::npos;) {
    dot = dotted_key.find('.', dot + 1);
    if (overridden.count(dotted_key.substr(0, dot))) return overrides_name;
  }
  if (!value) return name;
  if (value->line() == line_of_override) return overrides_name;
  return {name, value->line()};
}

void StudyFile::fail(const std::string& dotted_key, const std::string& problem) const {
  const StudyValue* value = root.find_path(dotted_key);
  throw InputError(where(dotted_key, value), dotted_key, value ? value_text(dotted_key, *value) : "", problem);
}

StudyFile parse_study_file(std::string_view text, const std::string& name, const std::vector<std::string>& overrides) {
  try {
    return study_file_of(parse_toml(text), name, overrides);
  } catch (const TextFault& fault) {
    throw InputError({name, static_cast<int>(fault.line), static_cast<int>(fault.column)}, "", "", fault.problem);
  }
}

StudyFile study_file_of(StudyValue tree, const std::string& name, const std::vector<std::string>& overrides) {
  StudyFile file;
  file.name = name;
  file.root = std::move(tree);
  if (!file.root.table())
    throw InputError(name, "", shown(file.root), "must be a table of tables, [rotor] and the others of a study");
  for (const std::string& item : overrides) apply_override(file, item);
  return file;
}

TableReader::TableReader(const StudyFile& file, std::string prefix) : prefix_(std::move(prefix)), file_(file) {
  const StudyValue* value = file.root.find_path(prefix_);
  if (!value) return;
  table_ = value->table() ? value : nullptr;
  if (!table_)
    throw InputError(file.where(prefix_, value), prefix_, shown(*value), fmt::format("must be a table, [{}]", prefix_));
}

bool TableReader::has_asked(const std::string& key) const {
  return std::find(known_.begin(), known_.end(), key) != known_.end();
}

const StudyValue* TableReader::find(const std::string& key) {
  if (!has_asked(key)) known_.push_back(key);
  if (const auto drawn = file_.taken.find(dotted(key)); drawn != file_.taken.end()) return &drawn->second;
  return table_ ? table_->find(key) : nullptr;
}

std::optional<TableReader> TableReader::inner(const std::string& key) {
  const StudyValue* value = find(key);
  if (!value || !value->table()) return std::nullopt;
  return TableReader(file_, dotted(key));
}

bool TableReader::has(const std::string& key) { return find(key) != nullptr; }

std::size_t entry_of(std::string_view table) {
  if (table == "speed.torque.target") return of_target;
  const double number = number_of_all(table.substr(table.find_last_not_of("0123456789") + 1)).value_or(1.0);
  return static_cast<std::size_t>(number) - 1;
}

const StudyValue& TableReader::require(const std::string& key, const std::string& wanted) {
  if (const StudyValue* value = find(key)) return *value;
  std::vector<std::string> there;
  if (table_)
    for (const auto& [other, value] : *table_->table()) there.push_back(other);
  const std::string near = nearest_name(key, there);
  const std::string hint = near.empty() ? "" : fmt::format(" (is \"{}\" meant for it?)", shown_text(near));
  throw InputError(file_.where(dotted(key), nullptr), dotted(key), "",
                   fmt::format("missing{}; must be {}", hint, wanted));
}

std::string TableReader::kind(const StudyValue& value) {
  if (value.string()) return "a string";
  if (value.table()) return "a table";
  if (value.array()) return "an array";
  if (value.boolean()) return "a boolean";
  return value.other() ? value.other()->kind : "a number";
}

bool TableReader::states_units() const { return file_.physical || file_.root.find_path("rotor.mass"); }

double TableReader::as_number(const std::string& key, const StudyValue& value, const Wanted& wanted,
                              std::optional<std::size_t> entry) {
  const std::string which = entry ? fmt::format("entry {} ", *entry + 1) : "";
  const Range& range = wanted.range;
  if (wanted.is_quantity()) {
    if (value.array() && !entry) fail(key, "is an array; must be one quantity");
    // A plain number may be meant for a key that states the same in another way.
    const std::string more = value.is_number() && !entry ? or_give(dotted(key)) : "";
    const Measured quantity =
        measure_value(value, wanted, [&](const std::string& problem) { fail(key, which + problem + more); });
    measured_ = quantity.dimension;
    return quantity.value;
  }
  const auto reject = [&](const std::string& problem) {
    throw InputError(file_.where(dotted(key), &value), dotted(key), file_.value_text(dotted(key), value),
                     which + problem);
  };
  const std::optional<double> percent = value.string() ? percentage(*value.string()) : std::nullopt;
  if (!value.is_number() && !percent)
    reject(fmt::format("is {}; must be {}{}", kind(value), range.text(),
                       looks_physical(value) && !states_units() ? " (a study in physical units states rotor.mass)"
                       : value.table() && takes_distributions(prefix_)
                           ? fmt::format(", or a distribution, {}", distribution_forms)
                           : ""));
  const double number = percent.value_or(value.number());
  if (!range.contains(number)) {
    const bool too_large = std::isfinite(number) && std::abs(number) > unbounded;
    reject("must be " + range.text() + (too_large ? fmt::format(", at most {} in size", unbounded) : ""));
  }
  return number;
}

double TableReader::number(const std::string& key, const Wanted& wanted) {
  return as_number(key, require(key, wanted.text()), wanted);
}

std::int64_t TableReader::integer(const std::string& key, std::int64_t low, std::int64_t high) {
  const std::string wanted = fmt::format("a whole number from {} to {}", low, high);
  const StudyValue& value = require(key, wanted);
  if (value.real()) fail(key, fmt::format("must be {}, without point or exponent", wanted));
  if (!value.integer()) fail(key, fmt::format("is {}; must be {}", kind(value), wanted));
  const std::int64_t number = *value.integer();
  if (number < low || number > high) fail(key, "must be " + wanted);
  return number;
}

std::int64_t TableReader::integer(const std::string& key, std::int64_t low, std::int64_t high, std::int64_t fallback) {
  return has(key) ? integer(key, low, high) : fallback;
}

std::size_t TableReader::place_among(const std::string& key, std::span<const char* const> names) {
  const std::string wanted = fmt::format("one of: {}", fmt::join(names, ", "));
  const std::string* value = require(key, wanted).string();
  const auto at = value ? std::find(names.begin(), names.end(), *value) : names.end();
  if (at == names.end()) fail_among(key, {names.begin(), names.end()});
  return static_cast<std::size_t>(at - names.begin());
}

void TableReader::fail_among(const std::string& key, const std::vector<std::string>& names, const std::string& wrong) {
  const StudyValue* value = find(key);
  const std::string* given = value ? value->string() : nullptr;
  fail(key,
       fmt::format("{}{}must be one of: {}", wrong, given ? did_you_mean(*given, names) : "", fmt::join(names, ", ")));
}

std::string TableReader::text(const std::string& key) {
  const StudyValue& value = require(key, "a text in quotes");
  if (!value.string()) fail(key, fmt::format("is {}; must be a text in quotes", kind(value)));
  return *value.string();
}

bool TableReader::flag(const std::string& key) {
  const StudyValue& value = require(key, "true or false");
  if (!value.boolean()) fail(key, fmt::format("is {}; must be true or false", kind(value)));
  return *value.boolean();
}

std::vector<double> TableReader::numbers(const std::string& key, const Wanted& wanted) {
  const StudyValue::Array* array =
      require(key, wanted.is_quantity() ? fmt::format("an array, each entry {}", wanted.text()) : "an array of numbers")
          .array();
  if (!array || array->empty()) fail(key, fmt::format("must be an array, each entry {}", wanted.text()));
  std::vector<double> result;
  Wanted each = wanted;  // all measure the same
  for (const StudyValue& entry : *array) {
    result.push_back(as_number(key, entry, each, result.size()));
    if (each.is_quantity()) each.dimensions = {measured_};
  }
  return result;
}

std::vector<std::string> TableReader::texts(const std::string& key) {
  std::vector<std::string> result;
  const StudyValue* value = find(key);
  if (!value) return result;
  if (!value->array()) fail(key, fmt::format("is {}; must be an array of strings", kind(*value)));
  for (const StudyValue& entry : *value->array()) {
    if (!entry.string()) fail(key, fmt::format("has an entry that is {}; must be an array of strings", kind(entry)));
    result.push_back(*entry.string());
  }
  return result;
}

std::vector<double> TableReader::one_or_each(const std::string& key, const Wanted& wanted, int count,
                                             const std::string& each) {
  const StudyValue& value =
      require(key, wanted.is_quantity() ? wanted.text()
                                        : fmt::format("{}, or an array of {}, one per {}", wanted.text(), count, each));
  if (!value.array()) return std::vector<double>(count, as_number(key, value, wanted));
  std::vector<double> result = numbers(key, wanted);
  if (static_cast<int>(result.size()) != count)
    fail(key, fmt::format("has {} entries; must be {}, or an array of {}, one per {}", result.size(), wanted.text(),
                          count, each));
  return result;
}

void TableReader::finish() const {
  if (!table_) return;
  for (const auto& [name, value] : *table_->table())
    if (!has_asked(name))
      throw InputError(file_.where(dotted(name), &value), dotted(shown_text(name)),
                       file_.value_text(dotted(name), value), unknown_key(prefix_, name, known_));
}

}  // namespace equipoise::study
