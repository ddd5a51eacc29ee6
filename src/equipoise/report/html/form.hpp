// A study as a form: every key with its value, its unit and the values allowed.
#pragma once

#include <string>
#include <vector>

#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// One key.
struct FormField {
  enum class Kind { number, whole, list, choice, flag, text };

  std::string key;                 ///< dotted, as --set takes it
  std::string label;               ///< in words
  std::string value;               ///< without its unit: "12", "0.05, 0.06"
  std::string unit;                ///< of a quantity, or common to a list of quantities; else empty
  std::vector<std::string> units;  ///< units allowed for such a quantity, `unit` among them
  std::vector<double> worth;       ///< one of each of `units` in SI units
  std::string allowed;             ///< in the words of the message for a wrong value
  std::vector<std::string> choices;
  Kind kind = Kind::text;
  bool given = false;  ///< stated in the study; else a default
};
const char* name_of(FormField::Kind kind);

/// The keys of a study's text that parse_study() accepts, with overrides applied. In the order of the guide: first
/// those that are stated, then those that may be, with their defaults.
std::vector<FormField> form_of(const std::string& toml_text, const std::string& name,
                               const std::vector<std::string>& overrides = {});

/// A key that a study of this kind, with this profile, may also state; some only in place of another.
struct OfferedKey {
  std::string key, label;
  std::string sentence;  ///< what it is, as the guide has it
};
/// Those that are not among `fields`, which are form_of() the study; keys of tables within tables left out.
std::vector<OfferedKey> offered_keys(const Study& study, const std::vector<FormField>& fields);

/// The same text with the overrides in it.
std::string with_overrides(const std::string& toml_text, const std::string& name,
                           const std::vector<std::string>& overrides);

}  // namespace equipoise
