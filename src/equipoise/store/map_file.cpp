// A map in NetCDF, written in one go.
#include "equipoise/store/map_file.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/base/version.hpp"
#include "equipoise/files/netcdf.hpp"

namespace equipoise {

namespace {

std::string axis_text(const MapAxis& axis) {
  return fmt::format("{} from {} to {} in {} pixels", axis.key, axis.low, axis.high, axis.pixels);
}

std::string links_text(const PlaneMap& map) {
  std::string text;
  for (const AngleLink& link : map.links)
    text += fmt::format("{}phi_{} = phi_{} + {}", text.empty() ? "" : "; ", link.ball, link.of, link.offset);
  return text;
}

// flag_meanings are words with blanks between them.
std::string flag_meanings(const std::vector<MapCode>& codes) {
  std::string text;
  for (const MapCode& c : codes) text += (text.empty() ? "" : " ") + store::flag_word(c.name);
  return text;
}

class MapWriter {
 public:
  MapWriter(store::NetcdfFile& file, const PlaneMap& map) : map_(map), file_(file) {
    for (const MapCode& c : map.codes) {
      names_.push_back(c.name);
      aliases_.push_back(c.alias);
    }
  }

  void write() {
    define();
    const std::size_t rows = static_cast<std::size_t>(map_.y.pixels), columns = static_cast<std::size_t>(map_.x.pixels);
    write_axis(x_, map_.x);
    write_axis(y_, map_.y);
    file_.write(outcome_, {0, 0}, {rows, columns}, map_.code.data());
    const std::vector<double>* fields[]{&map_.time, &map_.r_max, &map_.balance_margin, &map_.balance_growth};
    for (std::size_t k = 0; k < 4; ++k) file_.write(fields_[k], {0, 0}, {rows, columns}, fields[k]->data());
    for (std::size_t k = 0; k < map_.codes.size(); ++k) {
      file_.write(code_, {k}, {1}, &map_.codes[k].code);
      file_.write(share_, {k}, {1}, &map_.codes[k].share.share);
    }
    file_.write_texts(name_, names_);
    file_.write_texts(alias_, aliases_);
  }

 private:
  void define() {
    store::NetcdfFile& f = file_;
    const int y = f.dimension("y", static_cast<std::size_t>(map_.y.pixels));
    const int x = f.dimension("x", static_cast<std::size_t>(map_.x.pixels));
    const int kind = f.dimension("outcome_kind", map_.codes.size());
    const auto axis = [&](const char* name, int dimension, const MapAxis& a) {
      return f.variable(name, NC_DOUBLE, {dimension}, a.angle() ? "radian" : "1", a.key);
    };
    x_ = axis("x", x, map_.x);
    y_ = axis("y", y, map_.y);
    outcome_ = f.variable("outcome", NC_SHORT, {y, x}, "1", "what the pixel's start comes to");
    f.fill(outcome_, &not_computed_code);
    std::vector<short> values;
    for (const MapCode& c : map_.codes) values.push_back(c.code);
    f.attribute(outcome_, "flag_values", values);
    f.attribute(outcome_, "flag_meanings", flag_meanings(map_.codes));
    const char* const names[]{"decision_time", "r_max", "balance_margin", "balance_growth"};
    const char* const meanings[]{
        "study time at which the outcome was known, in 1/omega_c",
        "largest distance of the rotor's centre from the axis on the final motion, in race radii",
        "lambda + sum mu_i - 2 max(lambda, mu_i): a balanced state exists where this is 0 or more",
        "largest real part of an eigenvalue at the balanced state, in omega_c: stable where negative"};
    const double none = std::numeric_limits<double>::quiet_NaN();
    for (int k = 0; k < 4; ++k) {
      fields_[k] = f.variable(names[k], NC_DOUBLE, {y, x}, "1", meanings[k]);
      f.fill(fields_[k], &none);
    }
    code_ = f.variable("code", NC_SHORT, {kind}, "1", "value of outcome");
    name_ = f.text_variable("name", kind, names_, "name of the outcome");
    alias_ = f.text_variable("alias", kind, aliases_, "name that Wright and Peng (2019) give it");
    share_ = f.variable("share", NC_DOUBLE, {kind}, "1", "share of the map's pixels");
    define_attributes();
    f.end_definitions();
  }

  void define_attributes() {
    store::NetcdfFile& f = file_;
    f.attribute(NC_GLOBAL, "Conventions", "CF-1.8");
    f.attribute(NC_GLOBAL, "title", "Where a rotor with an automatic ball balancer ends, over a plane");
    f.attribute(NC_GLOBAL, "source", fmt::format("equipoise {}", version_string));
    f.attribute(NC_GLOBAL, "x_key", map_.x.key);
    f.attribute(NC_GLOBAL, "y_key", map_.y.key);
    f.attribute(NC_GLOBAL, "axes", fmt::format("{}; {}", axis_text(map_.x), axis_text(map_.y)));
    f.attribute(NC_GLOBAL, "links", links_text(map_));
    f.attribute(NC_GLOBAL, "study", to_toml(map_.study));
    f.attribute(NC_GLOBAL, "complete", map_.complete ? "yes" : "no");
  }

  void write_axis(int variable, const MapAxis& axis) {
    std::vector<double> centres;
    for (int k = 0; k < axis.pixels; ++k) centres.push_back(axis.centre(k));
    file_.write(variable, {0}, {centres.size()}, centres.data());
  }

  const PlaneMap& map_;
  store::NetcdfFile& file_;
  std::vector<std::string> names_, aliases_;
  int x_ = -1, y_ = -1, outcome_ = -1, code_ = -1, name_ = -1, alias_ = -1, share_ = -1;
  int fields_[4] = {-1, -1, -1, -1};
};

}  // namespace

void write_map_file(const std::string& path, const PlaneMap& map) {
  store::write_netcdf_file(path, [&](store::NetcdfFile& file) { MapWriter(file, map).write(); });
}

}  // namespace equipoise
