// Dimensions, variables and attributes of a chart; its identity.
#include "equipoise/extras/planes/chart_file.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include <fmt/format.h>

#include "equipoise/extras/planes/stability_file.hpp"
#include "equipoise/extras/words/chart.hpp"
#include "equipoise/results/io/dataset_file.hpp"

namespace equipoise {

namespace {

PlaneIdentity chart_identity(const BifurcationChart& chart) {
  PlaneIdentity identity("chart", chart.study, chart.plane);
  if (chart.cycles) identity.text += "cycles = yes\n";
  return identity;
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

void check_chart_file(const std::string& path, const BifurcationChart& chart) {
  namespace w = words::chart;
  chart_identity(chart).require_at(path, fmt::format(w::no_such_file, w::file), w::file, w::these_results);
}

void write_chart_file(const std::string& path, const BifurcationChart& chart) {
  std::vector<NumberedPoint> points;
  for (std::size_t k = 0; k < chart.curves.size(); ++k)
    for (const CurvePoint& p : chart.curves[k].points) points.push_back({k, p});
  const auto locked_place = [&](const ChartCurve& c) {
    const auto name = std::find(chart.locked.begin(), chart.locked.end(), c.of);
    return name == chart.locked.end() ? 0 : name - chart.locked.begin() + 1;
  };
  Dataset data(words::chart::file_title);
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
  chart_identity(chart).say(data, chart.plane);
  data.say("locked_states", fmt::format("{}", fmt::join(chart.locked, ", ")));
  data.say("study", to_toml(chart.study));
  data.say("complete", chart.complete ? "yes" : "no");
  io::write_netcdf_file(path, data);
}

}  // namespace equipoise
