// Certificates as JSON: readable by people, with one line per box.
#include "equipoise/extras/proof/certify.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/report/text/json.hpp"

namespace equipoise {

namespace {

constexpr const char* format_name = "equipoise certificate 1";

// The entries of a certificate are listed once, in entries(): a Writer puts them into JSON, a Reader takes them from
// it.
class Writer {
 public:
  static constexpr bool reads = false;

  template <class Value>
  void operator()(const char* key, const Value& value) {
    json[key] = value;
  }
  template <class Values>
  void operator()(const char* key, const Values& values, std::size_t count) {
    json[key] = leading(values, static_cast<std::ptrdiff_t>(count));
  }
  void matrix(const char* key, const Eigen::MatrixXd& m, int) {
    for (const auto row : m.rowwise()) json[key].push_back(leading(row, row.size()));
  }
  // The same in X and Y.
  template <class Values>
  void alike(const char* key, const Values& values) {
    json[key] = values[0];
  }
  template <class Entries>
  void object(const char* key, const Entries& entries) {
    Writer inner;
    entries(inner);
    json[key] = inner.json;
  }
  // Whether an entry is there that only some certificates have.
  bool has(const char*, bool there) const { return there; }

  Json json;
};

// Its errors name the offending key.
class Reader {
 public:
  static constexpr bool reads = true;

  Reader(const Json& object, std::string where, std::string prefix)
      : object_(object), where_(std::move(where)), prefix_(std::move(prefix)) {
    if (!object.is_object()) fail("", "must be an object");
  }

  [[noreturn]] void fail(const std::string& key, const std::string& problem) const {
    throw InputError(where_, key.empty() ? prefix_ : prefix_ + "." + key, "", problem);
  }
  void require_positive(const char* key, double value) const {
    if (!(value > 0.0)) fail(key, "must be greater than 0");
  }
  void operator()(const char* key, double& value) const { value = as_number(member(key), key); }
  void operator()(const char* key, bool& value) const {
    const auto found = object_.find(key);
    if (found != object_.end() && !found->is_boolean()) fail(key, "must be true or false");
    value = found != object_.end() && found->get<bool>();
  }
  template <class Values>
  void operator()(const char* key, Values& values, std::size_t count) const {
    const std::vector<double> list = as_list(member(key), key, count);
    std::copy(list.begin(), list.end(), values.begin());
  }
  void matrix(const char* key, Eigen::MatrixXd& m, int size) const {
    const auto rows = lines(key, static_cast<std::size_t>(size));
    if (rows.size() != static_cast<std::size_t>(size)) fail(key, fmt::format("must have {} rows", size));
    m.resize(size, size);
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j) m(i, j) = rows[i][j];
  }
  void alike(const char* key, std::array<double, 2>& value) const { value.fill(as_number(member(key), key)); }
  void alike(const char* key, std::array<std::array<double, 2>, 2>& values) const {
    (*this)(key, values[0], 2);
    values[1] = values[0];
  }
  template <class Entries>
  void object(const char* key, const Entries& entries) const {
    entries(Reader(member(key), where_, prefix_ + "." + key));
  }
  bool has(const char* key, bool) const { return object_.contains(key); }
  std::vector<std::vector<double>> lines(const char* key, std::size_t count) const {
    const Json& array = member(key);
    if (!array.is_array()) fail(key, "must be an array of arrays of numbers");
    std::vector<std::vector<double>> result;
    for (const Json& line : array) result.push_back(as_list(line, key, count));
    return result;
  }

 private:
  const Json& member(const char* key) const {
    const auto found = object_.find(key);
    if (found == object_.end()) fail(key, "is missing");
    return *found;
  }
  double as_number(const Json& value, const char* key) const {
    if (!value.is_number() || !std::isfinite(value.get<double>())) fail(key, "must be a finite number");
    return value.get<double>();
  }
  std::vector<double> as_list(const Json& array, const char* key, std::size_t count) const {
    if (!array.is_array() || array.size() != count) fail(key, fmt::format("must be an array of {} numbers", count));
    std::vector<double> result;
    for (const Json& value : array) result.push_back(as_number(value, key));
    return result;
  }

