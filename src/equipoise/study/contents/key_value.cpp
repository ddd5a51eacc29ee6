// Moves a key's value from a study's text into its member, and back.
#include <algorithm>
#include <limits>
#include <type_traits>

#include <fmt/format.h>

#include "equipoise/study/contents/keys.hpp"
#include "equipoise/study/words/study.hpp"

namespace equipoise::study {

namespace {

template <class T>
concept Enumeration = std::is_enum_v<T>;

struct KeyReading {
  TableReader& reader;
  const Key& key;
  int balls;

  void operator()(std::monostate) const {}
  void operator()(double* v) const { *v = reader.number(key.name, key.range); }
  void operator()(std::optional<double>* v) const { *v = reader.optional_number(key.name, key.range); }
  void operator()(std::vector<double>* v) const { *v = reader.numbers(key.name, key.range); }
  void operator()(std::vector<std::string>* v) const { *v = reader.texts(key.name); }
  void operator()(bool* v) const { *v = reader.flag(key.name, *v); }
  void operator()(std::array<double, 2>* v) const {
    put(key.has(Key::pair) ? two("[x, y]") : reader.one_or_each(key.name, key.range, 2, "direction (x, y)"), *v);
  }
  // [k12, k22], or { x = [..], y = [..] }.
  void operator()(std::array<std::array<double, 2>, 2>* v) const {
    if (const std::optional<TableReader> each = reader.inner(key.name)) {
      TableReader directions = *each;
      for (const std::size_t d : {0, 1}) {
        const char* name = d == 0 ? "x" : "y";
        const std::vector<double> entries = directions.numbers(name, key.range);
        if (entries.size() != 2)
          directions.fail(name, fmt::format(words::study::two_numbers, entries.size(), words::study::of_tilt));
        put(entries, (*v)[d]);
      }
      directions.finish();
      return;
    }
    put(two(words::study::of_tilt), (*v)[0]);
    (*v)[1] = (*v)[0];
  }
  void operator()(std::array<double, model::max_balls>* v) const {
    put(reader.one_or_each(key.name, key.range, balls, "ball"), *v);
  }
  void operator()(std::optional<SamplingBox::Side>* v) const {
    const std::vector<double> bounds = two("[low, high]");
    if (!(bounds[0] <= bounds[1])) reader.fail(key.name, words::study::bounds_out_of_order);
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

  std::vector<double> two(const char* form) const {
    std::vector<double> entries = reader.numbers(key.name, key.range);
    if (entries.size() != 2) reader.fail(key.name, fmt::format(words::study::two_numbers, entries.size(), form));
    return entries;
  }
  template <std::size_t n>
  static void put(const std::vector<double>& from, std::array<double, n>& to) {
    std::copy(from.begin(), from.end(), to.begin());
  }
};

struct KeyEcho {
  int balls;
  using Value = std::optional<StudyValue>;

  Value operator()(std::monostate) const { return {}; }
  Value operator()(const std::vector<std::string>*) const { return {}; }  // of [sweep], which is not echoed
  Value operator()(const std::array<double, 2>* v) const { return std::vector<double>(v->begin(), v->end()); }
  Value operator()(const std::array<std::array<double, 2>, 2>* v) const {
    const auto pair = [](const std::array<double, 2>& one) {
      return StudyValue(std::vector<double>(one.begin(), one.end()));
    };
    if ((*v)[0] == (*v)[1]) return pair((*v)[0]);
    StudyValue each;
    each.set("x", pair((*v)[0]));
    each.set("y", pair((*v)[1]));
    return each;
  }
  // One number per ball, whatever number of balls code has set.
  Value operator()(const std::array<double, model::max_balls>* v) const {
    if (balls == 0) return {};
    return std::vector<double>(v->begin(), v->begin() + std::clamp(balls, 0, model::max_balls));
  }
  Value operator()(const std::optional<SamplingBox::Side>* v) const {
    return *v ? Value(std::vector<double>{(*v)->low, (*v)->high}) : Value();
  }
  Value operator()(const std::optional<double>* v) const { return *v ? Value(**v) : Value(); }
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

// Balls that touch have room in the race.
Range range_in(const Study& study, const Key& key) {
  Range range = key.range;
  if (key.name == std::string_view("contact_angle")) range.high /= study.parameters.balls;
  return range;
}

// Whether a study with such a rotor, balls and drive may state the key of a table from which starts draw.
bool may_state(const Study& study, const KeyTable& table, const Key& key) {
  const SpeedSetting& speed = study.speed;
  const std::string_view name = key.name;
  if (table.name == "speed") return !key.variants() || key.variants() & variant_of(speed.profile);
  if (table.name == "speed.torque") return speed.driven() && key.variants() & variants_of(speed.torque);
  if (table.name == "speed.torque.target") return false;  // its keys name members of [speed]
  if (table.name == "speed.load") return speed.driven();
  if (table.name == "rotor.tilt" || name == "plane" || name == "eccentricity_angle") return study.parameters.tilts();
  return table.drawn() && (name != "ball_radius" || study.parameters.rolls);
}

}  // namespace

void read_key(TableReader& reader, const Key& key, Study& study) {
  Key here = key;
  here.range = range_in(study, key);
  if (reader.has(key.name) || key.has(Key::required))
    std::visit(KeyReading{reader, here, study.parameters.balls}, key.member(study));
}

void read_keys(TableReader& reader, const char* table, unsigned variants, Study& study) {
  for (const Key& key : key_table(table).of(variants, false)) read_key(reader, key, study);
}

std::optional<StudyValue> value_of(const Key& key, const Study& study) {
  const Member member = key.member(const_cast<Study&>(study));  // only read here
  return std::visit([&](const auto& v) { return KeyEcho{study.parameters.balls}(v); }, member);
}

Numbers numbers_of(Study& study, std::string_view dotted) {
  SpeedSetting& speed = study.speed;
  if (dotted == "speed.final" && speed.profile == Profile::constant) return {{&speed.speed}};
  if (dotted == "speed.final" && speed.profile == Profile::points) return {{&speed.speeds.back()}};
  if (dotted == "speed.final") return {{&speed.final}};
  const std::size_t dot = std::min(dotted.rfind('.'), dotted.size());
  const KeyTable* table = find_keys(dotted.substr(0, dot));
  const Key* key = table && dot < dotted.size() ? table->find(dotted.substr(dot + 1), false) : nullptr;
  if (!key || key->has(Key::pair) || !may_state(study, *table, *key)) return {};
  const auto balls = static_cast<std::size_t>(study.parameters.balls);
  Numbers numbers{{}, range_in(study, *key)};
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
      key->member(study));
  return numbers;
}

}  // namespace equipoise::study
