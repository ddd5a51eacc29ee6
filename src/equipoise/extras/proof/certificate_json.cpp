// Certificates as JSON: readable by people, with one line per box.
#include "equipoise/extras/proof/certify_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "equipoise/classification/words/proof.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/report/words/reports.hpp"

namespace equipoise {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* format_name = "equipoise certificate 1";

// nlohmann/json writes the shortest text that reads back to the same double.
template <class Values>
std::string numbers(const Values& values, std::size_t count) {
  Json list = Json::array();
  for (std::size_t i = 0; i < count; ++i) list.push_back(values[i]);
  return list.dump();
}

std::string rows(const Eigen::MatrixXd& m) {
  std::string text = "[";
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    const Eigen::VectorXd row = m.row(i);
    text += (i ? ",\n   " : "\n   ") + numbers(row, static_cast<std::size_t>(row.size()));
  }
  return text + "\n  ]";
}

// Multipliers of a box.
std::size_t vertices_of(const Certificate& c) { return std::size_t{1} << (c.parameters.balls + (c.motor ? 1 : 0)); }

// Entries only for a driven rotor, or for an off-centre race.
std::string machine_text(const Certificate& c) {
  const model::Parameters& p = c.parameters;
  std::string text;
  if (!p.race_is_centred()) text += fmt::format("  \"race_offset\": {},\n", numbers(p.race_offset, 2));
  if (!c.motor) return text;
  text += fmt::format("  \"inertia\": {},\n", Json(p.inertia).dump());
  if (p.rolls)
    text += fmt::format("  \"ball_radius\": {},\n", numbers(p.ball_radius, static_cast<std::size_t>(p.balls)));
  Json motor{{"constant", c.motor->constant},
             {"slope", c.motor->slope},
             {"integral", c.motor->integral},
             {"aim", c.motor->aim}};
  if (std::isfinite(c.motor->limit)) motor["limit"] = c.motor->limit;
  return text + fmt::format("  \"motor\": {},\n", motor.dump());
}

// Of a rotor that tilts; its supports are alike in X and Y.
std::string tilt_text(const model::Parameters& p) {
  if (!p.tilts()) return "";
  const Json tilt{{"transverse_inertia", p.tilt.transverse_inertia},
                  {"polar_inertia", p.tilt.polar_inertia},
                  {"misalignment", p.tilt.misalignment},
                  {"stiffness", p.tilt.stiffness[0]},
                  {"damping", p.tilt.damping[0]}};
  return fmt::format("  \"eccentricity_angle\": {},\n  \"tilt\": {},\n  \"plane\": {},\n",
                     Json(p.eccentricity_angle).dump(), tilt.dump(),
                     numbers(p.tilt.plane, static_cast<std::size_t>(p.balls)));
}

std::string rotor_text(const model::Parameters& p) {
  const auto n = static_cast<std::size_t>(p.balls);
  std::string text;
  text += fmt::format("  \"balls\": {},\n", p.balls);
  text += fmt::format("  \"eccentricity\": {},\n", Json(p.eccentricity).dump());
  text += fmt::format("  \"damping\": {},\n", Json(p.damping[0]).dump());
  text += fmt::format("  \"stiffness\": {},\n", Json(p.stiffness[0]).dump());
  text += fmt::format("  \"mass\": {},\n", numbers(p.mass, n));
  text += fmt::format("  \"drag\": {},\n", numbers(p.drag, n));
  if (p.rolls) text += "  \"rolls\": true,\n";
  return text;
}

