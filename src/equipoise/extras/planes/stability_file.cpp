// Dimensions, variables and attributes of a stability plane; its identity.
#include "equipoise/extras/planes/stability_file.hpp"

#include <filesystem>
#include <limits>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/extras/words/stability.hpp"
#include "equipoise/results/io/netcdf.hpp"
#include "equipoise/results/result_files/result_identity.hpp"
#include "equipoise/results/words/files.hpp"

namespace equipoise {

namespace {

std::string plane_identity(const StabilityPlane& plane) {
  const auto axis = [](const SliceAxis& a) {
    return fmt::format(words::files::axis_of_map, a.key, a.low, a.high, a.pixels);
  };
  return fmt::format("{}\n[file]\nversion = {}\nx = {}\ny = {}\n", to_toml(plane.study), version_string, axis(plane.x),
                     axis(plane.y));
}

}  // namespace

void check_stability_file(const std::string& path, const StabilityPlane& plane) {
  const std::string place = io::results_path(path, words::stability::file);
  if (!std::filesystem::exists(place)) return;
  std::string there;
  try {
    there = io::NetcdfFile(place, io::NetcdfFile::Mode::read, path).attribute("stability");
  } catch (const RunError&) {
  }
  if (there.empty())
    throw InputError(path, "", "", fmt::format(words::stability::no_such_file, words::stability::file));
  io::require_same(there, plane_identity(plane), path, words::stability::these_results, words::stability::file);
}

void write_stability_file(const std::string& path, const StabilityPlane& plane) {
  const auto rows = static_cast<std::size_t>(plane.y.pixels), columns = static_cast<std::size_t>(plane.x.pixels);
  io::write_netcdf_file(path, [&](io::NetcdfFile& f) {
    const int y = f.dimension("y", rows), x = f.dimension("x", columns);
    const auto axis = [&](const char* name, int dimension, const SliceAxis& a) {
      return f.variable(name, NC_DOUBLE, {dimension}, "1", a.key);
    };
    const int at_x = axis("x", x, plane.x), at_y = axis("y", y, plane.y);
    std::vector<int> variables;
    const double none = std::numeric_limits<double>::quiet_NaN();
    for (const PointNumber& n : point_numbers) {
      variables.push_back(f.variable(n.name, n.whole ? NC_SHORT : NC_DOUBLE, {y, x}, "1", n.long_name()));
      if (!n.whole) f.fill(variables.back(), &none);
    }
    f.attribute(variables.front(), "flag_values", std::vector<short>{-1, 0, 1, 2, 3, 4});
    std::string meanings = "not_computed";
    for (const char* name : balance_kind_names) meanings += std::string(" ") + name;
    f.attribute(variables.front(), "flag_meanings", meanings);
    const auto say = [&](const char* name, const std::string& text) { f.attribute(NC_GLOBAL, name, text); };
    say("Conventions", "CF-1.8");
    say("title", words::stability::file_title);
    say("source", fmt::format("equipoise {}", version_string));
    say("stability", plane_identity(plane));
    say("x_key", plane.x.key);
    say("y_key", plane.y.key);
    say("x_range", fmt::format("{} {}", plane.x.low, plane.x.high));
    say("y_range", fmt::format("{} {}", plane.y.low, plane.y.high));
    say("study", to_toml(plane.study));
    say("complete", plane.complete ? "yes" : "no");
    f.leave_unfilled();
    f.end_definitions();
    const auto write_axis = [&](int variable, const SliceAxis& a) {
      std::vector<double> centres;
      for (int k = 0; k < a.pixels; ++k) centres.push_back(a.centre(k));
      f.write(variable, {0}, {centres.size()}, centres.data());
    };
    write_axis(at_x, plane.x);
    write_axis(at_y, plane.y);
    for (std::size_t k = 0; k < point_numbers.size(); ++k) {
      const PointNumber& n = point_numbers[k];
      std::vector<double> numbers;
      std::vector<short> whole;
      for (const BalancePoint& p : plane.points) {
        if (n.whole)
          whole.push_back(static_cast<short>(n.value(p)));
        else
          numbers.push_back(n.value(p));
      }
      f.write(variables[k], {0, 0}, {rows, columns}, n.whole ? static_cast<const void*>(whole.data()) : numbers.data());
    }
  });
}

}  // namespace equipoise
