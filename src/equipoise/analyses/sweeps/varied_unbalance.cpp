// Unbalances read from a study's text, written again as one quantity each.
#include "equipoise/analyses/sweeps/capacity.hpp"

#include <cstddef>
#include <string_view>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/study/contents/keys.hpp"
#include "equipoise/study/reading/table_reader.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise {

namespace {

constexpr char all_together[] = "# all unbalances in proportion\n";

bool about_unbalance(std::string_view key) {
  return key == "rotor.eccentricity" || key.starts_with("rotor.balance_grade") || key.starts_with("place");
}

bool about_planes(std::string_view key) {
  return about_unbalance(key) || key == "rotor.unbalance" || key == "rotor.eccentricity_angle" ||
         key == "rotor.tilt.misalignment" || key.starts_with("rotor.tilt.unbalance");
}

// Whether starts draw such a key, or an axis varies it.
bool varies(const Study& study, const std::vector<SweepAxis>& axes, bool (*about)(std::string_view)) {
  for (const UncertainValue& value : study.uncertain.values)
    if (about(value.key)) return true;
  for (const SweepAxis& axis : axes)
    for (const SweepParameter& parameter : axis.parameters)
      if (about(parameter.key)) return true;
  return false;
}

// What [rotor] itself has, at its centre of mass.
double own_unbalance(StudyValue tree, const std::string& name) {
  tree.erase("place");
  StudyValue* rotor = study::find_table(tree, "rotor");
  if (!rotor->find("unbalance") && !rotor->find("eccentricity") && !rotor->find("balance_grade")) return 0.0;
  rotor->find("tilt")->erase("unbalance");
  const Study study = study_from(tree, name);
  return study.parameters.eccentricity * study.scales->unbalance();
}

// Of a tilting rotor: masses at places become unbalances of planes, so that each is one number.
StudySource with_all_unbalances(const StudySource& source, const std::vector<SweepAxis>& axes, StudyValue tree) {
  StudyValue& rotor = *study::find_table(tree, "rotor");
  StudyValue& tilt = *rotor.find("tilt");
  const StudyValue *stated = tilt.find("unbalance"), *places = tree.find("place");
  const Study study = source.with();
  const char* instead = stated                      ? "rotor.tilt.unbalance.1.size"
                        : places                    ? "place.1.mass"
                        : tilt.find("misalignment") ? "rotor.tilt.misalignment"
                                                    : "rotor.unbalance";
  const auto refuse = [&](const char* why) {
    throw InputError(source.name, "rotor.unbalance", "", fmt::format(fmt::runtime(why), instead));
  };
  if (varies(study, axes, about_planes))
    refuse(
        "an unbalance of this tilting rotor is also drawn or varied; must be another key, such as --of {} with "
        "its range, --between LOW:HIGH");
  const model::Parameters& p = study.parameters;
  if (!(p.eccentricity > 0.0) && p.tilt.couple() != 0.0)
    refuse(
        "the rotor's unbalance is a couple alone, which no static unbalance measures; must be another key, such as "
        "--of {} with its range, --between LOW:HIGH");
  StudyValue::Array planes = stated && stated->array() ? *stated->array() : StudyValue::Array{};
  for (const DataSheet::Place& place : study.in_si->sheet.places)
    planes.push_back({{"at", study::quantity_text(place.at, study::Dimension::length)},
                      {"size", study::quantity_text(place.mass * place.radius, study::Dimension::unbalance)},
                      {"angle", study::quantity_text(place.angle, study::Dimension::angle)}});
  const double own = own_unbalance(tree, source.name);
  for (const char* key : {"eccentricity", "balance_grade"}) rotor.erase(key);
  rotor.set("unbalance", study::quantity_text(own, study::Dimension::unbalance));
  if (!planes.empty()) rotor.find("tilt")->set("unbalance", planes);
  tree.erase("place");
  // Without any unbalance rotor.unbalance stands for itself.
  return {(p.eccentricity > 0.0 ? std::string(all_together) : "") + to_toml(tree), source.name, {}};
}

}  // namespace

StudySource with_unbalance(const StudySource& source, const std::vector<SweepAxis>& axes) {
  StudyValue tree = study::parse_study_file(source.toml, source.name, source.overrides).root;
  StudyValue* rotor = study::find_table(tree, "rotor");
  const Study study = source.with();
  if (!study.physical || !rotor) return source;
  if (study::find_table(*rotor, "tilt")) return with_all_unbalances(source, axes, tree);
  if (rotor->find("unbalance")) return source;
  if (varies(study, axes, about_unbalance)) return source;
  for (const char* key : {"eccentricity", "balance_grade"}) rotor->erase(key);
  rotor->set("unbalance", study::quantity_text(study.parameters.eccentricity * study.scales->unbalance(),
                                               study::Dimension::unbalance));
  tree.erase("place");
  return {to_toml(tree), source.name, {}};
}

// The mark is the first line that with_all_unbalances() writes, so that it is part of what identifies a run.
bool varies_all_unbalances(const StudySource& source) { return source.toml.starts_with(all_together); }

std::vector<std::string> unbalances_in_proportion(const SweepPlan& plan, double unbalance) {
  const StudySource& source = plan.source();
  const study::StudyFile file = study::parse_study_file(source.toml, source.name, source.overrides);
  const double factor = unbalance / (plan.study().parameters.eccentricity * plan.study().scales->unbalance());
  std::vector<std::string> result;
  const auto scale = [&](const std::string& key, study::Dimension dimension) {
    const StudyValue* stated = file.root.find_path(key);
    if (!stated) return false;
    const double was = stated->string() ? study::measure(*stated->string(), {dimension}).value : stated->number();
    result.push_back(fmt::format("{}={}", key, study::quantity_text(factor * was, dimension)));
    return true;
  };
  scale("rotor.unbalance", study::Dimension::unbalance);
  scale("rotor.tilt.misalignment", study::Dimension::angle);
  for (int i = 1; scale(fmt::format("rotor.tilt.unbalance.{}.size", i), study::Dimension::unbalance);) ++i;
  return result;
}

}  // namespace equipoise
