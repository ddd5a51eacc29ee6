// Dimensions, variables and attributes; identities.
#include "equipoise/extras/planes/bifurcation_chart.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/results/columns/dataset.hpp"
#include "equipoise/results/io/dataset_file.hpp"
#include "equipoise/results/result_files/result_identity.hpp"

namespace equipoise {

namespace {

// All that determines the content of a file.
std::string identity_of(const StabilityPlane& plane) {
  return fmt::format("{}\n[file]\nversion = {}\nx = {}\ny = {}\n", to_toml(plane.study), version_string,
                     io::axis_text(plane.x), io::axis_text(plane.y));
}

std::string identity_of(const BifurcationChart& chart) {
  return identity_of(chart.plane) + (chart.cycles ? "cycles = yes\n" : "");
}

// `command` writes such files, and names the attribute that holds their identity; `kind`: what other files do not hold;
// `results`: what this one is.
void require_identity(const std::string& path, const char* command, const std::string& identity, const char* kind,
                      const char* results) {
  const std::string allowed = fmt::format("must be a new file, or one that \"{} -o\" wrote", command);
  const std::string place = io::results_path(path);
  if (!std::filesystem::exists(place)) return;
  std::string there;
  try {
    there = io::NetcdfFile(place, io::NetcdfFile::Mode::read, path).lines(command);
  } catch (const RunError&) {
  }
  if (there.empty()) throw InputError(path, "", "", fmt::format("holds no {}; {}", kind, allowed));
  io::require_same(there, identity, path, results, allowed);
}

void identify(Dataset& data, const char* command, const std::string& identity, const StabilityPlane& plane) {
  data.say(command, identity);
  io::say_axes(data, plane.x, plane.y);
}

void finish(Dataset& data, const std::string& path, const Study& study, bool complete) {
  data.say("study", to_toml(study));
  data.say("complete", complete ? "yes" : "no");
  io::write_netcdf_file(path, data);
}

// "0 hopf, 1 zero, ..."
template <std::size_t count>
std::string numbered(const std::array<const char*, count>& names) {
  std::string text;
  for (std::size_t k = 0; k < count; ++k) text += fmt::format("{}{} {}", k ? ", " : "", k, names[k]);
  return text;
}

// A number of a curve, a region and so on.
template <class Item>
struct ChartNumber {
  std::string name, long_name;
  std::function<double(const Item&)> of;
};

// Columns over one dimension, which is absent if it is empty.
template <class Item>
void add_over(Dataset& data, const char* dimension, const std::vector<Item>& items,
              const std::vector<ChartNumber<Item>>& numbers) {
  if (items.empty()) return;
  const std::size_t along = data.dimension(dimension, items.size());
  for (const auto& n : numbers)
    data.add(n.name, "1", n.long_name, {along}, [&items, of = n.of](std::size_t k) { return of(items[k]); });
}

struct NumberedPoint {
  std::size_t curve;
  CurvePoint point;
};

}  // namespace

void check_stability_file(const std::string& path, const StabilityPlane& plane) {
  require_identity(path, "stability", identity_of(plane), "plane of stability", "this plane of this study");
}

void check_chart_file(const std::string& path, const BifurcationChart& chart) {
  require_identity(path, "chart", identity_of(chart), "chart", "this chart of this study");
}

void write_stability_file(const std::string& path, const StabilityPlane& plane) {
  Dataset data("where balance is stable in a plane of two parameters");
  data.filled = false;
  const std::vector<std::size_t> along = io::add_axes(data, plane.x, plane.y);
  for (const PointNumber& n : point_numbers) {
    DataColumn& column = data.add(n, along, [&](std::size_t k) { return n.value(plane.points[k]); });
    if (n.whole)
      column.type = DataColumn::Type::small;
    else
      column.fill = std::numeric_limits<double>::quiet_NaN();
    if (&n != &point_numbers.front()) continue;
    column.flags = {-1, 0, 1, 2, 3, 4};
    column.attributes.emplace_back("flag_meanings", fmt::format("not_computed {}", fmt::join(balance_kind_names, " ")));
  }
  identify(data, "stability", identity_of(plane), plane);
  finish(data, path, plane.study, plane.complete);
}

void write_chart_file(const std::string& path, const BifurcationChart& chart) {
  std::vector<NumberedPoint> points;
  for (std::size_t k = 0; k < chart.curves.size(); ++k)
    for (const CurvePoint& p : chart.curves[k].points) points.push_back({k, p});
  const auto locked_place = [&](const ChartCurve& c) {
    const auto name = std::find(chart.locked.begin(), chart.locked.end(), c.of);
    return name == chart.locked.end() ? 0 : name - chart.locked.begin() + 1;
  };
  Dataset data("curves in a plane of two parameters on which balance and locked states change");
  std::vector<ChartNumber<NumberedPoint>> of_point{
      {"point_curve", "number of the curve, from 0", [](const auto& p) { return p.curve; }}};
  for (const CurveNumber& n : curve_numbers)
    of_point.push_back({of_point.size() <= 2 ? std::string("point_") + n.name : n.name, n.long_name(),
                        [&n](const auto& p) { return n.value(p.point); }});
  add_over(data, "point", points, of_point);
  add_over<ChartCurve>(
      data, "curve", chart.curves,
      {{"curve_kind", numbered(curve_kind_names), [](const auto& c) { return static_cast<int>(c.kind); }},
       {"curve_of", "0 balance, else the kind of locked state, from 1, as in the attribute locked_states",
        locked_place},
       {"curve_first_end", numbered(curve_end_names), [](const auto& c) { return static_cast<int>(c.ends[0]); }},
       {"curve_last_end", "the same of the last point", [](const auto& c) { return static_cast<int>(c.ends[1]); }}});
  add_over<SpecialPoint>(
      data, "special", chart.specials,
      {{"special_kind", numbered(special_kind_names), [](const auto& p) { return static_cast<int>(p.kind); }},
       {"special_curve", "number of the curve, from 0", [](const auto& p) { return p.curve; }},
       {"special_x", "parameter x", [](const auto& p) { return p.x; }},
       {"special_y", "parameter y", [](const auto& p) { return p.y; }},
       {"special_frequency", "of the pair or the cycle, omega_c", [](const auto& p) { return p.frequency; }}});
  std::vector<ChartNumber<ChartRegion>> of_region{
      {"region_part", "part of the grid's points", [](const auto& r) { return r.part; }},
      {"region_balance", "0 no balanced state, 1 stable, 2 unstable, 3 marginal, 4 not found",
       [](const auto& r) { return static_cast<int>(r.balance); }},
      {"region_x", "parameter x of its inmost point", [](const auto& r) { return r.x; }},
      {"region_y", "parameter y of its inmost point", [](const auto& r) { return r.y; }}};
  for (std::size_t n = 0; n < chart.locked.size(); ++n) {
    of_region.push_back({fmt::format("region_stable_{}", n + 1), "stable locked states of that kind",
                         [n](const auto& r) { return r.locked[n].stable; }});
    of_region.push_back({fmt::format("region_unstable_{}", n + 1), "unstable locked states of that kind",
                         [n](const auto& r) { return r.locked[n].unstable; }});
  }
  add_over(data, "region", chart.regions, of_region);
  add_over<int>(data, "grid_point", chart.region_of,
                {{"grid_region", "number of the region, from 0; rows follow y, points within a row x",
                  [](int region) { return region; }}});
  add_over<ProofBox>(data, "box", chart.boxes,
                     {{"box_kind", "-1 not decided, 0 no balanced state, 1 stable, 2 unstable all over the box",
                       [](const auto& b) { return static_cast<int>(b.kind); }},
                      {"box_x_low", "parameter x, from", [](const auto& b) { return b.x[0]; }},
                      {"box_x_high", "parameter x, to", [](const auto& b) { return b.x[1]; }},
                      {"box_y_low", "parameter y, from", [](const auto& b) { return b.y[0]; }},
                      {"box_y_high", "parameter y, to", [](const auto& b) { return b.y[1]; }}});
  identify(data, "chart", identity_of(chart), chart.plane);
  data.say("locked_states", fmt::format("{}", fmt::join(chart.locked, ", ")));
  finish(data, path, chart.plane.study, chart.complete);
}

}  // namespace equipoise