  const Json& object_;
  std::string where_, prefix_;
};

void put_balls(Writer& a, int balls, int, int) { a("balls", balls); }
void put_balls(const Reader& a, int& balls, int fewest, int most) {
  double number = 0.0;
  a("balls", number);
  if (!(number >= fewest && number <= most && number == std::floor(number)))
    a.fail("balls", fmt::format("must be a whole number from {} to {}", fewest, most));
  balls = static_cast<int>(number);
}

template <class Archive, class Parameters>
void rotor_entries(Archive& a, Parameters& p, int fewest, int most) {
  put_balls(a, p.balls, fewest, most);
  const auto n = static_cast<std::size_t>(p.balls);
  a("eccentricity", p.eccentricity);
  a.alike("damping", p.damping);
  a.alike("stiffness", p.stiffness);
  a("mass", p.mass, n);
  a("drag", p.drag, n);
  if (a.has("rolls", p.rolls)) a("rolls", p.rolls);
  if constexpr (Archive::reads)
    for (std::size_t i = 0; i < n; ++i) a.require_positive("mass", p.mass[i]);
}

// Multipliers of a box.
std::size_t vertices_of(const Certificate& c) { return std::size_t{1} << (c.parameters.balls + (c.motor ? 1 : 0)); }

// use(number) for all numbers of a box, in the order in which they are written.
template <class Box, class Use>
void numbers_of(Box& box, const Certificate& c, const Use& use) {
  for (int k = 0; k < c.parameters.balls; ++k) {
    use(box.low[k]);
    use(box.high[k]);
  }
  for (std::size_t v = 0; v < vertices_of(c); ++v) use(box.multiplier[v]);
}

void put_boxes(Writer& a, const Certificate& c) {
  a.json["boxes"] = Json::array();
  for (const Certificate::Box& box : c.boxes) {
    Json line;
    numbers_of(box, c, [&](double number) { line.push_back(number); });
    a.json["boxes"].push_back(std::move(line));
  }
}
void put_boxes(const Reader& a, Certificate& c) {
  if (c.parameters.tilts()) return;  // needs no boxes
  for (const auto& line : a.lines("boxes", 2 * static_cast<std::size_t>(c.parameters.balls) + vertices_of(c))) {
    auto next = line.begin();
    numbers_of(c.boxes.emplace_back(), c, [&](double& number) { number = *next++; });
  }
}

template <class Archive, class Parameters>
void tilt_entries(Archive& a, Parameters& p) {
  a("eccentricity_angle", p.eccentricity_angle);
  a.object("tilt", [&](auto&& tilt) {
    tilt("transverse_inertia", p.tilt.transverse_inertia);
    if constexpr (Archive::reads) tilt.require_positive("transverse_inertia", p.tilt.transverse_inertia);
    tilt("polar_inertia", p.tilt.polar_inertia);
    tilt("misalignment", p.tilt.misalignment);
    tilt.alike("stiffness", p.tilt.stiffness);
    tilt.alike("damping", p.tilt.damping);
  });
  a("plane", p.tilt.plane, static_cast<std::size_t>(p.balls));
}

template <class Archive, class AnyCertificate>
void motor_entries(Archive& a, AnyCertificate& c) {
  auto& p = c.parameters;
  a("inertia", p.inertia);
  if constexpr (Archive::reads) {
    a.require_positive("inertia", p.inertia);
    c.motor = model::DriveSegment{.begin = 0.0, .end = std::numeric_limits<double>::infinity()};
  }
  if (p.rolls) a("ball_radius", p.ball_radius, static_cast<std::size_t>(p.balls));
  a.object("motor", [&](auto&& motor) {
    motor("constant", c.motor->constant);
    motor("slope", c.motor->slope);
    motor("integral", c.motor->integral);
    motor("aim", c.motor->aim);
    if (motor.has("limit", std::isfinite(c.motor->limit))) motor("limit", c.motor->limit);
  });
}

template <class Archive, class AnyCertificate>
void state_entries(Archive& a, AnyCertificate& c) {
  rotor_entries(a, c.parameters, 1, a.has("tilt", c.parameters.tilts()) ? 4 : 2);
  if (a.has("tilt", c.parameters.tilts())) tilt_entries(a, c.parameters);
  if (a.has("race_offset", !c.parameters.race_is_centred())) a("race_offset", c.parameters.race_offset, 2);
  if (a.has("motor", c.motor.has_value())) motor_entries(a, c);
  a("speed", c.speed);
  a("phi", c.phi, static_cast<std::size_t>(c.parameters.balls));
  a("level", c.level);
  a.matrix("form", c.form, c.system().dimension());
  a.matrix("frame", c.frame, c.system().dimension());
  put_boxes(a, c);
}

template <class Archive, class AnyCertificate>
void member_entries(Archive& a, AnyCertificate& c) {
  rotor_entries(a, c.parameters, 3, model::max_balls);
  a("speed", c.speed);
  a("phi", c.phi, static_cast<std::size_t>(c.parameters.balls));
  a("attracts", c.attracts);
  a("radius", c.radius);
  const int size = c.parameters.balls + 6;
  if (c.attracts) {
    a("rate", c.rate);
    a("least", c.least);
    a("level", c.level);
  } else {
    if constexpr (Archive::reads) c.escape.resize(size);
    a("escape", c.escape, static_cast<std::size_t>(size));
  }
  a.matrix("form", c.form, size);
}

// Ends the text, and with it the parser, once `stop` is set.
struct StoppableText {
  const char* at;
  const StopFlag* stop;

