// Converts records of cells to CBOR and back: maps of members by name.
#include "equipoise/results/cell_files/sweep_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "equipoise/core/base/bytes.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/results/result_files/basin_outcomes.hpp"

namespace equipoise {

// One function names the members for writing and reading.

template <class Record, Like<Share> T>
void named_members(Record& r, T& s) {
  r("count", s.count, "total", s.total, "share", s.share, "low", s.low, "high", s.high, "by", s.by);
  r("error", s.standard_error, "effective", s.effective_starts, "least", s.least, "most", s.most);
}

template <class Record, Like<Estimate> T>
void named_members(Record& r, T& e) {
  r("value", e.value, "low", e.low, "high", e.high);
}

template <class Record, Like<SampleSummary> T>
void named_members(Record& r, T& s) {
  r("count", s.count, "open", s.open, "mean", s.mean, "mean_low", s.mean_low, "mean_high", s.mean_high);
  r("largest", s.largest, "quantiles", s.quantiles, "exact", s.exact);
}

template <class Record, Like<TransientGroup> T>
void named_members(Record& r, T& g) {
  r("name", g.name, "id", g.id, "starts", g.starts, "mean_speed", g.mean_speed, "lasting", g.lasting);
  r("never", g.never, "figures", g.figures, "exceeded", g.exceeded, "within", g.within);
}

template <class Record, Like<SweepOutcome> T>
void named_members(Record& r, T& o) {
  r("id", o.id, "own_id", o.own_id, "name", o.name, "alias", o.alias, "kind", o.kind, "share", o.share);
  r("mean_time", o.mean_time, "r_min", o.r_min, "r_mean", o.r_mean, "r_max", o.r_max, "period", o.period);
  r("drift", o.drift, "left_unbalance", o.unbalance, "state", o.state);
}

template <class Record, Like<WarmStartLevel> T>
void named_members(Record& r, T& h) {
  r("attractor", h.attractor, "level", h.level);
}

template <class Record, Like<ModeWeight> T>
void named_members(Record& r, T& w) {
  r("re", w.re, "im", w.im, "weight", w.weight);
}

template <class Record, Like<SweepCell> T>
void named_members(Record& r, T& c) {
  r("starts", c.starts, "outcomes", c.outcomes, "undecided", c.undecided, "diverged", c.diverged, "failed", c.failed);
  r("stalled", c.stalled, "passed", c.passed, "transients", c.transients, "balanced_stable", c.balanced_stable);
  r("note", c.note, "levels", c.warm_start_levels.levels, "weights", c.warm_start_levels.weights);
}

template <class Record, Like<CapacityTrial> T>
void named_members(Record& r, T& t) {
  r("value", t.value, "balanced", t.balanced, "undecided", t.undecided, "unstable", t.unstable, "states", t.states);
}

template <class Record, Like<KeptSample> T>
void named_members(Record& r, T& k) {
  r("name", k.name, "starts", k.sample.starts, "figures", k.sample.figures, "undecided", k.sample.undecided);
  r("note", k.sample.note);
}

namespace {

constexpr char wrong_length[] = "has {} entries instead of {}";

using Json = nlohmann::json;

template <class T>
inline constexpr bool is_list =
    !std::is_same_v<T, std::string> && (bytes_detail::is_list<T> || bytes_detail::is_array<T>);
template <class T>
inline constexpr bool is_shared = false;
template <class T>
inline constexpr bool is_shared<std::shared_ptr<T>> = true;

class RecordOut {
 public:
  template <class T, class... More>
  void operator()(const char* name, const T& value, const More&... more) {
    json_[name] = encode(value);
    if constexpr (sizeof...(more) > 0) (*this)(more...);
  }

  template <class T>
  static Json encode(const T& value) {
    if constexpr (bytes_detail::is_optional<T> || is_shared<T>) {
      return value ? encode(*value) : Json(nullptr);
    } else if constexpr (is_list<T>) {
      Json list = Json::array();
      for (const auto& item : value) list.push_back(encode(item));
      return list;
    } else if constexpr (std::is_enum_v<T>) {
      return static_cast<int>(value);
    } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      return value;
    } else {
      RecordOut record;
      named_members(record, value);
      return std::move(record.json_);
    }
  }

 private:
  Json json_ = Json::object();
};

// Why bytes are no record, and where in it.
struct Unreadable {
  std::string place, problem;
};

std::string inside(const std::string& place, const char* member) {
  return place.empty() ? member : place + "." + member;
}

// Every enumeration that records hold, by its last value.
constexpr IntervalBy last_of(IntervalBy) { return static_cast<IntervalBy>(interval_names.size() - 1); }

// What a record must be in addition to what its types say.
void require(const Share& s, const std::string& place) {
  for (const auto& [name, share] :
       {std::pair{"share", s.share}, {"low", s.low}, {"high", s.high}, {"least", s.least}, {"most", s.most}})
    if (const std::string fault = io::fault_of_share(share); !fault.empty())
      throw Unreadable{inside(place, name), fault};
}
void require(const SweepOutcome& o, const std::string& place) {
  if (!o.unbalance.empty() && o.unbalance.size() != unbalance_quantiles.size())
    throw Unreadable{inside(place, "left_unbalance"),
                     fmt::format(wrong_length, o.unbalance.size(), unbalance_quantiles.size())};
  std::vector<double> figures{o.mean_time, o.r_min.value_or(0.0), o.r_mean.value_or(0.0), o.r_max.value_or(0.0),
                              o.period};
  for (const auto* more : {&o.drift, &o.unbalance, &o.state}) figures.insert(figures.end(), more->begin(), more->end());
  if (!std::all_of(figures.begin(), figures.end(), [](double figure) { return std::isfinite(figure); }))
    throw Unreadable{place, "has a figure that is not finite"};
}
void require(const SweepCell& c, const std::string& place) {
  if (c.outcomes.empty()) throw Unreadable{inside(place, "outcomes"), "has no entries"};
}
template <class T>
void require(const T&, const std::string&) {}

class RecordIn {
 public:
  RecordIn(const Json& json, const std::string& place) : json_(json), place_(place) {
    if (!json.is_object()) throw Unreadable{place, "has no members"};
  }
  template <class T, class... More>
  void operator()(const char* name, T& value, More&&... more) {
    const auto member = json_.find(name);
    const std::string place = inside(place_, name);
    if (member == json_.end()) throw Unreadable{place, "is missing"};
    decode(*member, value, place);
    if constexpr (sizeof...(more) > 0) (*this)(more...);
  }

