// Dimensions, variables and attributes of a basin slice; its rows written as they come, and read on demand.
#include <algorithm>
#include <limits>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/read_number.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/results/io/sealed_file.hpp"
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

// flag_meanings are words separated by blanks.
std::string slice_flag_meanings(const std::vector<OutcomeShare>& codes) {
  std::string text;
  for (const OutcomeShare& c : codes) text += (text.empty() ? "" : " ") + flag_word(c.name);
  return text;
}

std::string links_text(const std::vector<AngleLink>& links) {
  std::string text;
  for (const AngleLink& link : links)
    text += fmt::format("{}phi_{} = phi_{} + {}", text.empty() ? "" : "; ", link.ball, link.of, link.offset);
  return text;
}

}  // namespace

std::string identity_of(const SliceFileHeader& h) {
  const auto range = [](const SliceAxis& a) { return fmt::format("{} to {} in {} pixels", a.low, a.high, a.pixels); };
  return fmt::format(
      "{}\n[file]\nversion = {}\narithmetic = {}\nx = {}\ny = {}\nties = {}\nx_range = {}\ny_range = {}\n", h.study,
      version_string, h.arithmetic, h.x.key, h.y.key, h.links.empty() ? "none" : links_text(h.links), range(h.x),
      range(h.y));
}

SliceWriter::SliceWriter(const std::string& path, const SliceFileHeader& header, const std::vector<OutcomeShare>& codes,
                         const std::vector<std::vector<double>>& discoveries, bool complete)
    : header_(header), path_(path), place_(path, ".new"), file_(place_.file(), NetcdfFile::Mode::create, path) {
  for (const OutcomeShare& c : codes) {
    names_.push_back(c.name);
    aliases_.push_back(c.alias);
  }
  define(codes, discoveries, complete);
  write_axis(x_, header.x);
  write_axis(y_, header.y);
  for (std::size_t k = 0; k < codes.size(); ++k) {
    const auto code = static_cast<short>(codes[k].id);
    file_.write(code_, {k}, {1}, &code);
  }
  file_.write_texts(name_, names_);
  file_.write_texts(alias_, aliases_);
  for (std::size_t k = 0; k < discoveries.size(); ++k)
    file_.write(discovery_, {k, 0}, {1, discoveries[k].size()}, discoveries[k].data());
  for (std::size_t k = 0; k < numbers_.size(); ++k)
    if (header.one_rotor && pixel_numbers[k].of_rotor)
      file_.write(numbers_[k], {}, {}, &(header.rotor.*pixel_numbers[k].value));
}

void SliceWriter::define(const std::vector<OutcomeShare>& codes, const std::vector<std::vector<double>>& discoveries,
                         bool complete) {
  const int y = file_.dimension("y", static_cast<std::size_t>(header_.y.pixels));
  const int x = file_.dimension("x", static_cast<std::size_t>(header_.x.pixels));
  const int kind = file_.dimension("outcome_kind", codes.size());
  const auto axis = [&](const char* name, int dimension, const SliceAxis& a) {
    return file_.variable(name, NC_DOUBLE, {dimension}, a.angle() ? "radian" : "1", a.key);
  };
  x_ = axis("x", x, header_.x);
  y_ = axis("y", y, header_.y);
  define_pixels(y, x, codes);
  code_ = file_.variable("code", NC_SHORT, {kind}, "1", "value of outcome");
  name_ = file_.text_variable("name", kind, names_, words::files::name_of_outcome);
  alias_ = file_.text_variable("alias", kind, aliases_, words::files::name_by_wright_and_peng);
  share_ = file_.variable("share", NC_DOUBLE, {kind}, "1", words::files::share_of_pixels);
  if (!discoveries.empty()) {
    const int met = file_.dimension("discovery", discoveries.size());
    const int component = file_.dimension("component", discoveries.front().size());
    discovery_ = file_.variable("discovery_state", NC_DOUBLE, {met, component}, "1", words::files::state_met_at_pixel);
  }
  define_attributes(complete);
  file_.leave_unfilled();
  file_.end_definitions();
}

