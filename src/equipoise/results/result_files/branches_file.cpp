// Branches in NetCDF, written in one go.
#include "equipoise/results/result_files/branches_file.hpp"

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/core/base/version.hpp"
#include "equipoise/results/commands/motion_table.hpp"
#include "equipoise/results/io/netcdf.hpp"
#include "equipoise/results/words/files.hpp"

namespace equipoise {

namespace {

class BranchesWriter {
 public:
  BranchesWriter(io::NetcdfFile& file, const BranchesResult& result)
      : result_(result), file_(file), balls_(static_cast<std::size_t>(result.study.parameters.balls)) {
    for (const Branch& branch : result.branches) {
      names_.push_back(branch.name);
      aliases_.push_back(branch.alias);
      for (const BranchEvent& e : branch.events) {
        changes_.emplace_back(name_of(e.change));
        types_.emplace_back(name_of(e.cause));
      }
    }
  }

  void write() {
    define();
    for (std::size_t k = 0; k < result_.values.size(); ++k) file_.write(value_, {k}, {1}, &result_.values[k]);
    std::size_t event = 0;
    for (std::size_t b = 0; b < result_.branches.size(); ++b) {
      const Branch& branch = result_.branches[b];
      put(id_, b, branch.id);
      for (const BranchPoint& point : branch.points) put_point(point, b);
      for (const BranchEvent& e : branch.events) put_event(e, event++);
    }
    if (result_.branches.empty()) return;
    file_.write_texts(name_, names_);
    file_.write_texts(alias_, aliases_);
    if (changes_.empty()) return;
    file_.write_texts(event_change_, changes_);
    file_.write_texts(event_type_, types_);
  }

 private:
  void define() {
    io::NetcdfFile& f = file_;
    const int value = f.dimension("value", result_.values.size());
    value_ =
        f.variable("value", NC_DOUBLE, {value}, "1", fmt::format("{}: {}", result_.key, parameter_label(result_.key)));
    if (!result_.branches.empty()) define_branches(value);
    if (!changes_.empty()) define_events();
    const std::string study = to_toml(result_.study);
    f.attribute(NC_GLOBAL, "Conventions", "CF-1.8");
    f.attribute(NC_GLOBAL, "title", words::files::attractors_along);
    f.attribute(NC_GLOBAL, "source", fmt::format("equipoise {}", version_string));
    f.attribute(NC_GLOBAL, "identity",
                fmt::format("{}\n# along {}\n# version {}\n", study, result_.key, version_string));
    f.attribute(NC_GLOBAL, "parameter", result_.key);
    f.attribute(NC_GLOBAL, "study", study);
    f.attribute(NC_GLOBAL, "complete", !result_.partial ? "yes" : "no");
    f.end_definitions();
  }

  void define_branches(int value) {
    io::NetcdfFile& f = file_;
    const int attractor = f.dimension("attractor", result_.branches.size());
    const int ball = f.dimension("ball", balls_);
    id_ = f.variable("id", NC_INT, {attractor}, "1", words::files::id_along_range);
    name_ = f.text_variable("name", attractor, names_, words::files::name_of_attractor);
    alias_ = f.text_variable("alias", attractor, aliases_, words::files::name_by_wright_and_peng);
    const auto add = [&](const auto& columns) {
      for (const MotionNumber& c : columns)
        columns_.emplace_back(filled(c.name, {value, attractor}, c.long_name()), c.value);
    };
    const signed char none = -1;
    kind_ = f.variable("kind", NC_BYTE, {value, attractor}, "1", "kind of motion");
    f.fill(kind_, &none);
    f.attribute(kind_, "flag_values", std::vector<signed char>{0, 1, 2, 3});
    f.attribute(kind_, "flag_meanings", words::files::kinds_of_motion);
    stable_ = f.variable("stable", NC_BYTE, {value, attractor}, "1", words::files::whether_it_attracts);
    f.fill(stable_, &none);
    f.attribute(stable_, "flag_values", std::vector<signed char>{0, 1});
    f.attribute(stable_, "flag_meanings", "unstable stable");
    add(motion_numbers);
    drift_ = filled("drift", {value, attractor, ball}, words::files::drift_of_ball);
    if (result_.study.speed.driven()) add(motor_numbers);
  }

  void define_events() {
    io::NetcdfFile& f = file_;
    const int event = f.dimension("event", changes_.size());
    event_id_ = f.variable("event_id", NC_INT, {event}, "1", words::files::attractor_of_event);
    event_change_ = f.text_variable("event_change", event, changes_, "what happens");
    event_type_ = f.text_variable("event_type", event, types_, words::files::type_of_bifurcation);
    event_low_ = f.variable("event_low", NC_DOUBLE, {event}, "1", words::files::above_parameter);
    event_high_ = f.variable("event_high", NC_DOUBLE, {event}, "1", words::files::below_parameter);
  }

  int filled(const char* name, const std::vector<int>& dimensions, const std::string& meaning) {
    const int variable = file_.variable(name, NC_DOUBLE, dimensions, "1", meaning);
    file_.fill(variable, &no_number);
    return variable;
  }

  template <class T>
  void put(int variable, std::size_t at, const T& value) {
    file_.write(variable, {at}, {1}, &value);
  }
  template <class T>
  void put(int variable, const BranchPoint& point, std::size_t attractor, const T& value) {
    file_.write(variable, {point.at, attractor}, {1, 1}, &value);
  }

  void put_point(const BranchPoint& point, std::size_t b) {
    const Motion& m = point.motion;
    put(kind_, point, b, static_cast<signed char>(m.kind));
    put(stable_, point, b, static_cast<signed char>(m.stable ? 1 : 0));
    for (const auto& [variable, value] : columns_) put(variable, point, b, value(m));
    file_.write(drift_, {point.at, b, 0}, {1, 1, balls_}, m.drift.data());
  }

  void put_event(const BranchEvent& e, std::size_t at) {
    put(event_id_, at, e.id);
    put(event_low_, at, e.low);
    put(event_high_, at, e.high);
  }

  const BranchesResult& result_;
  io::NetcdfFile& file_;
  std::size_t balls_;
  std::vector<std::string> names_, aliases_, changes_, types_;
  std::vector<std::pair<int, double (*)(const Motion&)>> columns_;
  int value_ = -1, id_ = -1, name_ = -1, alias_ = -1, kind_ = -1, stable_ = -1, drift_ = -1;
  int event_id_ = -1, event_change_ = -1, event_type_ = -1, event_low_ = -1, event_high_ = -1;
};

}  // namespace

void write_branches_file(const std::string& path, const BranchesResult& result) {
  io::write_netcdf_file(path, [&](io::NetcdfFile& file) { BranchesWriter(file, result).write(); });
}

}  // namespace equipoise
