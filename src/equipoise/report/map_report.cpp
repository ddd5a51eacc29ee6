// Maps as text and JSON.
#include "equipoise/report/map_report.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "equipoise/base/version.hpp"
#include "equipoise/report/text.hpp"

namespace equipoise {

namespace {

using Json = nlohmann::ordered_json;

std::string axis_text(const char* letter, const MapAxis& a) {
  return fmt::format("{}: {} from {:.10g} to {:.10g}, {} pixels\n", letter, a.key, a.low, a.high, a.pixels);
}

std::string figure_text(const char* name, const std::optional<MapFigure>& f) {
  return f ? fmt::format("{:<25} {:.3f} ({:.3f} to {:.3f})\n", name, f->value, f->low, f->high) : "";
}

Json figure_json(const std::optional<MapFigure>& f) {
  return f ? Json{{"value", f->value}, {"low", f->low}, {"high", f->high}} : Json(nullptr);
}

Json axis_json(const MapAxis& a) {
  std::vector<double> values;
  for (int k = 0; k < a.pixels; ++k) values.push_back(a.centre(k));
  return {{"key", a.key}, {"values", values}};
}

// Rows of a map.
template <class Value, class Cell>
Json rows_json(const PlaneMap& map, const std::vector<Value>& values, const Cell& cell) {
  Json rows = Json::array();
  for (int row = 0; row < map.y.pixels; ++row) {
    Json line = Json::array();
    for (int column = 0; column < map.x.pixels; ++column) line.push_back(cell(values[map.at(column, row)]));
    rows.push_back(std::move(line));
  }
  return rows;
}

}  // namespace

std::string map_text(const PlaneMap& map, const MapFigures& f) {
  std::string text = study_heading(map.study) + axis_text("x", map.x) + axis_text("y", map.y);
  for (const AngleLink& link : map.links)
    text += fmt::format("phi_{} = phi_{} + {:.10g}\n", link.ball, link.of, link.offset);
  text += fmt::format("\n{:>5}  {:<44}{:>10}{:>12}\n", "code", "outcome", "pixels", "of the map");
  for (const MapCode& c : map.codes)
    text += fmt::format("{:>5}  {:<44}{:>10}{:>10.2f} %\n", c.code,
                        c.alias.empty() ? c.name : fmt::format("{} ({})", c.name, c.alias), c.share.count,
                        100.0 * c.share.share);
  const std::string figures =
      figure_text("box dimension", f.box_dimension) + figure_text("uncertainty exponent", f.uncertainty_exponent) +
      figure_text("basin entropy", f.basin_entropy) + figure_text("boundary basin entropy", f.boundary_basin_entropy) +
      (f.balanced_radius
           ? fmt::format("{:<25} {:.3f} rad around balanced angles\n", "all balanced within", *f.balanced_radius)
           : "");
  text += "\n";
  if (!figures.empty())
    text += figures +
            "95 % intervals: of the line through the scales, and of boxes of 5 x 5 pixels. Above log 2 = 0.693 the "
            "boundary's entropy tells a fractal one.\n\n";
  if (!map.complete) text += "PARTIAL: stopped before all pixels were done.\n";
  const double pixels = static_cast<double>(map.code.size());
  return text +
         fmt::format("{:.0f} pixels; {:.2f} s, {:.2f} s CPU on {} thread{} ({}), {:.0f} pixels/s; equipoise {}\n",
                     pixels, map.seconds, map.cpu_seconds, map.threads, map.threads == 1 ? "" : "s", map.cpu_target,
                     pixels / std::max(map.seconds, 1e-9), version_string);
}

std::string map_json(const PlaneMap& map, const MapFigures& f) {
  Json json = {{"x", axis_json(map.x)}, {"y", axis_json(map.y)}};
  json["ties"] = Json::array();
  for (const AngleLink& link : map.links)
    json["ties"].push_back({{"ball", link.ball}, {"of", link.of}, {"offset", link.offset}});
  json["outcomes"] = Json::array();
  for (const MapCode& c : map.codes)
    json["outcomes"].push_back(
        {{"id", c.code}, {"name", c.name}, {"alias", c.alias}, {"pixels", c.share.count}, {"share", c.share.share}});
  json["outcome"] =
      rows_json(map, map.code, [](short code) { return code == not_computed_code ? Json(nullptr) : Json(code); });
  json["time"] = rows_json(map, map.time, [](double t) { return std::isfinite(t) ? Json(t) : Json(nullptr); });
  json["figures"] = {{"box_dimension", figure_json(f.box_dimension)},
                     {"uncertainty_exponent", figure_json(f.uncertainty_exponent)},
                     {"basin_entropy", figure_json(f.basin_entropy)},
                     {"boundary_basin_entropy", figure_json(f.boundary_basin_entropy)},
                     {"balanced_radius", f.balanced_radius ? Json(*f.balanced_radius) : Json(nullptr)}};
  json["partial"] = !map.complete;
  json["seconds"] = map.seconds;
  json["threads"] = map.threads;
  json["cpu_target"] = map.cpu_target;
  json["study_name"] = map.study.name;
  json["study"] = study_json(map.study);
  json["version"] = version_string;
  return json.dump() + "\n";
}

}  // namespace equipoise
