// Dimensions, variables and attributes of a basin slice; its rows written as they come, and read on demand.
#include <algorithm>
#include <limits>
#include <system_error>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/read_number.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/results/io/sealed_file.hpp"
#include "equipoise/results/result_files/basin_outcomes.hpp"
#include "equipoise/results/result_files/result_identity.hpp"
#include "equipoise/results/result_files/slice_file.hpp"
#include "equipoise/results/words/files.hpp"
#include "equipoise/results/result_files/slice_netcdf.hpp"

namespace equipoise::io {

namespace {

const std::string& whole_map_file(const std::string& path) {
  if (const std::string damage = why_not_whole(path); !damage.empty())
    throw InputError(path, "", "", fmt::format("{}; {}", damage, words::files::map_file));
  return path;
}

std::string links_text(const std::vector<AngleLink>& links) {
  std::string text;
  for (const AngleLink& link : links)
    text += fmt::format("{}phi_{} = phi_{} + {}", text.empty() ? "" : "; ", link.ball, link.of, link.offset);
  return text;
}

// Columns before those of pixels.
constexpr std::size_t first_of_pixels = 2;

void add_pixels(Dataset& data, const std::vector<std::size_t>& along, const SliceFileHeader& header,
                const std::vector<OutcomeShare>& codes) {
  DataColumn& outcome =
      data.add("outcome", "1", words::files::outcome_of_pixel, along, DataValues{}, DataColumn::Type::small);
  outcome.fill = not_computed_code;
  add_outcome_flags(outcome, codes);
  for (const PixelNumber& n : pixel_numbers) {
    const bool one = header.one_rotor && n.of_rotor;
    const DataValues of_rotor = [&](std::size_t) { return header.rotor.*n.value; };
    data.add(n, one ? std::vector<std::size_t>{} : along, one ? of_rotor : DataValues{}, DataColumn::Type::single)
        .fill = std::numeric_limits<double>::quiet_NaN();
  }
}

void say_attributes(Dataset& data, const SliceFileHeader& header, bool complete) {
  data.say("identity", identity_of(header));
  say_axes(data, header.x, header.y);
  data.say("axes", axis_text(header.x) + "; " + axis_text(header.y));
  data.say("links", links_text(header.links));
  data.say("study", header.study);
  data.say("complete", complete ? "yes" : "no");
}

}  // namespace

std::string identity_of(const SliceFileHeader& h) {
  const auto range = [](const SliceAxis& a) { return fmt::format("{} to {} in {} pixels", a.low, a.high, a.pixels); };
  return fmt::format(
      "{}\n[file]\nversion = {}\narithmetic = {}\nx = {}\ny = {}\nties = {}\nx_range = {}\ny_range = {}\n", h.study,
      version_string, h.arithmetic, h.x.key, h.y.key, h.links.empty() ? "none" : links_text(h.links), range(h.x),
      range(h.y));
}

Dataset SliceWriter::contents(const SliceFileHeader& header, const std::vector<OutcomeShare>& codes,
                              const std::vector<std::vector<double>>& discoveries, bool complete) {
  Dataset data(words::files::over_a_plane);
  data.filled = false;
  const std::size_t y = data.dimension("y", static_cast<std::size_t>(header.y.pixels));
  const std::size_t x = data.dimension("x", static_cast<std::size_t>(header.x.pixels));
  for (const auto& [name, along, axis] : {std::tuple{"x", x, &header.x}, {"y", y, &header.y}})
    data.add(name, axis->angle() ? "radian" : "1", axis->key, {along},
             [axis = axis](std::size_t k) { return axis->centre(static_cast<int>(k)); });
  add_pixels(data, {y, x}, header, codes);
  const std::size_t kind = add_outcome_kinds(data, "", codes);
  data.add("share", "1", words::files::share_of_pixels, {kind},
           [&codes](std::size_t k) { return codes[k].share.share; });
  if (!discoveries.empty()) {
    const std::size_t met = data.dimension("discovery", discoveries.size()), width = discoveries.front().size();
    data.add("discovery_state", "1", words::files::state_met_at_pixel, {met, data.dimension("component", width)},
             [&discoveries, width](std::size_t k) { return discoveries[k / width][k % width]; });
  }
  say_attributes(data, header, complete);
  return data;
}

SliceWriter::SliceWriter(const std::string& path, const SliceFileHeader& header, const std::vector<OutcomeShare>& codes,
                         const std::vector<std::vector<double>>& discoveries, bool complete)
    : header_(header), data_(contents(header_, codes, discoveries, complete)), file_(path, data_) {}

void SliceWriter::write_rows(int first, int rows, const SlicePixel* pixels) {
  std::vector<double> numbers(static_cast<std::size_t>(header_.x.pixels) * static_cast<std::size_t>(rows));
  const auto write = [&](std::size_t column, auto SlicePixel::*value) {
    for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = pixels[k].*value;
    file_.write_rows(column, static_cast<std::size_t>(first), static_cast<std::size_t>(rows), numbers.data());
  };
  write(first_of_pixels, &SlicePixel::code);
  visit_pixel_numbers(header_.one_rotor,
                      [&](std::size_t k, float SlicePixel::*value) { write(first_of_pixels + 1 + k, value); });
}

SliceReader::SliceReader(const std::string& path) try : file_(whole_map_file(path), NetcdfFile::Mode::read) {
  x_ = read_axis("x");
  y_ = read_axis("y");
  const std::vector<std::size_t> plane{static_cast<std::size_t>(y_.pixels), static_cast<std::size_t>(x_.pixels)};
  outcome_ = file_.variable("outcome", NC_SHORT, plane);
  one_rotor_ = file_.dimensions("balance_margin") == 0;
  visit_pixel_numbers(one_rotor_, [&](std::size_t k, float SlicePixel::*) {
    numbers_[k] = file_.variable(pixel_numbers[k].name, NC_FLOAT, plane);
  });
} catch (const RunError&) {
  throw InputError(path, "", "", fmt::format(words::files::no_map, words::files::map_file));
}

SliceAxis SliceReader::read_axis(const std::string& letter) const {
  SliceAxis axis;
  axis.key = file_.attribute(letter + "_key");
  const std::size_t pixels = file_.length(letter);
  if (pixels == 0 || pixels > most_slice_pixels) throw RunError(letter + " is no axis");
  axis.pixels = static_cast<int>(pixels);
  const std::string range = file_.attribute(letter + "_range");
  const char* const end = range.data() + range.size();
  const auto low = read_number(range.data(), end, axis.low);
  const auto high = low.end < end ? read_number(low.end + 1, end, axis.high) : low;
  if (high.error != std::errc() || high.end != end || low.end == end) throw RunError(letter + "_range is none");
  return axis;
}

std::vector<OutcomeShare> SliceReader::codes() const {
  std::vector<OutcomeShare> codes = read_outcome_kinds(file_, "");
  std::erase_if(codes, [](const OutcomeShare& c) { return c.id <= 0; });
  return codes;
}

std::vector<std::vector<double>> SliceReader::discoveries(std::size_t components) const {
  std::vector<std::vector<double>> states;
  const std::size_t count = file_.length("discovery");
  if (count == 0) return states;
  const int variable = file_.variable("discovery_state", NC_DOUBLE, {count, components});
  states.assign(count, std::vector<double>(components));
  for (std::size_t k = 0; k < count; ++k) file_.read(variable, {k, 0}, {1, components}, states[k].data());
  return states;
}

template <class T>
void SliceReader::read_column(int variable, int first, int rows, SlicePixel* pixels, T SlicePixel::*value) const {
  const std::size_t columns = static_cast<std::size_t>(x_.pixels);
  std::vector<T> column(columns * static_cast<std::size_t>(rows));
  file_.read(variable, {static_cast<std::size_t>(first), 0}, {static_cast<std::size_t>(rows), columns}, column.data());
  for (std::size_t k = 0; k < column.size(); ++k) pixels[k].*value = column[k];
}

void SliceReader::read_rows(int first, int rows, SlicePixel* pixels) const {
  std::fill_n(pixels, static_cast<std::size_t>(x_.pixels) * static_cast<std::size_t>(rows), SlicePixel{});
  read_column(outcome_, first, rows, pixels, &SlicePixel::code);
  visit_pixel_numbers(one_rotor_, [&](std::size_t k, float SlicePixel::*value) {
    read_column(numbers_[k], first, rows, pixels, value);
  });
}

}  // namespace equipoise::io

namespace equipoise {

void write_map_file(const std::string& path, const BasinSlice& map) {
  const std::size_t size = map.code.size();
  io::SliceFileHeader header{to_toml(map.study), map.x, map.y, map.links, "of " + map.cpu_target};
  header.one_rotor = map.balance_margin.size() != size || size == 1;
  if (header.one_rotor) {
    header.rotor.balance_margin = map.balance_margin.front();
    header.rotor.balance_growth = map.balance_growth.front();
  }
  io::SliceWriter writer(path, header, map.codes, {}, map.complete);
  std::vector<SlicePixel> row(static_cast<std::size_t>(map.x.pixels));
  for (int y = 0; y < map.y.pixels; ++y) {
    for (int x = 0; x < map.x.pixels; ++x) {
      const std::size_t at = map.at(x, y);
      SlicePixel& pixel = row[static_cast<std::size_t>(x)];
      pixel = {map.code[at], map.time[at], map.r_max[at]};
      if (header.one_rotor) continue;
      pixel.balance_margin = map.balance_margin[at];
      pixel.balance_growth = map.balance_growth[at];
    }
    writer.write_rows(y, 1, row.data());
  }
  writer.finish();
}

}  // namespace equipoise
