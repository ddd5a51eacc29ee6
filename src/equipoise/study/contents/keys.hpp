// Every key of a study, described once. The reader, its messages and suggestions, the echo, units, forms and the
// guide's reference all follow from it. To add a key, add a line in keys.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/reading/table_reader.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise::study {

/// Where a study keeps a value. The type says how it is read and written: one number, one per direction, two for both
/// directions or for each, one per ball.
/// Empty for tables, and for an entry that an array of tables has not.
using Member = std::variant<std::monostate, double*, std::optional<double>*, std::array<double, 2>*,
                            std::array<std::array<double, 2>, 2>*, std::array<double, model::max_balls>*,
                            std::vector<double>*, std::string*, std::vector<std::string>*,
                            std::optional<SamplingBox::Side>*, bool*, int*, std::uint64_t*, Profile*, model::SpeedLaw*,
                            std::optional<SamplingMethod>*, std::optional<SeverityClassName>*, ClassificationMode*>;

inline std::span<const char* const> names_of(Profile) { return profile_names; }
inline std::span<const char* const> names_of(model::SpeedLaw) { return speed_law_names; }
inline std::span<const char* const> names_of(SamplingMethod) { return sampling_method_names; }
inline std::span<const char* const> names_of(SeverityClassName) { return severity_class_names; }
inline std::span<const char* const> names_of(ClassificationMode) { return classification_mode_names; }

struct Key {
  /// From the ninth bit on: the variants of the table that have the key; no bit set means all. The variants of [speed]
  /// and of a motor's target are profiles, those of speed.torque laws.
  enum Trait : unsigned {
    none = 0,
    required = 1,
    pair = 2,         ///< [x, y], never one number for both
    physical = 4,     ///< only in studies in physical units
    replaceable = 8,  ///< another key may state it in these: required only in dimensionless studies
    nonzero = 16,     ///< as a quantity greater than 0
    constant = 1 << 8,
    ramp = 1 << 9,
    trapezoid = 1 << 10,
    points = 1 << 11,
    hill = 1 << 12,
    driven = 1 << 13,
    stall = 1 << 8,
    curve = 1 << 9,
    control = 1 << 10,
    linear = 1 << 11,
    characteristic = 1 << 12,
  };

  /// A quantity that may be given instead, and what notes that it was.
  struct Other {
    Dimension dimension;
    bool DataSheet::*given;
  };

  /// One of the ways in which a data sheet may state what a key of this table does.
  struct Way {
    const char* of = nullptr;     ///< that key, the first way; null: there is one way
    const char* words = nullptr;  ///< what to give, for a message
  };

  const char* name;
  Member (*where)(Study&, std::size_t entry);
  Range range;                         ///< of the dimensionless value; in SI units for purely physical keys
  std::optional<Dimension> dimension;  ///< of a key that is a quantity in a physical study
  unsigned traits;
  const char* sentence;                    ///< for the guide; in_units() may have another for physical studies
  const char* label = nullptr;             ///< in a form, below its table's name; null: the key in words
  bool (*echoed)(const Study&) = nullptr;  ///< null: always, if set
  std::optional<Other> other = std::nullopt;
  Way way = {};
  const char* sentence_in_units = nullptr;  ///< null: the same

  template <class Value>
  Key with(Value Key::*member, const Value& value) const {
    Key key = *this;
    key.*member = value;
    return key;
  }
  Key in_units(const char* text) const { return with(&Key::sentence_in_units, text); }
  Key or_as(Dimension quantity, bool DataSheet::*given) const { return with(&Key::other, {{quantity, given}}); }
  Key one_way(const char* of, const char* words) const { return with(&Key::way, {of, words}); }

