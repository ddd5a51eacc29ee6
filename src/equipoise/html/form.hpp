// A study as a form: every key with its value, its unit and what it may be.
#pragma once

#include <string>
#include <vector>

#include "equipoise/study/study.hpp"

namespace equipoise {

/// One key.
struct FormField {
  enum class Kind { number, whole, list, choice, flag, text };

  std::string key;                 ///< dotted, as --set takes it
  std::string label;               ///< in words
  std::string value;               ///< without its unit: "12", "0.05, 0.06"
  std::string unit;                ///< of a quantity, or of all quantities of a list; else empty
  std::vector<std::string> units;  ///< that such a quantity may be written in, `unit` among them
  std::vector<double> worth;       ///< SI units that one of each of `units` is
  std::string allowed;             ///< in the words of the message for a wrong value
  std::vector<std::string> choices;
  Kind kind = Kind::text;
  bool given = false;  ///< written in the study; else a default
};
const char* name_of(FormField::Kind kind);

/// The keys of the text of a study that parse_study() accepts, overrides applied: in the order of the guide those that
/// are written, then those that may be and have defaults.
std::vector<FormField> form_of(const std::string& toml_text, const std::string& name,
                               const std::vector<std::string>& overrides = {});

/// The same text with the overrides in it.
std::string with_overrides(const std::string& toml_text, const std::string& name,
                           const std::vector<std::string>& overrides);

}  // namespace equipoise
