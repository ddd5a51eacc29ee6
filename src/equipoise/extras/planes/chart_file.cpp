// Dimensions, variables and attributes of a chart; its identity.
#include "equipoise/extras/planes/chart_file.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/extras/words/chart.hpp"
#include "equipoise/results/io/netcdf.hpp"
#include "equipoise/results/result_files/result_identity.hpp"
#include "equipoise/results/words/files.hpp"

namespace equipoise {

namespace {

std::string chart_identity(const BifurcationChart& chart) {
  const auto axis = [](const SliceAxis& a) {
    return fmt::format(words::files::axis_of_map, a.key, a.low, a.high, a.pixels);
  };
  return fmt::format("{}\n[file]\nversion = {}\nx = {}\ny = {}\n{}", to_toml(chart.study), version_string,
                     axis(chart.plane.x), axis(chart.plane.y), chart.cycles ? "cycles = yes\n" : "");
}

// "0 hopf, 1 zero, ..."
template <std::size_t count>
std::string numbered(const std::array<const char*, count>& names) {
  std::string text;
  for (std::size_t k = 0; k < count; ++k) text += fmt::format("{}{} {}", k ? ", " : "", k, names[k]);
  return text;
}

// Columns of numbers over one dimension, which is absent if it is empty.
class ChartColumns {
 public:
  ChartColumns(io::NetcdfFile& file, const char* dimension, std::size_t length) : file_(file), length_(length) {
    if (length > 0) dimension_ = file.dimension(dimension, length);
  }
  template <class Value>
  void add(const char* name, const std::string& long_name, Value&& value) {
    if (length_ == 0) return;
    variables_.push_back(file_.variable(name, NC_DOUBLE, {dimension_}, "1", long_name.c_str()));
    values_.emplace_back();
    for (std::size_t k = 0; k < length_; ++k) values_.back().push_back(static_cast<double>(value(k)));
  }
  void write() const {
    for (std::size_t k = 0; k < variables_.size(); ++k) file_.write(variables_[k], {0}, {length_}, values_[k].data());
  }