std::string certificate_text(const Certificate& c) {
  const auto n = static_cast<std::size_t>(c.parameters.balls), vertices = vertices_of(c);
  std::string text = " {\n" + rotor_text(c.parameters) + tilt_text(c.parameters) + machine_text(c);
  text += fmt::format("  \"speed\": {},\n", Json(c.speed).dump());
  text += fmt::format("  \"phi\": {},\n", numbers(c.phi, n));
  text += fmt::format("  \"level\": {},\n", Json(c.level).dump());
  text += fmt::format("  \"form\": {},\n", rows(c.form));
  text += fmt::format("  \"frame\": {},\n", rows(c.frame));
  text += "  \"boxes\": [";
  for (std::size_t i = 0; i < c.boxes.size(); ++i) {
    std::vector<double> line;
    for (std::size_t k = 0; k < n; ++k) {
      line.push_back(c.boxes[i].low[k]);
      line.push_back(c.boxes[i].high[k]);
    }
    line.insert(line.end(), c.boxes[i].multiplier.begin(), c.boxes[i].multiplier.begin() + vertices);
    text += (i ? ",\n   " : "\n   ") + numbers(line, line.size());
  }
  return text + "\n  ]\n }";
}

std::string member_text(const MemberCertificate& c) {
  std::string text = " {\n" + rotor_text(c.parameters);
  text += fmt::format("  \"speed\": {},\n", Json(c.speed).dump());
  text += fmt::format("  \"phi\": {},\n", numbers(c.phi, static_cast<std::size_t>(c.parameters.balls)));
  text += fmt::format("  \"attracts\": {},\n", c.attracts);
  text += fmt::format("  \"radius\": {},\n", Json(c.radius).dump());
  if (c.attracts)
    text += fmt::format("  \"rate\": {},\n  \"least\": {},\n  \"level\": {},\n", Json(c.rate).dump(),
                        Json(c.least).dump(), Json(c.level).dump());
  else
    text += fmt::format("  \"escape\": {},\n", numbers(c.escape, static_cast<std::size_t>(c.escape.size())));
  return text + fmt::format("  \"form\": {}\n }}", rows(c.form));
}

// Reads one certificate; errors name the offending key.
class Reader {
 public:
  Reader(const Json& object, std::string where, std::string prefix)
      : object_(object), where_(std::move(where)), prefix_(std::move(prefix)) {
    if (!object.is_object()) fail("", words::reports::must_be_object);
  }

  [[noreturn]] void fail(const std::string& key, const std::string& problem) const {
    throw InputError(where_, key.empty() ? prefix_ : prefix_ + "." + key, "", problem);
  }
  double number(const std::string& key) const { return as_number(member(key), key); }
  bool has(const std::string& key) const { return object_.contains(key); }
  Reader object(const std::string& key) const { return {member(key), where_, prefix_ + "." + key}; }
  bool flag(const std::string& key) const {
    const auto found = object_.find(key);
    if (found == object_.end()) return false;
    if (!found->is_boolean()) fail(key, words::reports::must_be_true_or_false);
    return found->get<bool>();
  }
  std::vector<double> list(const std::string& key, std::size_t count) const { return as_list(member(key), key, count); }
  Eigen::MatrixXd matrix(const std::string& key, int size) const {
    const auto values = lists(key, static_cast<std::size_t>(size));
    if (values.size() != static_cast<std::size_t>(size)) fail(key, fmt::format(words::reports::must_have_rows, size));
    Eigen::MatrixXd result(size, size);
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j) result(i, j) = values[i][j];
    return result;
  }
  std::vector<std::vector<double>> lists(const std::string& key, std::size_t count) const {
    const Json& array = member(key);
    if (!array.is_array()) fail(key, words::reports::must_be_lists_of_numbers);
    std::vector<std::vector<double>> result;
    for (const Json& row : array) result.push_back(as_list(row, key, count));
    return result;
  }

 private:
  const Json& member(const std::string& key) const {
    const auto found = object_.find(key);
    if (found == object_.end()) fail(key, words::reports::is_missing);
    return *found;
  }
  double as_number(const Json& value, const std::string& key) const {
    if (!value.is_number() || !std::isfinite(value.get<double>())) fail(key, words::reports::must_be_finite);
    return value.get<double>();
  }
  std::vector<double> as_list(const Json& array, const std::string& key, std::size_t count) const {
    if (!array.is_array() || array.size() != count) fail(key, fmt::format(words::reports::must_be_numbers, count));
    std::vector<double> result;
    for (const Json& value : array) result.push_back(as_number(value, key));
    return result;
  }

  const Json& object_;
  std::string where_, prefix_;
};

