// A map's rows out of its file.
#include <charconv>
#include <utility>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/base/error.hpp"
#include "equipoise/files/sealed_file.hpp"
#include "equipoise/store/map_netcdf.hpp"

namespace equipoise::store {

namespace {

constexpr const char* allowed_map = "must be a file that \"map -o\" wrote";

const std::string& whole_map_file(const std::string& path) {
  if (const std::string damage = why_not_whole(path); !damage.empty())
    throw InputError(path, "", "", fmt::format("{}; {}", damage, allowed_map));
  return path;
}

}  // namespace

MapReader::MapReader(const std::string& path) : file_(whole_map_file(path), NetcdfFile::Mode::read) {
  try {
    x_ = read_axis("x");
    y_ = read_axis("y");
    const std::vector<std::size_t> plane{static_cast<std::size_t>(y_.pixels), static_cast<std::size_t>(x_.pixels)};
    outcome_ = file_.variable("outcome", NC_SHORT, plane);
    time_ = file_.variable("decision_time", NC_FLOAT, plane);
    r_max_ = file_.variable("r_max", NC_FLOAT, plane);
    if (!file_.attribute("refine").starts_with("no")) computed_ = file_.variable("computed", NC_BYTE, plane);
    if (file_.dimensions("balance_margin") == 0) return;
    margin_ = file_.variable("balance_margin", NC_FLOAT, plane);
    growth_ = file_.variable("balance_growth", NC_FLOAT, plane);
  } catch (const RunError&) {
    throw InputError(path, "", "", fmt::format("holds no map; {}", allowed_map));
  }
}

MapAxis MapReader::read_axis(const std::string& letter) const {
  MapAxis axis;
  axis.key = file_.attribute(letter + "_key");
  axis.pixels = static_cast<int>(file_.length(letter));
  const std::string range = file_.attribute(letter + "_range");
  const char* const end = range.data() + range.size();
  const auto low = std::from_chars(range.data(), end, axis.low);
  const auto high = low.ptr < end ? std::from_chars(low.ptr + 1, end, axis.high) : low;
  if (high.ec != std::errc() || high.ptr != end || low.ptr == end) throw RunError(letter + "_range is none");
  return axis;
}

std::vector<MapCode> MapReader::codes() const {
  std::vector<MapCode> codes;
  const std::size_t kinds = file_.length("outcome_kind");
  const int variable = file_.variable("code", NC_SHORT, {kinds});
  for (std::size_t k = 0; k < kinds; ++k) {
    MapCode code;
    file_.read(variable, {k}, {1}, &code.code);
    if (code.code <= 0) continue;
    code.name = file_.read_text("name", k);
    code.alias = file_.read_text("alias", k);
    codes.push_back(std::move(code));
  }
  return codes;
}

std::vector<std::vector<double>> MapReader::discoveries() const {
  std::vector<std::vector<double>> states(file_.length("discovery"), std::vector<double>(file_.length("component")));
  if (states.empty()) return states;
  const int variable = file_.variable("discovery_state", NC_DOUBLE, {states.size(), states.front().size()});
  for (std::size_t k = 0; k < states.size(); ++k) file_.read(variable, {k, 0}, {1, states[k].size()}, states[k].data());
  return states;
}

template <class T, class Put>
void MapReader::read_column(int variable, int first, int rows, const Put& put) const {
  const std::size_t columns = static_cast<std::size_t>(x_.pixels);
  std::vector<T> column(columns * static_cast<std::size_t>(rows));
  file_.read(variable, {static_cast<std::size_t>(first), 0}, {static_cast<std::size_t>(rows), columns}, column.data());
  for (std::size_t k = 0; k < column.size(); ++k) put(k, column[k]);
}

void MapReader::read_rows(int first, int rows, MapPixel* pixels) const {
  read_column<short>(outcome_, first, rows, [&](std::size_t k, short code) {
    pixels[k] = MapPixel{code, code != not_computed_code};
  });
  if (computed_ >= 0)
    read_column<signed char>(computed_, first, rows,
                             [&](std::size_t k, signed char computed) { pixels[k].computed = computed != 0; });
  read_column<float>(time_, first, rows, [&](std::size_t k, float value) { pixels[k].time = value; });
  read_column<float>(r_max_, first, rows, [&](std::size_t k, float value) { pixels[k].r_max = value; });
  if (margin_ < 0) return;
  read_column<float>(margin_, first, rows, [&](std::size_t k, float value) { pixels[k].balance_margin = value; });
  read_column<float>(growth_, first, rows, [&](std::size_t k, float value) { pixels[k].balance_growth = value; });
}

}  // namespace equipoise::store
