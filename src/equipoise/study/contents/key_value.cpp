// Moves a key's value from a study's text into its member, and back.
#include <algorithm>
#include <limits>
#include <span>
#include <type_traits>

#include <fmt/format.h>

#include "equipoise/study/contents/keys.hpp"

namespace equipoise::study {

namespace {

constexpr char of_tilt[] = "[of a deflection and a tilt, of a tilt], or { x = [..], y = [..] }";

template <class T>
concept Enumeration = std::is_enum_v<T>;

// What [k12, k22] or [c12, c22] measure.
std::array<Dimension, 2> support_dimensions(const Key& key) {
  const bool springs = key.name == std::string_view("stiffness");
  return {springs ? Dimension::force : Dimension::tilt_damping, springs ? Dimension::torque : Dimension::gain};
}

struct KeyReading {
  TableReader& reader;
  const Key& key;
  Wanted wanted;
  int balls;

  void operator()(std::monostate) const {}
  void operator()(double* v) const { *v = reader.number(key.name, wanted); }
  void operator()(std::optional<double>* v) const { *v = reader.number(key.name, wanted); }
  void operator()(std::vector<double>* v) const { *v = reader.numbers(key.name, wanted); }
  void operator()(std::string* v) const { *v = reader.text(key.name); }
  void operator()(std::vector<std::string>* v) const { *v = reader.texts(key.name); }
  void operator()(bool* v) const { *v = reader.flag(key.name); }
  void operator()(std::array<double, 2>* v) const {
    put(key.has(Key::pair) && !reader.physical() ? two(reader, key.name, "[x, y]")
                                                 : reader.one_or_each(key.name, wanted, 2, "direction (x, y)"),
        *v);
  }
  // [k12, k22], or { x = [..], y = [..] }.
  void operator()(std::array<std::array<double, 2>, 2>* v) const {
    if (const std::optional<TableReader> each = reader.inner(key.name)) {
      TableReader directions = *each;
      for (const std::size_t d : {0, 1}) put(supports(directions, d == 0 ? "x" : "y"), (*v)[d]);
      directions.finish();
      return;
    }
    put(supports(reader, key.name), (*v)[0]);
    (*v)[1] = (*v)[0];
  }
  void operator()(std::array<double, model::max_balls>* v) const {
    put(reader.one_or_each(key.name, wanted, balls, "ball"), *v);
  }
  void operator()(std::optional<SamplingBox::Side>* v) const {
    const std::vector<double> bounds = two(reader, key.name, "[low, high]");
    if (!(bounds[0] <= bounds[1]))
      reader.fail(key.name, "bounds out of order; must be [low, high] with low at most high");
    *v = {bounds[0], bounds[1]};
  }
  template <std::integral T>
  void operator()(T* v) const {
    constexpr auto largest = std::numeric_limits<std::int64_t>::max();  // the largest TOML integer
    const std::int64_t high = key.range.high < 0x1p63 ? static_cast<std::int64_t>(key.range.high) : largest;
    *v = static_cast<T>(reader.integer(key.name, static_cast<std::int64_t>(key.range.low), high));
  }
  template <Enumeration T>
  void operator()(T* v) const {
    *v = reader.choice<T>(key.name, names_of(T{}));
  }
  template <Enumeration T>
  void operator()(std::optional<T>* v) const {
    *v = reader.choice<T>(key.name, names_of(T{}));
  }