void read_tilt(const Reader& r, model::Parameters& p) {
  if (!r.has("tilt")) return;
  const Reader tilt = r.object("tilt");
  p.eccentricity_angle = r.number("eccentricity_angle");
  p.tilt.transverse_inertia = tilt.number("transverse_inertia");
  if (!(p.tilt.transverse_inertia > 0.0)) tilt.fail("transverse_inertia", words::reports::must_be_positive);
  p.tilt.polar_inertia = tilt.number("polar_inertia");
  p.tilt.misalignment = tilt.number("misalignment");
  const std::vector<double> stiffness = tilt.list("stiffness", 2), damping = tilt.list("damping", 2),
                            plane = r.list("plane", static_cast<std::size_t>(p.balls));
  p.tilt.stiffness.fill({stiffness[0], stiffness[1]});
  p.tilt.damping.fill({damping[0], damping[1]});
  std::copy(plane.begin(), plane.end(), p.tilt.plane.begin());
}

void read_machine(const Reader& r, Certificate& c) {
  model::Parameters& p = c.parameters;
  read_tilt(r, p);
  if (r.has("race_offset")) {
    const std::vector<double> offset = r.list("race_offset", 2);
    p.race_offset = {offset[0], offset[1]};
  }
  if (!r.has("motor")) return;
  p.inertia = r.number("inertia");
  if (!(p.inertia > 0.0)) r.fail("inertia", words::reports::must_be_positive);
  if (p.rolls) {
    const std::vector<double> radius = r.list("ball_radius", static_cast<std::size_t>(p.balls));
    std::copy(radius.begin(), radius.end(), p.ball_radius.begin());
  }
  const Reader motor = r.object("motor");
  c.motor = model::DriveSegment{.begin = 0.0,
                                .end = std::numeric_limits<double>::infinity(),
                                .constant = motor.number("constant"),
                                .slope = motor.number("slope"),
                                .integral = motor.number("integral"),
                                .aim = motor.number("aim")};
  if (motor.has("limit")) c.motor->limit = motor.number("limit");
}

model::Parameters rotor_from(const Reader& r, int fewest, int most) {
  model::Parameters p;
  const double balls = r.number("balls");
  if (!(balls >= fewest && balls <= most && balls == std::floor(balls)))
    r.fail("balls", fmt::format(words::reports::must_be_whole, fewest, most));
  p.balls = static_cast<int>(balls);
  const auto n = static_cast<std::size_t>(p.balls);
  p.eccentricity = r.number("eccentricity");
  p.damping.fill(r.number("damping"));
  p.stiffness.fill(r.number("stiffness"));
  const std::vector<double> mass = r.list("mass", n), drag = r.list("drag", n);
  for (std::size_t i = 0; i < n; ++i) {
    if (!(mass[i] > 0.0)) r.fail("mass", words::reports::must_be_positive);
    p.mass[i] = mass[i];
    p.drag[i] = drag[i];
  }
  p.rolls = r.flag("rolls");
  return p;
}

std::array<double, model::max_balls> angles_from(const Reader& r, int balls) {
  std::array<double, model::max_balls> phi{};
  const std::vector<double> list = r.list("phi", static_cast<std::size_t>(balls));
  std::copy(list.begin(), list.end(), phi.begin());
  return phi;
}

Certificate certificate_from(const Reader& r) {
  Certificate c;
  c.parameters = rotor_from(r, 1, r.has("tilt") ? 4 : 2);
  c.phi = angles_from(r, c.parameters.balls);
  const auto n = static_cast<std::size_t>(c.parameters.balls);
  read_machine(r, c);
  c.speed = r.number("speed");
  c.level = r.number("level");
  c.form = r.matrix("form", c.system().dimension());
  c.frame = r.matrix("frame", c.system().dimension());
  if (c.parameters.tilts()) return c;  // needs no boxes
  const std::size_t vertices = vertices_of(c);
  for (const std::vector<double>& line : r.lists("boxes", 2 * n + vertices)) {
    Certificate::Box box;
    for (std::size_t k = 0; k < n; ++k) {
      box.low[k] = line[2 * k];
      box.high[k] = line[2 * k + 1];
    }
    for (std::size_t v = 0; v < vertices; ++v) box.multiplier[v] = line[2 * n + v];
    c.boxes.push_back(box);
  }
  return c;
}