  using difference_type = std::ptrdiff_t;
  using value_type = char;
  using pointer = const char*;
  using reference = const char&;
  using iterator_category = std::input_iterator_tag;
  reference operator*() const { return *at; }
  StoppableText& operator++() {
    ++at;
    return *this;
  }
  bool operator!=(const StoppableText& end) const { return at != end.at && !is_set(stop); }
};

// The file's object. It must hold at least one certificate of either kind. Empty if stopped.
Json file_from(const std::string& text, const std::string& where, const StopFlag* stop) {
  const char* const end = text.data() + text.size();
  Json json = Json::parse(StoppableText{text.data(), stop}, StoppableText{end, stop}, nullptr, false);
  if (is_set(stop)) return Json::object();
  if (json.is_discarded())
    throw InputError(where, "", "", "is not JSON; must be a file written by equipoise certify -o");
  if (!json.is_object() || json.value("format", Json()) != format_name)
    throw InputError(where, "format", "", fmt::format("must be \"{}\"", format_name));
  const auto count = [&](const char* key) {
    const auto list = json.find(key);
    return list != json.end() && list->is_array() ? list->size() : 0;
  };
  if (count("certificates") + count("members") == 0)
    throw InputError(where, "certificates", "", "must be an array of at least one certificate");
  return json;
}

constexpr auto of_state = [](auto& archive, auto& certificate) { state_entries(archive, certificate); };
constexpr auto of_member = [](auto& archive, auto& certificate) { member_entries(archive, certificate); };

// The certificates of one of the file's arrays, if present; once `stop` is set, only the first of them.
template <class AnyCertificate, class Entries>
std::vector<AnyCertificate> list_from(const Json& file, const char* key, const std::string& where, const StopFlag* stop,
                                      const Entries& entries) {
  std::vector<AnyCertificate> result;
  const auto list = file.find(key);
  if (list == file.end()) return result;
  if (!list->is_array()) throw InputError(where, key, "", "must be an array");
  for (const Json& entry : *list) {
    if (is_set(stop)) break;
    const Reader reader(entry, where, fmt::format("{}[{}]", key, result.size()));
    entries(reader, result.emplace_back());
  }
  return result;
}

// An entry a line, and a line for each row of a table.
template <class AnyCertificate, class Entries>
std::string list_text(const std::vector<AnyCertificate>& certificates, const Entries& entries) {
  std::string text;
  for (const AnyCertificate& certificate : certificates) {
    Writer writer;
    entries(writer, certificate);
    text += text.empty() ? "\n {" : ",\n {";
    for (const auto& [key, value] : writer.json.items()) {
      text += fmt::format("{}\n  \"{}\": ", text.back() == '{' ? "" : ",", key);
      const bool table = value.is_array() && (value.empty() || value.front().is_array());
      std::string rows;
      for (std::size_t k = 0; table && k < value.size(); ++k) rows += (k ? ",\n   " : "\n   ") + value[k].dump();
      text += table ? "[" + rows + "\n  ]" : value.dump();
    }
    text += "\n }";
  }
  return "[" + text + "\n]";
}

}  // namespace

std::string certificates_json(const Certificates& certificates) {
  std::string text = fmt::format("{{\n\"format\": \"{}\",\n\"version\": \"{}\",\n\"certificates\": {}", format_name,
                                 version_string, list_text(certificates.states, of_state));
  if (!certificates.members.empty()) text += ",\n\"members\": " + list_text(certificates.members, of_member);
  return text + "\n}\n";
}

std::string certificates_json(const CertifyResult& result) {
  Certificates proved;
  for (const StateProof& state : result.states)
    if (state.certificate.level > 0.0) proved.states.push_back(state.certificate);
  for (const MemberProof& member : result.members)
    if (member.check.proved) proved.members.push_back(member.certificate);
  return proved.states.empty() && proved.members.empty() ? "" : certificates_json(proved);
}

Certificates certificates_from_json(const std::string& text, const std::string& where, const StopFlag* stop) {
  const Json file = file_from(text, where, stop);
  Certificates certificates;
  certificates.states = list_from<Certificate>(file, "certificates", where, stop, of_state);
  certificates.members = list_from<MemberCertificate>(file, "members", where, stop, of_member);
  return certificates;
}

CertificateFile checked_certificates(const std::string& text, const std::string& where, const StopFlag* stop) {
  CertificateFile file{where, {}, {}};
  Certificates read = certificates_from_json(text, where, stop);
  for (Certificate& c : read.states) file.states.emplace_back().certificate = std::move(c);
  for (MemberCertificate& c : read.members) file.members.emplace_back().certificate = std::move(c);
  for (StateProof& s : file.states) s.check = check_certificate(s.certificate, stop);
  for (MemberProof& m : file.members)
    m.check = is_set(stop) ? CertificateResult{false, stopped_before_proof} : check_member(m.certificate);
  return file;
}

}  // namespace equipoise
