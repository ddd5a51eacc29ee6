// Finds out what a value may be by offering the reader an invalid one: its message says what the key takes.
#include "equipoise/report/html/form.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/read_number.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/text/quantities.hpp"
#include "equipoise/study/contents/keys.hpp"
#include "equipoise/study/echo/physical_echo.hpp"
#include "equipoise/study/toml/toml_tree.hpp"

namespace equipoise {

namespace {
using study::Dimension;

std::vector<std::string> usual_units(Dimension d) {
  switch (d) {
    case Dimension::mass:
      return {"kg", "g", "mg"};
    case Dimension::length:
      return {"m", "mm", "um"};
    case Dimension::time:
      return {"s", "ms", "min"};
    case Dimension::speed:
      return {"rpm", "rad/s", "Hz"};
    case Dimension::velocity:
      return {"m/s", "mm/s"};
    case Dimension::force:
      return {"N", "kN"};
    case Dimension::stiffness:
      return {"N/m", "kN/m", "MN/m", "N/mm"};
    case Dimension::torque:
      return {"N m", "N mm"};
    case Dimension::inertia:
      return {"kg m2", "kg mm2", "g mm2"};
    case Dimension::unbalance:
      return {"kg m", "kg mm", "g mm"};
    case Dimension::viscosity:
      return {"Pa s", "mPa s"};
    case Dimension::kinematic_viscosity:
      return {"m2/s", "mm2/s", "cSt"};
    case Dimension::angle:
      return {"degree", "rad"};
    default:
      return {study::words(d).si};
  }
}

struct Quantity {
  std::string number, unit;
};

// "12 kg" in its parts; without unit: any other text.
Quantity parted(const std::string& text) {
  const std::size_t sign = text.starts_with('+') ? 1 : 0;
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [after, error] = read_number(text.data() + sign, end, value);
  if (error != std::errc()) return {text, ""};
  std::string unit(after, end);
  unit.erase(0, unit.find_first_not_of(' '));
  return {std::string(text.data(), after), unit};
}

void add_units(const std::string& unit, FormField& f) {
  std::vector<Dimension> all;
  for (int k = 0; k <= static_cast<int>(Dimension::angle); ++k) all.push_back(static_cast<Dimension>(k));
  const study::Measured one = study::measure("1 " + unit, all);
  if (one.problem.empty()) f.units = usual_units(one.dimension);
  if (std::find(f.units.begin(), f.units.end(), unit) == f.units.end()) f.units.insert(f.units.begin(), unit);
  for (const std::string& other : f.units) f.worth.push_back(study::measure("1 " + other, {one.dimension}).value);
}

// A number or a text as an entry of a list.
std::string plain(const StudyValue& value) {
  if (const auto* text = value.string()) return *text;
  if (const auto* whole = value.integer()) return fmt::format("{}", *whole);
  if (const auto* truth = value.boolean()) return *truth ? "true" : "false";
  return value.real() ? fmt::format("{}", *value.real()) : "";
}

// Without the table, which a form shows above it; with the table within that: "oil grade".
std::string label_of(const std::string& key) {
  const std::size_t dot = key.rfind('.');
  const study::KeyTable* table = study::find_keys(key.substr(0, dot));
  const study::Key* known = table ? table->find(key.substr(dot + 1), false) : nullptr;
  if (known && known->label) return known->label;
  std::string words = key_words(key);
  const std::size_t shown = key.starts_with("place.") ? dot : key.find('.');
  const bool generic =
      words.size() == key.size() && words.compare(shown + 1, std::string::npos, key_words(key.substr(shown + 1))) == 0;
  if (!generic) return words;
  const std::string below = words.substr(shown + 1), last = " " + key.substr(dot + 1);  // "balance grade grade"
  return below.ends_with(last + last) ? below.substr(0, below.size() - last.size()) : below;
}

class Form {
 public:
  Form(const std::string& text, const std::string& name, const std::vector<std::string>& overrides)
      : name_(name), given_(study::parse_study_file(text, name, overrides).root) {
    const Study study = parse_study(text, name, overrides);  // for messages that know the text's lines
    all_ = study.scales ? study::parse_toml(to_physical_toml(study)) : to_tree(study);
    // A study's tree omits ball angles that were not chosen; a form offers them.
    // The unbalance in it is the resultant with every place, not what the rotor's own keys state.
    if (given_.find("place"))
      for (const char* key : {"eccentricity", "unbalance"}) all_.find("rotor")->erase(key);
    StudyValue& initial = *all_.find("initial");
    if (!initial.find("phi")) {
      const auto& phi = study.initial.phi;
      initial.set("phi", std::vector<double>(phi.begin(), phi.begin() + study.parameters.balls));
    }
  }

  std::vector<FormField> fields() {
    for (const char* table : told_tables) {
      if (std::string_view(table) == "units") continue;
      const StudyValue* given = given_.find(table);
      add(table, given, true);
      if (given && given->array())
        for (std::size_t k = 1; k <= given->array()->size(); ++k)
          add(fmt::format("{}.{}", table, k), given->find(std::to_string(k)), true);
      add(table, all_.find(table), false);
    }
    return std::move(fields_);
  }

