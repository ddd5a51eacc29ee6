// Proofs about balanced states as text and as JSON.
#include "equipoise/extras/proof/certify.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/machine/model/state_layout.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/report/text/text.hpp"

namespace equipoise {

namespace {

std::vector<std::string> variable_names(const model::System& system) {
  std::vector<std::string> names;
  for (const model::StateVariable& v : model::state_variables(system.layout())) names.push_back(v.name);
  return names;
}

std::string boxes_text(const Certificate& c) {
  return c.parameters.tilts() ? "one box" : fmt::format("{} boxes", c.boxes.size());
}

// A matrix whose rows and columns have these names, in blocks of as many columns as fit.
std::string matrix_text(const Eigen::MatrixXd& matrix, const std::vector<std::string>& names, const TextStyle& style) {
  constexpr std::size_t cell = 14, first = 13;
  const std::size_t all = names.size();
  const std::size_t fitting =
      style.width > 0 ? std::max<std::size_t>((std::max(style.width, first) - first) / cell, 1) : all;
  const std::size_t blocks = (all + fitting - 1) / fitting, columns = (all + blocks - 1) / blocks;
  std::string text;
  for (std::size_t begin = 0; begin < all; begin += columns) {
    const std::size_t end = std::min(begin + columns, all);
    text += fmt::format("{:<{}}", "  P", first);
    for (std::size_t j = begin; j < end; ++j) text += fmt::format("{:>{}}", names[j], cell);
    text += "\n";
    for (std::size_t i = 0; i < all; ++i) {
      text += fmt::format("{:<{}}", "  " + names[i], first);
      for (std::size_t j = begin; j < end; ++j)
        text += fmt::format("{:>{}.6g}", matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)), cell);
      text += "\n";
    }
  }
  return text;
}

std::string state_text(const StateProof& s, const model::System& system, const TextStyle& style) {
  const Certificate& c = s.certificate;
  const int balls = system.balls();
  std::string angles;
  for (int i = 0; i < balls; ++i) angles += fmt::format("{}phi_{} = {:.9f}", i ? ", " : "", i + 1, c.phi[i]);
  std::string text = fmt::format("balanced state {}", angles);
  if (s.copies > 1) text += "; its exchange copy (equal balls) has the same proof";
  text += "\n";
  if (c.level == 0.0) return lines_filled(text + fmt::format("  not proved: {}\n", s.check.reason), style);
  const double share = 100.0 * c.level / s.critical;
  text += fmt::format("  proved: V = d^T P d decreases on 0 < V <= c, c = {:.9g}: {} % of the sampled critical level\n",
                      c.level, c.parameters.tilts() ? fmt::format("{:.2g}", share) : fmt::format("{:.1f}", share));
  text += "  reach of V <= c:";
  const std::vector<std::string> names = variable_names(system);
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format(" {} {:.4g}{}", names[i], s.reach[i], i + 1 < names.size() ? "," : "\n");
  text += fmt::format("  {}, found in {:.3f} s; re-check in {:.3f} s: {}\n", boxes_text(c), s.seconds, s.check_seconds,
                      s.check.proved ? "holds" : "REFUTED, " + s.check.reason);
  return lines_filled(text, style) + matrix_text(c.form, names, style);
}

std::string angles_text(const MemberCertificate& c) {
  return fmt::format("phi = ({:.6f})", fmt::join(c.phi.begin(), c.phi.begin() + c.parameters.balls, ", "));
}

// Summary of the members' proofs: the widest neighbourhood, the fastest growth.
std::string members_text(const CertifyResult& r) {
  if (r.members.empty()) return "";
  const int drawn = static_cast<int>(r.members.size()), attracting = r.attracting(), unstable = r.unstable();
  std::string text = fmt::format(
      "the balanced states form a continuum; of {} members drawn evenly from it {} are proved to attract all that "
      "comes close, {} to be unstable, {} neither\n",
      drawn, attracting, unstable, drawn - attracting - unstable);
  const MemberProof *widest = nullptr, *fastest = nullptr;
  for (const MemberProof& m : r.members) {
    if (!m.check.proved) continue;
    if (m.certificate.attracts && (!widest || m.certificate.level > widest->certificate.level)) widest = &m;
    if (!m.certificate.attracts && (!fastest || m.growth > fastest->growth)) fastest = &m;
  }
  if (widest)
    text += fmt::format(
        "  attracts: {}; balls within {:.3g} rad of that and V <= {:.3g} lead to balance (rate {:.4g})\n",
        angles_text(widest->certificate), 0.5 * widest->certificate.radius, widest->certificate.level, widest->growth);
  if (fastest)
    text += fmt::format("  unstable: {}; leads away from the set (growth rate {:.4g})\n",
                        angles_text(fastest->certificate), fastest->growth);
  return text + "  nothing is proved of members that were not drawn\n";
}

}  // namespace