 private:
  io::NetcdfFile& file_;
  std::size_t length_;
  int dimension_ = -1;
  std::vector<int> variables_;
  std::vector<std::vector<double>> values_;
};

}  // namespace

void check_chart_file(const std::string& path, const BifurcationChart& chart) {
  const std::string place = io::results_path(path, words::chart::file);
  if (!std::filesystem::exists(place)) return;
  std::string there;
  try {
    there = io::NetcdfFile(place, io::NetcdfFile::Mode::read, path).attribute("chart");
  } catch (const RunError&) {
  }
  if (there.empty()) throw InputError(path, "", "", fmt::format(words::chart::no_such_file, words::chart::file));
  io::require_same(there, chart_identity(chart), path, words::chart::these_results, words::chart::file);
}

void write_chart_file(const std::string& path, const BifurcationChart& chart) {
  struct Numbered {
    std::size_t curve;
    CurvePoint point;
  };
  std::vector<Numbered> points;
  for (std::size_t k = 0; k < chart.curves.size(); ++k)
    for (const CurvePoint& p : chart.curves[k].points) points.push_back({k, p});
  io::write_netcdf_file(path, [&](io::NetcdfFile& f) {
    ChartColumns at(f, "point", points.size()), curve(f, "curve", chart.curves.size()),
        special(f, "special", chart.specials.size()), region(f, "region", chart.regions.size()),
        grid(f, "grid_point", chart.region_of.size()), box(f, "box", chart.boxes.size());
    at.add("point_curve", "number of the curve, from 0", [&](std::size_t k) { return points[k].curve; });
    at.add("point_x", "parameter x of the point", [&](std::size_t k) { return points[k].point.x; });
    at.add("point_y", "parameter y of the point", [&](std::size_t k) { return points[k].point.y; });
    at.add("frequency", "of the pair or the cycle, omega_c", [&](std::size_t k) { return points[k].point.frequency; });
    at.add("lyapunov", "growth rate per square of the swing, omega_c/rad^2",
           [&](std::size_t k) { return points[k].point.lyapunov; });
    at.add("others", "other unstable eigenvalues", [&](std::size_t k) { return points[k].point.others; });
    at.add("swing", "half of what the ball of a cycle covers that swings most, rad",
           [&](std::size_t k) { return points[k].point.swing; });
    curve.add("curve_kind", numbered(curve_kind_names),
              [&](std::size_t k) { return static_cast<int>(chart.curves[k].kind); });
    curve.add("curve_of", "0 balance, else the kind of locked state, from 1, as in the attribute locked_states",
              [&](std::size_t k) {
                const auto& names = chart.locked;
                const auto name = std::find(names.begin(), names.end(), chart.curves[k].of);
                return name == names.end() ? std::ptrdiff_t{0} : name - names.begin() + 1;
              });
    curve.add("curve_first_end", numbered(curve_end_names),
              [&](std::size_t k) { return static_cast<int>(chart.curves[k].ends[0]); });
    curve.add("curve_last_end", "the same of the last point",
              [&](std::size_t k) { return static_cast<int>(chart.curves[k].ends[1]); });
    special.add("special_kind", numbered(special_kind_names),
                [&](std::size_t k) { return static_cast<int>(chart.specials[k].kind); });
    special.add("special_curve", "number of the curve, from 0", [&](std::size_t k) { return chart.specials[k].curve; });
    special.add("special_x", "parameter x", [&](std::size_t k) { return chart.specials[k].x; });
    special.add("special_y", "parameter y", [&](std::size_t k) { return chart.specials[k].y; });
    special.add("special_frequency", "of the pair or the cycle, omega_c",
                [&](std::size_t k) { return chart.specials[k].frequency; });
    region.add("region_part", "part of the grid's points", [&](std::size_t k) { return chart.regions[k].part; });
    region.add("region_balance", "0 no balanced state, 1 stable, 2 unstable, 3 marginal, 4 not found",
               [&](std::size_t k) { return static_cast<int>(chart.regions[k].balance); });
    region.add("region_x", "parameter x of its inmost point", [&](std::size_t k) { return chart.regions[k].x; });
    region.add("region_y", "parameter y of its inmost point", [&](std::size_t k) { return chart.regions[k].y; });
    for (std::size_t n = 0; n < chart.locked.size() && !chart.regions.empty(); ++n) {
      region.add(fmt::format("region_stable_{}", n + 1).c_str(), "stable locked states of that kind",
                 [&](std::size_t k) { return chart.regions[k].locked[n].stable; });
      region.add(fmt::format("region_unstable_{}", n + 1).c_str(), "unstable locked states of that kind",
                 [&](std::size_t k) { return chart.regions[k].locked[n].unstable; });
    }
    grid.add("grid_region", "number of the region, from 0; rows follow y, points within a row x",
             [&](std::size_t k) { return chart.region_of[k]; });
    box.add("box_kind", "-1 not decided, 0 no balanced state, 1 stable, 2 unstable all over the box",
            [&](std::size_t k) { return static_cast<int>(chart.boxes[k].kind); });
    box.add("box_x_low", "parameter x, from", [&](std::size_t k) { return chart.boxes[k].x[0]; });
    box.add("box_x_high", "parameter x, to", [&](std::size_t k) { return chart.boxes[k].x[1]; });
    box.add("box_y_low", "parameter y, from", [&](std::size_t k) { return chart.boxes[k].y[0]; });
    box.add("box_y_high", "parameter y, to", [&](std::size_t k) { return chart.boxes[k].y[1]; });
    const auto say = [&](const char* name, const std::string& text) { f.attribute(NC_GLOBAL, name, text); };
    say("Conventions", "CF-1.8");
    say("title", words::chart::file_title);
    say("source", fmt::format("equipoise {}", version_string));
    say("chart", chart_identity(chart));
    say("x_key", chart.plane.x.key);
    say("y_key", chart.plane.y.key);
    say("x_range", fmt::format("{} {}", chart.plane.x.low, chart.plane.x.high));
    say("y_range", fmt::format("{} {}", chart.plane.y.low, chart.plane.y.high));
    say("locked_states", fmt::format("{}", fmt::join(chart.locked, ", ")));
    say("study", to_toml(chart.study));
    say("complete", chart.complete ? "yes" : "no");
    f.end_definitions();
    at.write();
    curve.write();
    special.write();
    region.write();
    grid.write();
    box.write();
  });
}

}  // namespace equipoise
