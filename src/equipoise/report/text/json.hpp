// JSON of results: objects whose members keep the order in which they are named. nlohmann/json writes null for numbers
// that are not finite.
#pragma once

#include <complex>
#include <concepts>
#include <cstddef>
#include <iterator>
#include <optional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/core/statistics/comparison.hpp"
#include "equipoise/core/statistics/share.hpp"
#include "equipoise/results/commands/outcome_share.hpp"
#include "equipoise/study/contents/study.hpp"

/// Null where there is none.
template <class T>
struct nlohmann::adl_serializer<std::optional<T>> {
  template <class Json>
  static void to_json(Json& json, const std::optional<T>& value) {
    json = nullptr;
    if (value) json = *value;
  }
};

namespace equipoise {

struct SliceAxis;

using Json = nlohmann::ordered_json;

/// put(json, "low", s.low, "high", s.high)
template <class T, class... More>
void put(Json& json, const char* name, T&& value, More&&... more) {
  json[name] = std::forward<T>(value);
  if constexpr (sizeof...(more) > 0) put(json, std::forward<More>(more)...);
}
template <class... Members>
Json object(Members&&... members) {
  Json json;
  put(json, std::forward<Members>(members)...);
  return json;
}
/// Only those that there are.
template <class T, class... More>
void put_known(Json& json, const char* name, const std::optional<T>& value, const More&... more) {
  if (value) json[name] = *value;
  if constexpr (sizeof...(more) > 0) put_known(json, more...);
}

/// Rows of numbers as text: a JSON tree of them would take ten times the memory. `value(k)`: of the k-th entry, row by
/// row; empty: null.
template <class Value>
void append_rows(std::string& text, int columns, int rows, const Value& value) {
  for (int k = 0; k < columns * rows; ++k) {
    text += k % columns > 0 ? "," : k > 0 ? "],[" : "[[";
    if (const auto number = value(static_cast<std::size_t>(k)))
      fmt::format_to(std::back_inserter(text), "{}", *number);
    else
      text += "null";
  }
  text += "]]";
}

/// A list of what `one` makes of each entry.
template <class List, class One>
Json list_of(const List& entries, One&& one) {
  Json list = Json::array();
  for (const auto& entry : entries) list.push_back(one(entry));
  return list;
}

/// A part of a result with the whole that it belongs to, for parts whose JSON needs the whole's units, names or
/// numbers: `void to_json(Json&, const PartOf<Part, Whole>&)`. Lists and optional parts are written part by part.
template <class Part, class Whole>
struct PartOf {
  const Part& part;
  const Whole& whole;
};
template <class Part, class Whole>
PartOf(const Part&, const Whole&) -> PartOf<Part, Whole>;

template <std::ranges::range List, class Whole>
void to_json(Json& json, const PartOf<List, Whole>& of) {
  json = list_of(of.part, [&](const auto& part) { return PartOf{part, of.whole}; });
}
template <class Part, class Whole>
void to_json(Json& json, const PartOf<std::optional<Part>, Whole>& of) {
  json = nullptr;
  if (of.part) json = PartOf{*of.part, of.whole};
}

/// The first `count` of `values`.
template <class Values>
auto leading(const Values& values, std::ptrdiff_t count) {
  return std::vector(values.begin(), values.begin() + count);
}
inline Json complex_pair(const std::complex<double>& value) { return {value.real(), value.imag()}; }
template <class Number>
Json extremes(Number least, Number mean, Number most) {
  return object("min", least, "mean", mean, "max", most);
}

inline void to_json(Json& json, const Estimate& e) { json = object("value", e.value, "low", e.low, "high", e.high); }
/// In another unit.
inline Estimate times(const Estimate& e, double factor) { return {e.value * factor, e.low * factor, e.high * factor}; }
inline void to_json(Json& json, const ShareDifference& d) {
  json = object("difference", d.difference, "low", d.low, "high", d.high);
}

inline void to_json(Json& json, const Share& s) {
  json = object("count", s.count, "share", s.share, "low", s.low, "high", s.high);
}
/// With the bounds that hold whatever open starts come to.
inline Json sure(const Share& s) {
  Json json = s;
  put(json, "least", s.least, "most", s.most);
  return json;
}
/// What all results report on an outcome.
inline Json outcome_with(const OutcomeShare& o, const Json& share) {
  Json json = object("id", o.id, "name", o.name, "alias", o.alias, "kind", o.kind);
  json.update(share);
  return json;
}

/// The key, and the values at the pixels' centres.
void to_json(Json& json, const SliceAxis& axis);
void to_json(Json& json, const StudyValue& value);
/// The resolved study.
void to_json(Json& json, const Study& study);

/// How a result was computed, the last part of every result: "1.20 s, 4.71 s CPU on 4 threads (AVX2)".
template <class Result>
std::string computed_text(const Result& r) {
  return fmt::format("{:.2f} s, {:.2f} s CPU on {} thread{} ({})", r.seconds, r.cpu_seconds, r.threads,
                     plural(r.threads), r.cpu_target);
}

/// Time, threads and instruction set; the study; the version.
template <class Result>
void add_computed(Json& json, const Result& r) {
  put(json, "seconds", r.seconds);
  if constexpr (requires { r.cpu_seconds; }) put(json, "cpu_seconds", r.cpu_seconds);
  put(json, "threads", r.threads, "cpu_target", r.cpu_target, "study_name", r.study.name, "study", r.study, "version",
      version_string);
}

}  // namespace equipoise