  std::vector<double> two(TableReader& table, const char* name, const char* form) const {
    std::vector<double> entries = table.numbers(name, wanted);
    if (entries.size() != 2)
      table.fail(name, fmt::format("has {} entries; must be two finite numbers, {}", entries.size(), form));
    return entries;
  }
  // [k12, k22] or [c12, c22].
  std::vector<double> supports(TableReader& table, const char* name) const {
    if (!reader.physical()) return two(table, name, of_tilt);
    const std::array<Dimension, 2> dimensions = support_dimensions(key);
    const auto examples = [&](const char* text) {
      return fmt::format(fmt::runtime(text), study::words(dimensions[0]).example, study::words(dimensions[1]).example);
    };
    const bool both = &table == &reader;
    const StudyValue::Array* array =
        table
            .require(name,
                     both ? examples("rotor.tilt.bearings, or [\"{}\", \"{}\"], or {{ x = [..], y = [..] }}") : of_tilt)
            .array();
    if (!array || array->size() != 2)
      table.fail(name, examples("must be [\"{}\", \"{}\"], or {{ x = [..], y = [..] }}"));
    std::vector<double> entries;
    for (const Dimension dimension : dimensions)
      entries.push_back(measure_value((*array)[entries.size()], {any_number, {dimension}}, [&](const std::string& p) {
                          table.fail(name, fmt::format("entry {} {}", entries.size() + 1, p));
                        }).value);
    return entries;
  }
  template <std::size_t n>
  static void put(const std::vector<double>& from, std::array<double, n>& to) {
    std::copy(from.begin(), from.end(), to.begin());
  }
};

struct KeyEcho {
  const Key& key;
  const Study& study;
  bool physical;
  using Value = std::optional<StudyValue>;

  // The `i`-th number of the key.
  StudyValue written(double number, std::size_t i = 0) const {
    if (!physical || !key.dimension || key.dimension == Dimension::angle) return number;
    double scale = scale_of(*key.dimension, *study.scales);
    if (key.name == std::string_view("drag")) scale *= study.parameters.mass[i];  // D_i = beta_i m_i R^2 omega_c
    return quantity_text(number * scale, *key.dimension);
  }
  template <class Numbers>
  StudyValue list(const Numbers& numbers) const {
    StudyValue::Array entries;
    for (const double number : numbers) entries.push_back(written(number, entries.size()));
    return entries;
  }
  // [k12, k22] or [c12, c22].
  StudyValue support(const std::array<double, 2>& one) const {
    if (!physical) return list(one);
    StudyValue::Array entries;
    for (const Dimension d : support_dimensions(key))
      entries.push_back(quantity_text(one[entries.size()] * scale_of(d, *study.scales), d));
    return entries;
  }