 private:
  void add(const std::string& prefix, const StudyValue* table, bool given) {
    if (!table || !table->table()) return;
    for (const auto& [key, value] : *table->table()) {
      const std::string dotted = prefix + "." + key;
      if (study::find_keys(dotted))  // any other table is a distribution, which is one value
        add(dotted, &value, given);
      else if (given || may_be_written(dotted, value))
        fields_.push_back(field(dotted, value, given));
    }
  }

  // A default that may be written next to all other keys: not a second way to state what another key states.
  bool may_be_written(const std::string& key, const StudyValue& value) const {
    return !given_.find_path(key) && !refusal(key, study::value_text(value));
  }

  // The reader's refusal of a value; empty if it accepts the value.
  std::optional<InputError> refusal(const std::string& key, const std::string& value) const {
    try {
      study_from(given_, name_, {key + "=" + value});
    } catch (const InputError& e) {
      return e;
    }
    return std::nullopt;
  }

  FormField field(const std::string& key, const StudyValue& value, bool given) const {
    FormField f;
    f.key = key;
    f.label = label_of(key);
    f.given = given;
    const std::size_t dot = key.rfind('.');
    for (const auto& refused :
         {refusal(key, "\"?\""), refusal(key.substr(0, dot), "{ " + key.substr(dot + 1) + " = \"?\" }")})
      if (f.allowed.empty() && refused && refused->key() == key) f.allowed = refused->allowed();
    constexpr std::string_view one_of = "one of: ";
    if (f.allowed.starts_with(one_of)) {
      for (std::size_t at = one_of.size(); at < f.allowed.size();) {
        const std::size_t comma = std::min(f.allowed.find(", ", at), f.allowed.size());
        f.choices.push_back(f.allowed.substr(at, comma - at));
        at = comma + 2;
      }
    }
    fill(value, f);
    if (!f.unit.empty()) add_units(f.unit, f);
    return f;
  }

  static void fill(const StudyValue& value, FormField& f) {
    if (value.boolean()) {
      f.kind = FormField::Kind::flag;
      f.value = plain(value);
    } else if (value.integer() || value.real()) {
      f.kind =
          value.integer() && f.allowed.starts_with("a whole number") ? FormField::Kind::whole : FormField::Kind::number;
      f.value = plain(value);
    } else if (const auto* text = value.string()) {
      const Quantity q = parted(*text);
      f.kind = !f.choices.empty() ? FormField::Kind::choice
               : q.unit.empty()   ? FormField::Kind::text
                                  : FormField::Kind::number;
      f.value = f.kind == FormField::Kind::number ? q.number : *text;
      f.unit = f.kind == FormField::Kind::number ? q.unit : "";
    } else if (const auto* array = value.array()) {
      fill_list(*array, f);
    } else {
      f.value = study::value_text(value);
    }
  }

  // Quantities in one common unit are shown without it; other lists as written.
  static void fill_list(const StudyValue::Array& array, FormField& f) {
    f.kind = FormField::Kind::list;
    std::vector<Quantity> parts;
    for (const StudyValue& entry : array)
      parts.push_back(entry.string() ? parted(*entry.string()) : Quantity{plain(entry), ""});
    const bool alike =
        std::all_of(parts.begin(), parts.end(), [&](const Quantity& q) { return q.unit == parts[0].unit; });
    if (alike && !parts.empty()) f.unit = parts[0].unit;
    for (const Quantity& q : parts)
      f.value += (f.value.empty() ? "" : ", ") + (alike || q.unit.empty() ? q.number : q.number + " " + q.unit);
  }

  const std::string& name_;
  StudyValue given_, all_;
  std::vector<FormField> fields_;
};

}  // namespace

const char* name_of(FormField::Kind kind) {
  constexpr std::array names{"number", "whole", "list", "choice", "flag", "text"};
  return names[static_cast<std::size_t>(kind)];
}

std::vector<FormField> form_of(const std::string& toml_text, const std::string& name,
                               const std::vector<std::string>& overrides) {
  return Form(toml_text, name, overrides).fields();
}

std::vector<OfferedKey> offered_keys(const Study& study, const std::vector<FormField>& fields) {
  const auto shown = [&](const std::string& key) {
    return std::any_of(fields.begin(), fields.end(),
                       [&](const FormField& f) { return f.key == key || f.key.starts_with(key + "."); });
  };
  std::vector<OfferedKey> offered;
  for (const char* name : told_tables) {
    const study::KeyTable* table = study::find_keys(name);
    if (!table || table->name == "place" || table->name == "units") continue;
    for (const study::Key& key : table->of(study::variants_in(study, table->name), study.scales.has_value())) {
      const std::string dotted = table->name + "." + key.name;
      const bool twice = std::any_of(offered.begin(), offered.end(), [&](const auto& o) { return o.key == dotted; });
      if (!twice && !shown(dotted))
        offered.push_back({dotted, label_of(dotted), key.meaning(study.scales.has_value())});
    }
  }
  return offered;
}

std::string with_overrides(const std::string& toml_text, const std::string& name,
                           const std::vector<std::string>& overrides) {
  return overrides.empty() ? toml_text : to_toml(study::parse_study_file(toml_text, name, overrides).root);
}

}  // namespace equipoise