  template <class T>
  static void decode(const Json& json, T& value, const std::string& place) {
    if constexpr (is_shared<T>) {
      auto content = json.is_null() ? nullptr : std::make_shared<std::remove_const_t<typename T::element_type>>();
      if (content) decode(json, *content, place);
      value = std::move(content);
    } else if constexpr (bytes_detail::is_optional<T>) {
      value.reset();
      if (!json.is_null()) decode(json, value.emplace(), place);
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (!json.is_string()) throw Unreadable{place, "is no text"};
      value = display_text(json.get_ref<const std::string&>());
    } else if constexpr (is_list<T>) {
      decode_list(json, value, place);
    } else if constexpr (std::is_enum_v<T>) {
      int number = 0;
      decode(json, number, place);
      if (number < 0 || number > static_cast<int>(last_of(T{}))) throw Unreadable{place, out_of_range(json)};
      value = static_cast<T>(number);
    } else if constexpr (std::is_same_v<T, bool>) {
      if (!json.is_boolean()) throw Unreadable{place, "is neither true nor false"};
      value = json.get<bool>();
    } else if constexpr (std::is_integral_v<T>) {
      decode_integer(json, value, place);
    } else if constexpr (std::is_arithmetic_v<T>) {
      if (!json.is_number()) throw Unreadable{place, "is no number"};
      value = json.get<T>();
    } else {
      RecordIn record(json, place);
      named_members(record, value);
      require(value, place);
    }
  }

 private:
  static std::string out_of_range(const Json& json) { return fmt::format("is out of range: {}", json.dump()); }

  template <class T>
  static void decode_integer(const Json& json, T& value, const std::string& place) {
    if (!json.is_number_integer()) throw Unreadable{place, "is no integer"};
    const bool fits = json.is_number_unsigned() ? std::in_range<T>(json.get<std::uint64_t>())
                                                : std::in_range<T>(json.get<std::int64_t>());
    if (!fits) throw Unreadable{place, out_of_range(json)};
    value = json.get<T>();
  }

  // Lists grow with what was read: a forged length takes no memory.
  template <class T>
  static void decode_list(const Json& json, T& list, const std::string& place) {
    if (!json.is_array()) throw Unreadable{place, "is no list"};
    const auto at = [&](std::size_t i) { return fmt::format("{}[{}]", place, i); };
    if constexpr (requires { list.emplace_back(); }) {
      list.clear();
      for (std::size_t i = 0; i < json.size(); ++i) decode(json[i], list.emplace_back(), at(i));
    } else {
      if (json.size() != list.size()) throw Unreadable{place, fmt::format(wrong_length, json.size(), list.size())};
      for (std::size_t i = 0; i < list.size(); ++i) decode(json[i], list[i], at(i));
    }
  }

  const Json& json_;
  const std::string place_;
};

// Reads CBOR only as deep as records are nested: a reader that followed every level would run out of stack.
class Shallow : public nlohmann::json_sax<Json> {
 public:
  bool exceeded() const { return depth_ > deepest; }
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool key(string_t&) override { return true; }
  bool start_object(std::size_t) override { return ++depth_ <= deepest; }
  bool start_array(std::size_t) override { return ++depth_ <= deepest; }
  bool end_object() override { return --depth_ >= 0; }
  bool end_array() override { return --depth_ >= 0; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

 private:
  static constexpr int deepest = 16;
  int depth_ = 0;
};

template <class T>
T record_from(const std::vector<std::uint8_t>& bytes) {
  Shallow shallow;
  (void)Json::sax_parse(bytes, &shallow, Json::input_format_t::cbor);
  if (shallow.exceeded()) throw RunError("is nested too deeply");
  try {
    T value;
    RecordIn::decode(Json::from_cbor(bytes), value, "");
    return value;
  } catch (const Json::exception&) {
    throw RunError("is not a record");
  } catch (const Unreadable& why) {
    throw RunError(why.place.empty() ? why.problem : why.place + " " + why.problem);
  }
}

}  // namespace

namespace io {

std::vector<std::uint8_t> bytes_of(const SweepCell& cell) { return Json::to_cbor(RecordOut::encode(cell)); }
std::vector<std::uint8_t> bytes_of(const std::vector<CapacityTrial>& trials) {
  return Json::to_cbor(RecordOut::encode(trials));
}
std::vector<std::uint8_t> bytes_of(const KeptSample& sample) { return Json::to_cbor(RecordOut::encode(sample)); }

SweepCell cell_from(const std::vector<std::uint8_t>& bytes) { return record_from<SweepCell>(bytes); }
std::vector<CapacityTrial> trials_from(const std::vector<std::uint8_t>& bytes) {
  return record_from<std::vector<CapacityTrial>>(bytes);
}
KeptSample sample_from(const std::vector<std::uint8_t>& bytes) { return record_from<KeptSample>(bytes); }

}  // namespace io
}  // namespace equipoise
