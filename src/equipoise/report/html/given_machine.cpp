// Reads a study's tree for display, and adds what explain() finds.
#include "equipoise/report/html/given_machine.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "equipoise/report/explain/explain.hpp"
#include "equipoise/study/echo/physical_echo.hpp"
#include "equipoise/study/reading/table_reader.hpp"

namespace equipoise {

namespace {

std::string words_of(const std::string& key) {
  std::string words = key;
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

// `between`: the keys of a table.
std::string words_of_value(const StudyValue& value, const char* between = ", ") {
  if (const auto* table = value.table()) {
    std::string text;
    for (const auto& [key, member] : *table)
      text += fmt::format("{}{} {}", text.empty() ? "" : between, words_of(key), words_of_value(member));
    return text;
  }
  if (const auto* array = value.array()) {
    constexpr std::size_t most = 12;
    std::string text;
    for (std::size_t k = 0; k < array->size() && k < most; ++k) text += (k ? ", " : "") + words_of_value((*array)[k]);
    return array->size() > most ? text + ", ..." : text;
  }
  if (const auto* truth = value.boolean()) return *truth ? "yes" : "no";
  if (const auto* whole = value.integer()) return fmt::format("{}", *whole);
  if (const auto* number = value.real()) return fmt::format("{}", *number);
  return value.string() ? *value.string() : value.other()->text;
}

std::vector<GivenTable> tables_of(const StudyValue& root) {
  std::vector<GivenTable> tables;
  const auto add = [&](const std::string& name, const StudyValue& value) {
    if (value.table() && !value.table()->empty()) tables.push_back({name, words_of_value(value, "; ")});
  };
  for (const char* name : told_tables) {
    const StudyValue* found = root.find(name);
    if (!found) continue;
    add(name, *found);
    for (std::size_t k = 0; found->array() && k < found->array()->size(); ++k)
      add(fmt::format("{} {}", name, k + 1), (*found->array())[k]);
  }
  return tables;
}

}  // namespace

std::vector<GivenTable> given_tables(const std::string& toml_text, const std::string& name,
                                     const std::vector<std::string>& overrides) {
  return tables_of(study::parse_study_file(toml_text, name, overrides).root);
}

std::vector<GivenTable> given_tables(const Study& study) {
  return study.scales ? given_tables(to_physical_toml(study), study.name) : tables_of(to_tree(study));
}

GivenMachine given_machine(const std::string& toml_text, const std::string& name,
                           const std::vector<std::string>& overrides, const StopFlag* stop) {
  const Study study = parse_study(toml_text, name, overrides);
  check_pages(study);
  StudyCheck checked = check_study(toml_text, name, overrides, stop);
  // A page's starts draw them.
  std::erase_if(checked.assumed, [](const std::string& text) { return text.starts_with(medians_assumed); });
  return {given_tables(toml_text, name, overrides), explain(study, stop), std::move(checked.assumed),
          std::move(checked.most)};
}

GivenMachine given_machine(const Study& study) {
  check_pages(study);
  return {given_tables(study), explain(study), {}, {}};
}

}  // namespace equipoise
