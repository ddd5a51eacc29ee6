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

inline constexpr char only_of_tilt[] = "has a meaning only with rotor.tilt";
inline constexpr char ratio_is_percentage[] = "must be at most 1, or a percentage; did you mean \"{:.6g} %\"?";
inline constexpr char bearings_state_it[] = "follows from rotor.tilt.bearings; give either these or that";

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
/// What the keys that a study states need: other keys, units, a tilting rotor.
void check_needs(const Study& study, const Refuse& refuse);

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

/// ", or give rotor.unbalance, mass times eccentricity, such as "300 g mm"": the other ways in which a data sheet may
/// state what this key does; else empty.
std::string or_give(std::string_view dotted);

/// Refuses a study that states one thing in several ways.
void refuse_several_ways(const Study& study, const Refuse& refuse);

/// The key, without its table, in which a study states what may be stated by `first`, the first of these ways; empty if
/// it does in none, which is refused if it is `required`.
std::string_view way_of(const Study& study, std::string_view first, const Refuse& refuse, bool required = true);

}  // namespace equipoise::study