MemberCertificate member_from(const Reader& r) {
  MemberCertificate c;
  c.parameters = rotor_from(r, 3, model::max_balls);
  c.phi = angles_from(r, c.parameters.balls);
  c.speed = r.number("speed");
  c.attracts = r.flag("attracts");
  c.radius = r.number("radius");
  const int size = c.parameters.balls + 6;
  if (c.attracts) {
    c.rate = r.number("rate");
    c.least = r.number("least");
    c.level = r.number("level");
  } else {
    const std::vector<double> escape = r.list("escape", static_cast<std::size_t>(size));
    c.escape = Eigen::Map<const Eigen::VectorXd>(escape.data(), size);
  }
  c.form = r.matrix("form", size);
  return c;
}

// The file's object. It must hold at least one certificate of either kind.
Json file_from(const std::string& text, const std::string& where) {
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) throw InputError(where, "", "", words::reports::not_json);
  if (!json.is_object() || json.value("format", Json()) != format_name)
    throw InputError(where, "format", "", fmt::format(words::reports::must_be_format, format_name));
  const auto count = [&](const char* key) {
    const auto list = json.find(key);
    return list != json.end() && list->is_array() ? list->size() : 0;
  };
  if (count("certificates") + count("members") == 0)
    throw InputError(where, "certificates", "", words::reports::must_hold_a_certificate);
  return json;
}

// The entries of one of the file's arrays, if present.
template <class Read>
auto entries(const Json& file, const char* key, const std::string& where, const Read& read) {
  std::vector<decltype(read(std::declval<Reader>()))> result;
  const auto list = file.find(key);
  if (list == file.end()) return result;
  if (!list->is_array()) throw InputError(where, key, "", words::reports::must_be_array);
  for (const Json& entry : *list)
    result.push_back(read(Reader(entry, where, fmt::format("{}[{}]", key, result.size()))));
  return result;
}

template <class Certificates, class Text>
std::string list_text(const Certificates& certificates, const Text& text_of) {
  std::string text = "[";
  for (std::size_t i = 0; i < certificates.size(); ++i) text += (i ? ",\n" : "\n") + text_of(certificates[i]);
  return text + "\n]";
}

}  // namespace

std::string certificates_json(const std::vector<Certificate>& certificates,
                              const std::vector<MemberCertificate>& members) {
  std::string text = fmt::format("{{\n\"format\": \"{}\",\n\"version\": \"{}\",\n\"certificates\": {}", format_name,
                                 version_string, list_text(certificates, certificate_text));
  if (!members.empty()) text += ",\n\"members\": " + list_text(members, member_text);
  return text + "\n}\n";
}

std::string certificates_json(const CertifyResult& result) {
  std::vector<Certificate> certificates;
  for (const StateProof& state : result.states)
    if (state.certificate.level > 0.0) certificates.push_back(state.certificate);
  std::vector<MemberCertificate> members;
  for (const MemberProof& member : result.members)
    if (member.check.proved) members.push_back(member.certificate);
  return certificates.empty() && members.empty() ? "" : certificates_json(certificates, members);
}

std::vector<Certificate> certificates_from_json(const std::string& text, const std::string& where) {
  return entries(file_from(text, where), "certificates", where, certificate_from);
}

std::vector<MemberCertificate> members_from_json(const std::string& text, const std::string& where) {
  return entries(file_from(text, where), "members", where, member_from);
}

CertificateFile checked_certificates(const std::string& text, const std::string& where, const StopFlag* stop) {
  CertificateFile file{where, certificates_from_json(text, where), {}, members_from_json(text, where), {}};
  for (const Certificate& certificate : file.certificates) file.checks.push_back(check_certificate(certificate, stop));
  for (const MemberCertificate& member : file.members)
    file.member_checks.push_back(is_set(stop) ? CertificateResult{false, words::proof::stopped} : check_member(member));
  return file;
}

}  // namespace equipoise
