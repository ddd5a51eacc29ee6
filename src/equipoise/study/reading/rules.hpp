// Rules between the numbers of a study: of one that is read, and of one that gets other numbers.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "equipoise/core/base/error.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/reading/table_reader.hpp"

namespace equipoise::study {

/// Throws an InputError about the dotted key.
using Refuse = std::function<void(const std::string& key, const std::string& problem)>;

inline Refuse refuse_in(const StudyFile& file) {
  return [&file](const std::string& key, const std::string& problem) { file.fail(key, problem); };
}

inline Refuse refuse_in(const Study& study) {
  return
      [&study](const std::string& key, const std::string& problem) { throw InputError(study.name, key, "", problem); };
}

/// All of them.
void check_numbers(const Study& study, const Refuse& refuse);

/// What a draw of an uncertain value sets its key to, in SI units if the study is a machine in these. Refuses what the
/// key does not take.
double number_of(Study& study, const UncertainValue& value, double drawn, const Refuse& refuse);

/// A number for a dotted key.
struct NumberAt {
  std::string_view key;
  double value;
};

/// Puts numbers into the members of a study; what follows from them by default follows. False if a key has no places in
/// numbers_of(): then `study` is of no use.
bool put_numbers(Study& study, std::span<const NumberAt> numbers);
/// The same, but false also if such a study would be refused: reading it says why.
bool put_valid_numbers(Study& study, std::span<const NumberAt> numbers);

}  // namespace equipoise::study
