// Finds, sets and removes members.
#include "equipoise/study/toml/study_value.hpp"

#include <algorithm>
#include <stdexcept>

namespace equipoise {

StudyValue::StudyValue(Array entries) : value_(std::move(entries)) {}

StudyValue::StudyValue(const std::vector<double>& entries) : value_(Array(entries.begin(), entries.end())) {}

StudyValue::StudyValue(std::initializer_list<Member> members) {
  for (const Member& member : members) set(member.key, member.value);
}

double StudyValue::number() const {
  if (const std::int64_t* n = integer()) return static_cast<double>(*n);
  const double* v = real();
  return v ? *v : 0.0;
}

StudyValue* StudyValue::find(std::string_view key) {
  if (auto* entries = std::get_if<Array>(&value_)) {
    constexpr std::size_t most_digits = 9;
    std::size_t number = 0;
    if (key.size() > most_digits) return nullptr;
    for (const char c : key) {
      if (c < '0' || c > '9') return nullptr;
      number = 10 * number + static_cast<std::size_t>(c - '0');
    }
    return number >= 1 && number <= entries->size() ? &(*entries)[number - 1] : nullptr;
  }
  auto* members = std::get_if<Table>(&value_);
  if (!members) return nullptr;
  const auto at = std::find_if(members->begin(), members->end(), [&](const Member& m) { return m.key == key; });
  return at == members->end() ? nullptr : &at->value;
}

const StudyValue* StudyValue::find(std::string_view key) const { return const_cast<StudyValue*>(this)->find(key); }

StudyValue* StudyValue::find_path(std::string_view dotted) {
  StudyValue* value = this;
  for (std::size_t begin = 0; value && begin <= dotted.size();) {
    const std::size_t dot = std::min(dotted.find('.', begin), dotted.size());
    value = value->find(dotted.substr(begin, dot - begin));
    begin = dot + 1;
  }
  return value;
}

const StudyValue* StudyValue::find_path(std::string_view dotted) const {
  return const_cast<StudyValue*>(this)->find_path(dotted);
}

StudyValue& StudyValue::set(std::string key, StudyValue value) {
  auto* members = std::get_if<Table>(&value_);
  if (!members) throw std::logic_error("only a table has members");
  if (StudyValue* there = find(key)) return *there = std::move(value);
  members->push_back({std::move(key), std::move(value)});
  return members->back().value;
}

void StudyValue::erase(std::string_view key) {
  if (auto* members = std::get_if<Table>(&value_))
    std::erase_if(*members, [&](const Member& m) { return m.key == key; });
}

}  // namespace equipoise
