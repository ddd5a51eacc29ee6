// Dimensions, variables and attributes of a stability plane; identities of planes.
#include "equipoise/extras/planes/stability_file.hpp"

#include <filesystem>
#include <limits>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/extras/words/stability.hpp"
#include "equipoise/results/io/dataset_file.hpp"
#include "equipoise/results/result_files/result_identity.hpp"

namespace equipoise {

namespace {

PlaneIdentity stability_identity(const StabilityPlane& plane) { return {"stability", plane.study, plane}; }

}  // namespace

PlaneIdentity::PlaneIdentity(const char* attribute, const Study& study, const StabilityPlane& plane) : name(attribute) {
  text = fmt::format("{}\n[file]\nversion = {}\nx = {}\ny = {}\n", to_toml(study), version_string,
                     io::axis_text(plane.x), io::axis_text(plane.y));
}

void PlaneIdentity::require_at(const std::string& path, const std::string& none, const std::string& allowed,
                               const std::string& results) const {
  const std::string place = io::results_path(path, allowed);
  if (!std::filesystem::exists(place)) return;
  std::string there;
  try {
    there = io::NetcdfFile(place, io::NetcdfFile::Mode::read, path).attribute(name);
  } catch (const RunError&) {
  }
  if (there.empty()) throw InputError(path, "", "", none);
  io::require_same(there, text, path, results, allowed);
}

void PlaneIdentity::say(Dataset& data, const StabilityPlane& plane) const {
  data.say(name, text);
  io::say_axes(data, plane.x, plane.y);
}

void check_stability_file(const std::string& path, const StabilityPlane& plane) {
  namespace w = words::stability;
  stability_identity(plane).require_at(path, fmt::format(w::no_such_file, w::file), w::file, w::these_results);
}

void write_stability_file(const std::string& path, const StabilityPlane& plane) {
  Dataset data(words::stability::file_title);
  data.filled = false;
  const std::size_t y = data.dimension("y", static_cast<std::size_t>(plane.y.pixels)),
                    x = data.dimension("x", static_cast<std::size_t>(plane.x.pixels));
  const auto add_axis = [&](const char* name, std::size_t along, const SliceAxis& a) {
    data.add(name, "1", a.key, {along}, [&a](std::size_t k) { return a.centre(static_cast<int>(k)); });
  };
  add_axis("x", x, plane.x);
  add_axis("y", y, plane.y);
  for (const PointNumber& n : point_numbers) {
    DataColumn& column = data.add(n, {y, x}, [&](std::size_t k) { return n.value(plane.points[k]); });
    if (n.whole)
      column.type = DataColumn::Type::small;
    else
      column.fill = std::numeric_limits<double>::quiet_NaN();
    if (&n != &point_numbers.front()) continue;
    column.flags = {-1, 0, 1, 2, 3, 4};
    column.attributes.emplace_back("flag_meanings", fmt::format("not_computed {}", fmt::join(balance_kind_names, " ")));
  }
  stability_identity(plane).say(data, plane);
  data.say("study", to_toml(plane.study));
  data.say("complete", plane.complete ? "yes" : "no");
  io::write_netcdf_file(path, data);
}

}  // namespace equipoise
