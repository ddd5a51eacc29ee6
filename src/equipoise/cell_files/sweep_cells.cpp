// Converts records of cells to CBOR and back: maps of members by name.
#include "equipoise/cell_files/sweep_cells.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include <nlohmann/json.hpp>

#include "equipoise/base/bytes.hpp"

namespace equipoise {

// One function names the members for writing and reading.

template <class Record, Like<Share> T>
void named_members(Record& r, T& s) {
  r("count", s.count, "total", s.total, "share", s.share, "low", s.low, "high", s.high, "by", s.by);
  r("error", s.standard_error, "effective", s.effective_starts, "least", s.least, "most", s.most);
}

template <class Record, Like<QuantileEstimate> T>
void named_members(Record& r, T& q) {
  r("value", q.value, "low", q.low, "high", q.high);
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
  r("attractor", h.attractor, "torus", h.torus, "level", h.level);
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

using Json = nlohmann::json;

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;
template <class T, std::size_t n>
inline constexpr bool is_list<std::array<T, n>> = true;
template <class T>
inline constexpr bool is_shared = false;
template <class T>
inline constexpr bool is_shared<std::shared_ptr<T>> = true;

// For designs. Infinite values are written as words, because JSON has no number for them.
Json number_json(double v) {
  if (std::isnan(v)) return nullptr;
  return std::isfinite(v) ? Json(v) : Json(v > 0.0 ? "inf" : "-inf");
}
double number_from(const Json& j) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (j.is_null()) return std::numeric_limits<double>::quiet_NaN();
  return j.is_number() ? j.get<double>() : j.get<std::string>() == "inf" ? infinite : -infinite;
}

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
    } else if constexpr (std::is_same_v<T, DesignEstimate>) {
      return {number_json(value.value), number_json(value.low), number_json(value.high)};
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

class RecordIn {
 public:
  explicit RecordIn(const Json& json) : json_(json) {}
  template <class T, class... More>
  void operator()(const char* name, T& value, More&&... more) {
    decode(json_.at(name), value);
    if constexpr (sizeof...(more) > 0) (*this)(more...);
  }

  template <class T>
  static void decode(const Json& json, T& value) {
    if constexpr (is_shared<T>) {
      auto content = json.is_null() ? nullptr : std::make_shared<std::remove_const_t<typename T::element_type>>();
      if (content) decode(json, *content);
      value = std::move(content);
    } else if constexpr (bytes_detail::is_optional<T>) {
      value.reset();
      if (!json.is_null()) decode(json, value.emplace());
    } else if constexpr (is_list<T>) {
      if constexpr (requires { value.resize(0); }) value.resize(json.size());
      for (std::size_t i = 0; i < value.size(); ++i) decode(json.at(i), value[i]);
    } else if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(json.get<int>());
    } else if constexpr (std::is_same_v<T, DesignEstimate>) {
      value = {number_from(json.at(0)), number_from(json.at(1)), number_from(json.at(2))};
    } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      value = json.get<T>();
    } else {
      RecordIn record(json);
      named_members(record, value);
    }
  }

 private:
  const Json& json_;
};

template <class T>
std::optional<T> record_from(const std::vector<std::uint8_t>& bytes) {
  try {
    T value;
    RecordIn::decode(Json::from_cbor(bytes), value);
    return value;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace

namespace io {

std::vector<std::uint8_t> bytes_of(const SweepCell& cell) { return Json::to_cbor(RecordOut::encode(cell)); }
std::vector<std::uint8_t> bytes_of(const std::vector<CapacityTrial>& trials) {
  return Json::to_cbor(RecordOut::encode(trials));
}
std::vector<std::uint8_t> bytes_of(const KeptSample& sample) { return Json::to_cbor(RecordOut::encode(sample)); }

std::optional<SweepCell> cell_from(const std::vector<std::uint8_t>& bytes) { return record_from<SweepCell>(bytes); }
std::optional<std::vector<CapacityTrial>> trials_from(const std::vector<std::uint8_t>& bytes) {
  return record_from<std::vector<CapacityTrial>>(bytes);
}
std::optional<KeptSample> sample_from(const std::vector<std::uint8_t>& bytes) { return record_from<KeptSample>(bytes); }

}  // namespace io
}  // namespace equipoise
