// Studies: read, explained, as forms; and those that come with the page.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "calls.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/embedded.hpp"
#include "equipoise/report/explain/explain.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/report/html/form.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"

namespace equipoise::embedded {
extern const Archive preset_files;
}

namespace equipoise::web {

namespace {

Json scales_json(const std::optional<model::Scales>& s) {
  if (!s) return nullptr;
  return object("mass", s->mass, "length", s->length, "time", s->time(), "force", s->force(), "velocity", s->velocity(),
                "speed", s->frequency, "speed_rpm", s->frequency * 30.0 / pi);
}

Json machine_json(const Study& study, const Explanation& e) {
  const model::Parameters& p = study.parameters;
  const Limits& limits = study.limits;
  std::optional<double> spun_up = e.spin_up;
  if (!spun_up && !study.speed.driven()) spun_up = 0.0;
  return object("balls", p.balls, "mass", leading(p.mass, p.balls), "ball_radius", leading(p.ball_radius, p.balls),
                "eccentricity", p.eccentricity, "race_offset", p.race_offset, "contact_angle", p.contact_angle,
                "gravity", p.gravity, "sag", model::static_sag(p), "driven", study.speed.driven(), "final_speed",
                e.speed, "release_time", study.release_time(), "spun_up", spun_up, "watch_until",
                output_times(study).back(), "limits",
                object("displacement", limits.displacement, "force", limits.force, "velocity", limits.velocity,
                       "settled", limits.settled));
}

Json field_json(const FormField& f) {
  return object("key", f.key, "label", f.label, "value", f.value, "unit", f.unit, "units", f.units, "worth", f.worth,
                "allowed", f.allowed, "choices", f.choices, "kind", name_of(f.kind), "given", f.given);
}

Json offer_json(const OfferedKey& o) { return object("key", o.key, "label", o.label, "sentence", o.sentence); }

std::string command_of(const std::vector<std::string>& overrides) {
  std::string command = "equipoise basin study.toml";
  for (const std::string& text : overrides) {
    const bool plain = text.find_first_of(" '\"[]{}$\\") == text.npos;
    command += plain ? " --set " + text : fmt::format(" --set '{}'", text);
  }
  return command;
}

Json undecidable(const Study& study) {
  try {
    check_runnable(study, false);
  } catch (const InputError& e) {
    return problem_json(e);
  }
  return nullptr;
}

// A study's first line says what it is; but for the paper's rows, up to where it begins to say more.
std::string title_of(const std::string& group, const std::string& toml) {
  const std::size_t begin = toml.find_first_not_of("# "), end = toml.find('\n');
  if (!toml.starts_with('#') || begin >= end) return "";
  std::string title = toml.substr(begin, end - begin);
  if (group != "paper") title.erase(std::min(title.find_first_of(",:."), title.size()));
  if (title.ends_with('.')) title.pop_back();
  return title;
}

}  // namespace

Json check_study(const Json& args) {
  const std::string text = args.at(0).get<std::string>();
  std::vector<std::string> overrides;
  if (args.size() > 1)
    for (const Json& pair : args.at(1))
      overrides.push_back(pair.at(0).get<std::string>() + "=" + pair.at(1).get<std::string>());
  const Study uncertain = parse_study(text, study_name, overrides);
  const Study study = with_medians(uncertain);
  const Explanation e = explain(study);
  const Json problem = undecidable(uncertain);
  const std::vector<FormField> fields = form_of(text, study_name, overrides);
  return {{"toml", with_overrides(text, study_name, overrides)},
          {"study", uncertain},
          {"physical", study.scales.has_value()},
          {"scales", scales_json(study.scales)},
          {"machine", machine_json(study, e)},
          {"fields", list_of(fields, field_json)},
          {"offers", list_of(offered_keys(uncertain, fields), offer_json)},
          {"explain", explain_text(e)},
          {"warnings", e.warnings},
          {"command", command_of(overrides)},
          {"uncertain", !uncertain.uncertain.empty()},
          {"decidable", problem.is_null()},
          {"problem", problem},
          {"starts", uncertain.sampling.starts},
          {"seed", uncertain.sampling.seed}};
}

Json presets(const Json&) {
  Json list = Json::array();
  const embedded::Archive& files = embedded::preset_files;
  for (std::size_t k = 0; k < files.count; ++k) {
    const std::string path(files.files[k].name), toml(files.files[k].text);
    const std::size_t slash = path.find('/'), dot = path.rfind('.');
    const std::string group = path.substr(0, slash);
    // Two of those that one begins with are called as a machine is.
    list.push_back({{"name", (group == "new" ? "new-" : "") + path.substr(slash + 1, dot - slash - 1)},
                    {"title", title_of(group, toml)},
                    {"group", group},
                    {"toml", toml}});
  }
  return list;
}

}  // namespace equipoise::web