std::string certify_text(const CertifyResult& r, const TextStyle& style) {
  std::string text =
      fmt::format("{}: speed {}\n", r.study.name, engineering(r.study.scales, r.speed, study::Dimension::speed));
  if (!r.note.empty())
    text += fmt::format("{}{}\n", r.members.empty() ? "nothing proved: " : "", note_text(r.study, r.note));
  text = lines_filled(text, style);
  for (const StateProof& s : r.states) text += state_text(s, r.study.system(), style);
  return text +
         lines_filled(members_text(r) +
                          (r.partial ? "PARTIAL: stopped; what is not proved above was not tried to the end.\n" : ""),
                      style);
}

void to_json(Json& json, const PartOf<StateProof, model::System>& of) {
  const auto& [s, system] = of;
  const Certificate& c = s.certificate;
  Json reach, form = Json::array();
  const std::vector<std::string> names = variable_names(system);
  for (std::size_t i = 0; i < names.size(); ++i) reach[names[i]] = s.reach[i];
  for (const auto& row : c.form.rowwise()) form.push_back(leading(row, row.size()));
  json = object("proved", c.level > 0.0 && s.check.proved, "reason", s.check.reason, "phi",
                leading(c.phi, system.balls()), "copies", s.copies, "level", c.level, "critical_level", s.critical,
                "share_of_critical", c.level / s.critical, "reach", reach, "form", form, "boxes", c.boxes.size(),
                "seconds", s.seconds, "check_seconds", s.check_seconds);
}

void to_json(Json& json, const PartOf<MemberProof, model::System>& of) {
  const auto& [m, system] = of;
  const MemberCertificate& c = m.certificate;
  json = object("proved", m.check.proved, "reason", m.check.reason, "attracts", c.attracts, "phi",
                leading(c.phi, system.balls()), "radius", c.radius, "level", c.level, "growth_rate", m.growth);
}

std::string json_text(const CertifyResult& r) {
  const model::System system = r.study.system();
  Json json = object("proved", r.proved(), "partial", r.partial, "note", r.note, "speed", r.speed, "states",
                     PartOf{r.states, system});
  if (!r.members.empty()) put(json, "members", PartOf{r.members, system});
  put(json, "study_name", r.study.name, "version", version_string);
  return json.dump(2) + "\n";
}

std::string check_text(const CertificateFile& file, const TextStyle& style) {
  const auto verdict = [](const CertificateResult& check) {
    return check.proved ? "proved" : "NOT proved, " + check.reason;
  };
  std::string text;
  for (const StateProof& s : file.states) {
    const Certificate& c = s.certificate;
    text += fmt::format("speed {}{}, {} ball{}, level {:.9g}, {}: {}\n", c.speed, c.motor ? " by a motor" : "",
                        c.parameters.balls, plural(c.parameters.balls), c.level, boxes_text(c), verdict(s.check));
  }
  for (const MemberProof& m : file.members) {
    const MemberCertificate& c = m.certificate;
    text += fmt::format("speed {}, {} balls, member {}, {}: {}\n", c.speed, c.parameters.balls, angles_text(c),
                        c.attracts ? "attracts" : "unstable", verdict(m.check));
  }
  return lines_filled(text, style);
}

std::string json_text(const CertificateFile& file) {
  Json json = object("proved", file.proved(), "file", file.path, "certificates", Json::array());
  for (const StateProof& s : file.states) {
    const Certificate& c = s.certificate;
    json["certificates"].push_back(object("proved", s.check.proved, "reason", s.check.reason, "speed", c.speed, "level",
                                          c.level, "boxes", c.boxes.size()));
  }
  for (const MemberProof& m : file.members) {
    const MemberCertificate& c = m.certificate;
    json["members"].push_back(object("proved", m.check.proved, "reason", m.check.reason, "attracts", c.attracts,
                                     "speed", c.speed, "level", c.level));
  }
  put(json, "version", version_string);
  return json.dump(2) + "\n";
}

}  // namespace equipoise