void SliceWriter::define_pixels(int y, int x, const std::vector<OutcomeShare>& codes) {
  outcome_ = file_.variable("outcome", NC_SHORT, {y, x}, "1", words::files::outcome_of_pixel);
  file_.fill(outcome_, &not_computed_code);
  std::vector<short> values;
  for (const OutcomeShare& c : codes) values.push_back(static_cast<short>(c.id));
  file_.attribute(outcome_, "flag_values", values);
  file_.attribute(outcome_, "flag_meanings", slice_flag_meanings(codes));
  const float none = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t k = 0; k < numbers_.size(); ++k) {
    const PixelNumber& n = pixel_numbers[k];
    const bool one = header_.one_rotor && n.of_rotor;
    numbers_[k] =
        file_.variable(n.name, NC_FLOAT, one ? std::vector<int>{} : std::vector<int>{y, x}, "1", n.long_name());
    file_.fill(numbers_[k], &none);
  }
}

void SliceWriter::define_attributes(bool complete) {
  const auto say = [&](const char* name, const std::string& text) { file_.attribute(NC_GLOBAL, name, text); };
  const auto range = [](const SliceAxis& a) { return fmt::format("{} {}", a.low, a.high); };
  const auto axis = [](const SliceAxis& a) {
    return fmt::format(words::files::axis_of_map, a.key, a.low, a.high, a.pixels);
  };
  say("Conventions", "CF-1.8");
  say("title", words::files::over_a_plane);
  say("source", fmt::format("equipoise {}", version_string));
  say("identity", identity_of(header_));
  say("x_key", header_.x.key);
  say("y_key", header_.y.key);
  say("x_range", range(header_.x));
  say("y_range", range(header_.y));
  say("axes", fmt::format("{}; {}", axis(header_.x), axis(header_.y)));
  say("links", links_text(header_.links));
  say("study", header_.study);
  say("complete", complete ? "yes" : "no");
}

void SliceWriter::write_axis(int variable, const SliceAxis& axis) {
  std::vector<double> centres;
  for (int k = 0; k < axis.pixels; ++k) centres.push_back(axis.centre(k));
  file_.write(variable, {0}, {centres.size()}, centres.data());
}

template <class T>
void SliceWriter::write_column(int variable, int first, int rows, const SlicePixel* pixels, T SlicePixel::*value) {
  const std::size_t columns = static_cast<std::size_t>(header_.x.pixels);
  std::vector<T> column;
  for (std::size_t k = 0; k < columns * static_cast<std::size_t>(rows); ++k) column.push_back(pixels[k].*value);
  file_.write(variable, {static_cast<std::size_t>(first), 0}, {static_cast<std::size_t>(rows), columns}, column.data());
}

void SliceWriter::write_rows(int first, int rows, const SlicePixel* pixels) {
  write_column(outcome_, first, rows, pixels, &SlicePixel::code);
  visit_pixel_numbers(header_.one_rotor, [&](std::size_t k, float SlicePixel::*value) {
    write_column(numbers_[k], first, rows, pixels, value);
  });
}

void SliceWriter::finish(const std::vector<OutcomeShare>& codes) {
  for (std::size_t k = 0; k < codes.size(); ++k) file_.write(share_, {k}, {1}, &codes[k].share.share);
  file_.close();
  seal(place_.file(), path_);
  place_.commit();
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
  std::vector<OutcomeShare> codes;
  const std::size_t kinds = file_.length("outcome_kind");
  const int variable = file_.variable("code", NC_SHORT, {kinds});
  for (std::size_t k = 0; k < kinds; ++k) {
    short code = 0;
    file_.read(variable, {k}, {1}, &code);
    if (code > 0) codes.push_back({code, file_.read_text("name", k), file_.read_text("alias", k)});
  }
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
  writer.finish(map.codes);
}

}  // namespace equipoise
