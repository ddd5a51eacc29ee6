// Numbers in bulk next to JSON: a place in the module's memory, which the worker reads or has written.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace equipoise::web {

using Json = nlohmann::ordered_json;

/// What a reply holds in the place of a typed array; the worker makes a copy of it before the next call.
template <class Number>
Json marker(const char* type, const std::vector<Number>& numbers) {
  return {{"$array", type}, {"at", reinterpret_cast<std::uintptr_t>(numbers.data())}, {"length", numbers.size()}};
}

/// Arrays of the reply that is being made: they stay until the next call begins.
class Bulk {
 public:
  Json doubles(std::vector<double> numbers) { return marker("f64", doubles_.emplace_back(std::move(numbers))); }
  Json wholes(std::vector<std::int32_t> numbers) { return marker("i32", wholes_.emplace_back(std::move(numbers))); }

 private:
  std::vector<std::vector<double>> doubles_;
  std::vector<std::vector<std::int32_t>> wholes_;
};

/// An array of a request, which the worker has put into memory.
template <class Number>
std::vector<Number> numbers_of(const Json& marker) {
  const auto* first = reinterpret_cast<const Number*>(marker.at("at").get<std::uintptr_t>());
  return {first, first + marker.at("length").get<std::size_t>()};
}

}  // namespace equipoise::web