  Value operator()(std::monostate) const { return {}; }
  Value operator()(const std::vector<std::string>*) const { return {}; }  // of [sweep], which is not echoed
  Value operator()(const double* v) const { return written(*v); }
  Value operator()(const std::vector<double>* v) const { return list(*v); }
  Value operator()(const std::array<double, 2>* v) const { return list(*v); }
  Value operator()(const std::array<std::array<double, 2>, 2>* v) const {
    if ((*v)[0] == (*v)[1]) return support((*v)[0]);
    return StudyValue{{"x", support((*v)[0])}, {"y", support((*v)[1])}};
  }
  // One number per ball, whatever number of balls code has set.
  Value operator()(const std::array<double, model::max_balls>* v) const {
    if (study.parameters.balls == 0) return {};
    return list(std::span(*v).first(static_cast<std::size_t>(std::clamp(study.parameters.balls, 0, model::max_balls))));
  }
  Value operator()(const std::optional<SamplingBox::Side>* v) const {
    return *v ? Value(list(std::array{(*v)->low, (*v)->high})) : Value();
  }
  Value operator()(const std::optional<double>* v) const { return *v ? Value(written(**v)) : Value(); }
  template <Enumeration T>
  Value operator()(const std::optional<T>* v) const {
    const T value = v->value_or(T{});  // what an unset value means
    return operator()(&value);
  }
  // A value that code made up has no name: its number, which no reader accepts.
  template <Enumeration T>
  Value operator()(const T* v) const {
    const auto index = static_cast<std::size_t>(*v);
    if (index < names_of(*v).size()) return names_of(*v)[index];
    return StudyValue::Other{"a number", std::to_string(static_cast<long long>(*v))};
  }
  template <class T>
  Value operator()(const T* v) const {
    return StudyValue(*v);
  }
};

// Whether a dimensionless study with such a rotor, balls and drive may state the key of a table from which starts draw.
bool may_state(const Study& study, const KeyTable& table, const Key& key) {
  const SpeedSetting& speed = study.speed;
  const std::string_view name = key.name;
  if (key.variants() && !(key.variants() & variants_in(study, table.name))) return false;
  if (table.name.starts_with("speed.") && !speed.driven()) return false;
  if (table.name == "speed.torque.target" && speed.torque.kind != model::MotorLaw::Kind::control) return false;
  if (table.name == "rotor.tilt" || name == "plane" || name == "eccentricity_angle") return study.parameters.tilts();
  return table.drawn() && (name != "ball_radius" || study.parameters.rolls);
}

}  // namespace

// Touching balls have room in the race.
Range range_in(const Study& study, const Key& key) {
  Range range = key.range;
  if (key.name == std::string_view("contact_angle")) range.high /= study.parameters.balls;
  return range;
}

Wanted wanted_of(const Key& key, bool physical) {
  if (!physical || !key.dimension) return key.range;
  std::vector<Dimension> dimensions{*key.dimension};
  if (key.other) dimensions.push_back(key.other->dimension);
  const double low = key.range.low;  // before conversion only the sign has a range
  const bool above = low > 0.0 || key.range.low_open || key.has(Key::nonzero);
  return {low < 0.0 ? any_number : above ? positive : not_negative, dimensions};
}

void read_key(TableReader& reader, const Key& key, Study& study, bool required) {
  if (!reader.has(key.name) && !key.required_in(reader.physical()) && !required) return;
  Key here = key;
  here.range = range_in(study, key);
  std::visit(KeyReading{reader, key, wanted_of(here, reader.physical()), study.parameters.balls},
             key.member(study, reader.entry()));
  if (key.other) study.sheet.*key.other->given = reader.measured() == key.other->dimension;
}

void read_keys(TableReader& reader, std::string_view table, Study& study) {
  for (const Key& key : key_table(table).of(variants_in(study, table), reader.physical())) read_key(reader, key, study);
}

void read_table(const StudyFile& file, const std::string& table, Study& study) {
  TableReader reader(file, table);
  read_keys(reader, table, study);
  reader.finish();
}

std::optional<StudyValue> value_of(const Key& key, const Study& study, std::size_t entry, bool physical) {
  const Member member = key.member(const_cast<Study&>(study), entry);  // only read here
  return std::visit([&](const auto& v) { return KeyEcho{key, study, physical}(v); }, member);
}

Numbers numbers_of(Study& study, std::string_view dotted) {
  const bool in_si = study.is_in_si();
  SpeedSetting& speed = study.speed;
  if (dotted == "speed.final" && !in_si) {
    if (speed.profile == Profile::constant) return {{&speed.speed}};
    if (speed.profile == Profile::points) return {{&speed.speeds.back()}};
    return {{&speed.final}};
  }
  const auto [table, key, entry] = find_key(dotted, in_si);
  if (!key || !(in_si ? study.states(dotted) : !key->has(Key::pair) && may_state(study, *table, *key))) return {};
  const auto balls = static_cast<std::size_t>(study.parameters.balls);
  Key here = *key;
  here.range = range_in(study, *key);
  Numbers numbers{{}, wanted_of(here, in_si)};
  std::visit(
      [&](auto member) {
        using M = decltype(member);
        if constexpr (std::is_same_v<M, double*>)
          numbers.places = {member};
        else if constexpr (std::is_same_v<M, std::optional<double>*>)
          numbers.places = *member ? std::vector<double*>{&**member} : std::vector<double*>{};
        else if constexpr (std::is_same_v<M, std::array<double, 2>*>)
          numbers.places = {&(*member)[0], &(*member)[1]};
        else if constexpr (std::is_same_v<M, std::array<double, model::max_balls>*>)
          for (std::size_t i = 0; i < balls; ++i) numbers.places.push_back(&(*member)[i]);
      },
      key->member(study, entry));
  return numbers;
}

}  // namespace equipoise::study