  /// `entry`: entry_of() its table.
  Member member(Study& study, std::size_t entry = 0) const { return where(study, entry); }
  bool has(Trait trait) const { return traits & trait; }
  unsigned variants() const { return traits & ~0xffu; }
  bool in_form(bool physical_study) const { return physical_study || !has(physical); }
  bool required_in(bool physical_study) const { return has(required) && !(physical_study && has(replaceable)); }
  const char* meaning(bool physical_study) const {
    return physical_study && sentence_in_units ? sentence_in_units : sentence;
  }
};

struct KeyTable {
  std::string name;  ///< dotted
  std::vector<Key> keys;

  bool drawn() const;  ///< whether its numbers may be distributions
  const Key* find(std::string_view key, bool physical) const;
  /// In the order of reading and naming: keys of every variant, then variant by variant.
  std::vector<Key> of(unsigned variants, bool physical) const;
  bool is_inner() const { return name.find('.') != std::string::npos; }
};
inline constexpr unsigned all_variants = ~0xffu;

/// Every line, with dotted names.
std::vector<Key> all_keys();
/// The lines by tables, in the order of the echo.
const std::vector<KeyTable>& key_tables();
/// Null if no table of a study has this dotted name. For an array of tables each entry is one: "place.2".
const KeyTable* find_keys(std::string_view table);
inline const KeyTable& key_table(std::string_view name) { return *find_keys(name); }

/// Where a dotted name is in the table of keys of this form of studies; null if nowhere. `entry`: entry_of() the table.
struct KeyPlace {
  const KeyTable* table = nullptr;
  const Key* key = nullptr;
  std::size_t entry = 0;
};
KeyPlace find_key(std::string_view dotted, bool physical);
/// The ways in which a data sheet may state what this dotted key does, itself among them; none if there is one way.
std::vector<const Key*> ways_of(std::string_view dotted);
/// The inertia of a rotor that states none.
inline double usual_inertia(const model::Parameters& p) { return p.tilts() ? model::axial_inertia(p.tilt) : 0.0; }
/// Whether the table is of the machine itself, which a data sheet states in its own terms.
inline bool is_machine(std::string_view table) {
  return table.starts_with("rotor") || table.starts_with("balancer") || table == "place";
}

unsigned variant_of(Profile profile);
unsigned variants_of(const TorqueSetting& torque);
/// Of such a table in this study; all where tables have none.
unsigned variants_in(const Study& study, std::string_view table);

/// What a number of the key must be, in a study in physical units or in a dimensionless one.
Wanted wanted_of(const Key& key, bool physical);
/// The range of a key's dimensionless value in such a study.
Range range_in(const Study& study, const Key& key);
/// Reads the key from the table into its member, which otherwise keeps its value. `required`: whatever its traits say.
void read_key(TableReader& reader, const Key& key, Study& study, bool required = false);
/// Reads the keys that the table with this dotted name, or an entry of an array of tables, has in the study's variants
/// of it.
void read_keys(TableReader& reader, std::string_view table, Study& study);
/// The same of the whole table, which may have no others.
void read_table(const StudyFile& file, const std::string& table, Study& study);
/// The member as written in a study; empty if it is not set. `physical`: of a study with scales, as quantities.
std::optional<StudyValue> value_of(const Key& key, const Study& study, std::size_t entry = 0, bool physical = false);

struct Numbers {
  std::vector<double*> places;
  Wanted wanted = any_number;
};
/// Where a study, dimensionless or a machine in SI units, keeps what a dotted key sets to one number: at one place, two
/// for both directions, or one per ball. speed.final is the final speed whatever the profile. No places for keys that
/// the study has not, and for those that hold something else.
Numbers numbers_of(Study& study, std::string_view dotted);

/// Where a study has tables of this dotted name: there, or at each entry of an array of tables, "place.1", "place.2".
std::vector<std::string> paths_of(const StudyValue& root, const std::string& name);

/// The table with this dotted name, or null.
inline StudyValue* find_table(StudyValue& root, const std::string& name) {
  StudyValue* table = root.find_path(name);
  return table && table->table() ? table : nullptr;
}

}  // namespace equipoise::study
