// SweepCell and CapacityTrial to CBOR and back: a map of the members by name.
#include "equipoise/store/sweep_cells.hpp"

#include <nlohmann/json.hpp>

namespace equipoise {

namespace {

using Json = nlohmann::json;

// One function names the members for both ways.
class Writer {
 public:
  template <class T>
  void operator()(const char* name, const T& value) {
    json_[name] = encode(value);
  }
  Json take() { return std::move(json_); }

  template <class T>
  static Json encode(const T& value);

 private:
  Json json_ = Json::object();
};

class Reader {
 public:
  explicit Reader(const Json& json) : json_(json) {}
  template <class T>
  void operator()(const char* name, T& value) {
    decode(json_.at(name), value);
  }

  template <class T>
  static void decode(const Json& json, T& value);

 private:
  const Json& json_;
};

template <class Visitor, class S>
requires std::is_same_v<std::remove_const_t<S>, Share>
void visit_members(Visitor&& v, S& s) {
  v("count", s.count);
  v("total", s.total);
  v("share", s.share);
  v("low", s.low);
  v("high", s.high);
  v("by", s.by);
  v("error", s.standard_error);
  v("effective", s.effective_starts);
  v("least", s.least);
  v("most", s.most);
}

template <class Visitor, class S>
requires std::is_same_v<std::remove_const_t<S>, QuantileEstimate>
void visit_members(Visitor&& v, S& s) {
  v("value", s.value);
  v("low", s.low);
  v("high", s.high);
}

template <class Visitor, class S>
requires std::is_same_v<std::remove_const_t<S>, SampleSummary>
void visit_members(Visitor&& v, S& s) {
  v("count", s.count);
  v("open", s.open);
  v("mean", s.mean);
  v("mean_low", s.mean_low);
  v("mean_high", s.mean_high);
  v("largest", s.largest);
  v("quantiles", s.quantiles);
  v("exact", s.exact);
}

template <class Visitor, class S>
requires std::is_same_v<std::remove_const_t<S>, TransientGroup>
void visit_members(Visitor&& v, S& s) {
  v("name", s.name);
  v("id", s.id);
  v("starts", s.starts);
  v("mean_speed", s.mean_speed);
  v("lasting", s.lasting);
  v("never", s.never);
  v("figures", s.figures);
  v("exceeded", s.exceeded);
}

template <class Visitor, class S>
requires std::is_same_v<std::remove_const_t<S>, SweepOutcome>
void visit_members(Visitor&& v, S& s) {
  v("id", s.id);
  v("own_id", s.own_id);
  v("name", s.name);
  v("alias", s.alias);
  v("kind", s.kind);
  v("share", s.share);
  v("mean_time", s.mean_time);
  v("r_min", s.r_min);
  v("r_mean", s.r_mean);
  v("r_max", s.r_max);
  v("period", s.period);
  v("drift", s.drift);
  v("left_unbalance", s.unbalance);
  v("state", s.state);
}

template <class Visitor, class S>
requires std::is_same_v<std::remove_const_t<S>, LevelHint>
void visit_members(Visitor&& v, S& s) {
  v("attractor", s.attractor);
  v("torus", s.torus);
  v("level", s.level);
}

template <class Visitor, class S>
requires std::is_same_v<std::remove_const_t<S>, ModeWeight>
void visit_members(Visitor&& v, S& s) {
  v("re", s.re);
  v("im", s.im);
  v("weight", s.weight);
}

template <class Visitor, class S>
requires std::is_same_v<std::remove_const_t<S>, SweepCell>
void visit_members(Visitor&& v, S& s) {
  v("starts", s.starts);
  v("outcomes", s.outcomes);
  v("undecided", s.undecided);
  v("diverged", s.diverged);
  v("failed", s.failed);
  v("stalled", s.stalled);
  v("passed", s.passed);
  v("transients", s.transients);
  v("balanced_stable", s.balanced_stable);
  v("note", s.note);
  v("levels", s.hints.levels);
  v("weights", s.hints.weights);
}

template <class Visitor, class S>
requires std::is_same_v<std::remove_const_t<S>, CapacityTrial>
void visit_members(Visitor&& v, S& s) {
  v("value", s.value);
  v("balanced", s.balanced);
  v("undecided", s.undecided);
  v("unstable", s.unstable);
  v("states", s.states);
}

template <class T>
struct IsList : std::false_type {};
template <class T>
struct IsList<std::vector<T>> : std::true_type {};
template <class T, std::size_t n>
struct IsList<std::array<T, n>> : std::true_type {};
template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <class T>
struct IsShared : std::false_type {};
template <class T>
struct IsShared<std::shared_ptr<T>> : std::true_type {};

template <class T>
Json Writer::encode(const T& value) {
  if constexpr (IsOptional<T>::value || IsShared<T>::value) {
    return value ? encode(*value) : Json(nullptr);
  } else if constexpr (IsList<T>::value) {
    Json list = Json::array();
    for (const auto& item : value) list.push_back(encode(item));
    return list;
  } else if constexpr (std::is_enum_v<T>) {
    return static_cast<int>(value);
  } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
    return value;
  } else {
    Writer members;
    visit_members(members, value);
    return members.take();
  }
}

template <class T>
void Reader::decode(const Json& json, T& value) {
  if constexpr (IsShared<T>::value) {
    auto content = json.is_null() ? nullptr : std::make_shared<std::remove_const_t<typename T::element_type>>();
    if (content) decode(json, *content);
    value = std::move(content);
  } else if constexpr (IsOptional<T>::value) {
    if (json.is_null())
      value.reset();
    else
      decode(json, value.emplace());
  } else if constexpr (IsList<T>::value) {
    if constexpr (requires { value.resize(0); }) value.resize(json.size());
    for (std::size_t i = 0; i < value.size(); ++i) decode(json.at(i), value[i]);
  } else if constexpr (std::is_enum_v<T>) {
    value = static_cast<T>(json.get<int>());
  } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
    value = json.get<T>();
  } else {
    visit_members(Reader(json), value);
  }
}

template <class T>
std::optional<T> read_as(const std::uint8_t* bytes, std::size_t count) {
  try {
    T value;
    Reader::decode(Json::from_cbor(bytes, bytes + count), value);
    return value;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace

namespace store {

std::vector<std::uint8_t> bytes_of(const SweepCell& cell) { return Json::to_cbor(Writer::encode(cell)); }

std::optional<SweepCell> cell_from(const std::uint8_t* bytes, std::size_t count) {
  return read_as<SweepCell>(bytes, count);
}

std::vector<std::uint8_t> bytes_of(const std::vector<CapacityTrial>& trials) {
  return Json::to_cbor(Writer::encode(trials));
}

std::optional<std::vector<CapacityTrial>> trials_from(const std::vector<std::uint8_t>& bytes) {
  return read_as<std::vector<CapacityTrial>>(bytes.data(), bytes.size());
}

}  // namespace store
}  // namespace equipoise
