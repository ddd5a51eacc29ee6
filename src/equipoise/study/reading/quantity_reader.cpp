// Reads quantities with their dimension and range.
#include "equipoise/study/reading/quantity_reader.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "equipoise/study/words/study.hpp"

namespace equipoise::study {

std::string wanted_quantity(const std::vector<Dimension>& dimensions, const Range& range) {
  const std::string bound = range.low != 0.0 ? "" : range.low_open ? " greater than 0" : " of 0 or more";
  std::string text;
  for (const Dimension d : dimensions)
    text += fmt::format("{}{}{}, such as \"{}\"", text.empty() ? "" : ", or ", words(d).name, bound, words(d).example);
  return text;
}

Measured measure_value(const StudyValue& value, const std::vector<Dimension>& dimensions, const Range& range,
                       const std::function<void(const std::string&)>& reject) {
  if (dimensions.front() == Dimension::angle && value.is_number()) {  // in radians
    const double angle = value.number();
    if (!range.contains(angle)) reject("must be " + wanted_quantity(dimensions, range));
    return {angle, Dimension::angle, ""};
  }
  if (!value.string())
    reject(fmt::format(words::study::quantity_needed, value.is_number() ? "a plain number" : "no quantity",
                       wanted_quantity(dimensions, range)));
  const Measured result = measure(*value.string(), dimensions);
  if (!result.problem.empty()) reject(result.problem);
  if (!range.contains(result.value)) reject("must be " + wanted_quantity({result.dimension}, range));
  const double size = std::abs(result.value);
  if (size > largest_si || (size < smallest_si && (size > 0.0 || range.low_open)))
    reject(fmt::format(words::study::size_in_si, wanted_quantity({result.dimension}, range), smallest_si, largest_si));
  return result;
}

// A plain number may be meant for the key's alternative.
std::function<void(const std::string&)> QuantityReader::refusal(const std::string& key, const StudyValue& value) const {
  const auto other = alternatives_.find(key);
  const std::string more = value.is_number() && other != alternatives_.end() ? other->second : "";
  return [this, key, more](const std::string& problem) { fail(key, problem + more); };
}

const Key& QuantityReader::line(const std::string& key) const { return *key_table(prefix_).find(key, true); }

double QuantityReader::quantity(const std::string& key, std::optional<Dimension> other, Dimension* measured) {
  require(key, wanted_quantity({*line(key).dimension}, quantity_range(line(key))));
  if (find(key)->array()) fail(key, words::study::one_quantity);
  return one_or_each(key, 1, "", other, measured).front();
}

std::optional<double> QuantityReader::optional_quantity(const std::string& key) {
  const StudyValue* value = find(key);
  if (!value) return std::nullopt;
  return measure_value(*value, {*line(key).dimension}, quantity_range(line(key)), refusal(key, *value)).value;
}

std::vector<double> QuantityReader::one_or_each(const std::string& key, int count, const std::string& each,
                                                std::optional<Dimension> other, Dimension* measured) {
  std::vector<Dimension> dimensions{*line(key).dimension};
  if (other) dimensions.push_back(*other);
  const Range range = quantity_range(line(key));
  const StudyValue* value = find(key);
  if (!value) return {};
  Dimension ignored{};
  Dimension& dimension = measured ? *measured : ignored;
  const StudyValue::Array* array = value->array();
  if (!array) {
    const Measured one = measure_value(*value, dimensions, range, refusal(key, *value));
    dimension = one.dimension;
    return std::vector<double>(static_cast<std::size_t>(count), one.value);
  }
  if (array->size() != static_cast<std::size_t>(count))
    fail(key,
         fmt::format(words::study::entries_for_each, array->size(), wanted_quantity(dimensions, range), count, each));
  std::vector<double> values;
  for (const StudyValue& entry : *array) {
    const std::vector<Dimension> allowed = values.empty() ? dimensions : std::vector<Dimension>{dimension};
    const auto reject = [&](const std::string& p) { fail(key, fmt::format("entry {} {}", values.size() + 1, p)); };
    const Measured one = measure_value(entry, allowed, range, reject);
    dimension = one.dimension;
    values.push_back(one.value);
  }
  return values;
}

std::vector<double> QuantityReader::require_one_or_each(const std::string& key, int count, const std::string& each) {
  require(key, wanted_quantity({*line(key).dimension}, quantity_range(line(key))));
  return one_or_each(key, count, each);
}

std::vector<double> QuantityReader::list(const std::string& key) {
  const std::string wanted = wanted_quantity({*line(key).dimension}, quantity_range(line(key)));
  const StudyValue::Array* array = require(key, fmt::format(words::study::array_of, wanted)).array();
  if (!array || array->empty()) fail(key, fmt::format(words::study::must_be_array_of, wanted));
  return one_or_each(key, static_cast<int>(array->size()), "");
}

std::map<std::string, std::vector<double>> QuantityReader::others(int balls) {
  std::map<std::string, std::vector<double>> values;
  Study any;
  for (const Key& key : key_table(prefix_).of(all_variants, true)) {
    const Member member = key.member(any);
    if (has_asked(key.name) || !has(key.name) || !key.dimension) continue;
    if (std::holds_alternative<double*>(member) || std::holds_alternative<std::monostate>(member))
      values[key.name] = {*optional_quantity(key.name)};
    else if (std::holds_alternative<std::array<double, 2>*>(member))
      values[key.name] = one_or_each(key.name, 2, "direction (x, y)");
    else
      values[key.name] = one_or_each(key.name, balls, "ball");
  }
  return values;
}

std::string QuantityReader::at_most_one(const std::vector<Alternative>& alternatives) {
  std::string given;
  for (const Alternative& one : alternatives) {
    for (const Alternative& other : alternatives)
      if (other.key != one.key)
        alternatives_[one.key] += fmt::format(", or give {}, {}", dotted(other.key), other.words);
    if (!has(one.key)) continue;
    if (!given.empty()) fail(one.key, fmt::format(words::study::either_or, dotted(given), dotted(one.key)));
    given = one.key;
  }
  return given;
}

std::string QuantityReader::exactly_one(const std::vector<Alternative>& alternatives) {
  const std::string given = at_most_one(alternatives);
  const Alternative& first = alternatives.front();
  if (given.empty()) fail(first.key, fmt::format("missing; must be {}{}", first.words, alternatives_[first.key]));
  return given;
}

}  // namespace equipoise::study
