// Reads LOW:HIGH, WIDTHxHEIGHT and phi_2=phi_1+pi.
#include "equipoise/analyses/basin_slices/slice_axis.hpp"

#include <charconv>
#include <cmath>
#include <optional>
#include <regex>
#include <string_view>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/read_number.hpp"
#include "equipoise/study/echo/given_value.hpp"
#include "equipoise/study/toml/overrides.hpp"

namespace equipoise {

namespace {

// "2pi", "-pi/2", "0.5*pi".
std::optional<double> part_of_pi(const std::string& text) {
  static const std::regex form(R"(([+-]?)(\d+(?:\.\d*)?|\.\d+)?\*?pi(?:/(\d+(?:\.\d*)?))?)");
  std::smatch m;
  if (!std::regex_match(text, m, form)) return std::nullopt;
  const auto number = [](const std::string& digits) { return digits.empty() ? 1.0 : number_in(digits); };
  return (m[1] == "-" ? -1.0 : 1.0) * number(m[2].str()) * pi / number(m[3].str());
}

// "100 g mm": a number, and letters after it.
bool is_quantity(const std::string& text) {
  static const std::regex form(R"(\s*[+-]?[\d.]+(?:[eE][+-]?\d+)?\s*[A-Za-z%].*)");
  return std::regex_match(text, form);
}

}  // namespace

SliceAxis slice_axis(const Study& study, const std::string& key, const std::string& range, int pixels,
                     const std::string& option) {
  SliceAxis axis{key, 0.0, two_pi, pixels};
  if (range.empty() && axis.angle()) return axis;
  const auto unit = axis.angle() ? std::nullopt : study::unit_of(study, key);
  const std::string allowed = fmt::format("must be LOW:HIGH with two numbers, the first below the second, e.g. {}",
                                          axis.angle() ? "0:2pi"
                                          : unit       ? "1.5:6, or two quantities with units"
                                                       : "1.5:6");
  const auto reject = [&](const std::string& problem) { throw InputError(option, key, display_text(range), problem); };
  const std::size_t colon = range.find(':');
  if (colon == std::string::npos || range.find(':', colon + 1) != std::string::npos) reject(allowed);
  const auto read = [&](const std::string& text) {
    if (const auto angle = part_of_pi(text)) return *angle;
    const study::GivenValue given = study::read_given(text, unit);
    if (given.problem.empty() && std::isfinite(given.value)) return given.value;
    if (!unit && !axis.angle() && is_quantity(text))
      reject(
          !study.scales ? fmt::format("the study is dimensionless, and quantities need scales; {}", allowed)
          : key == "balancer.drag"
              ? fmt::format("{} takes no quantities here, for the balls' masses differ; must be two plain numbers", key)
              : fmt::format("{} takes no quantities here; must be another key, as rotor.eccentricity with millimetres",
                            key));
    reject((unit ? given.problem + "; " : std::string()) + allowed);
    return given.value;
  };
  axis.low = read(range.substr(0, colon));
  axis.high = read(range.substr(colon + 1));
  if (!(axis.low < axis.high)) reject(allowed);
  return axis;
}

void check_axes(const SliceAxis& x, const SliceAxis& y, const char* made, const char* points) {
  for (const SliceAxis* axis : {&x, &y}) {
    if (axis->pixels < 1 || axis->pixels > most_slice_pixels)
      throw InputError(made, axis->key, fmt::format("{}", axis->pixels),
                       fmt::format("{}; must be a whole number from 1 to {}", points, most_slice_pixels));
    if (!std::isfinite(axis->low) || !std::isfinite(axis->high) || !(axis->low < axis->high))
      throw InputError(made, axis->key, fmt::format("{} to {}", axis->low, axis->high),
                       "must be two finite numbers, the first below the second");
  }
  if (x.key == y.key) throw InputError(made, x.key, "", "both axes vary the same key; must be two");
}

SliceSize map_size(const std::string& text, const std::string& option) {
  SliceSize size;
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  bool good = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
  if (good) {
    const auto height = std::from_chars(width.ptr + 1, end, size.height);
    good = height.ec == std::errc() && height.ptr == end;
  }
  const auto allowed = [](int pixels) { return pixels >= 1 && pixels <= most_slice_pixels; };
  if (!good || !allowed(size.width) || !allowed(size.height))
    throw InputError(
        option, "", display_text(text),
        fmt::format("must be WIDTHxHEIGHT, each a whole number from 1 to {}, e.g. 512x512", most_slice_pixels));
  return size;
}

InputError under_names(const InputError& e, const SliceAxis& x, const SliceAxis& y, const PlaneNames& names) {
  const char* axis = e.key() == x.key ? names.x : e.key() == y.key ? names.y : nullptr;
  const bool overridden = axis && e.where() == overrides_name;
  if (!overridden && e.where() != "stability" && e.where() != "map") return e;
  const bool size = e.key() == "size";
  return InputError(axis ? axis : size ? names.size : names.made, size ? "" : e.key(), e.value(), e.problem());
}

AngleLink angle_link(const std::string& text, const std::string& option) {
  static const std::regex form(R"((?:initial\.)?phi_(\d)=(?:initial\.)?phi_(\d)([+-].+)?)");
  const auto reject = [&] {
    throw InputError(option, "", display_text(text), "must be phi_I=phi_J or phi_I=phi_J+ANGLE, e.g. phi_2=phi_1+pi");
  };
  std::smatch m;
  if (!std::regex_match(text, m, form)) reject();
  AngleLink link{std::stoi(m[1].str()), std::stoi(m[2].str()), 0.0};
  const std::string offset = m[3].str();
  if (offset.empty()) return link;
  if (const auto angle = part_of_pi(offset)) {
    link.offset = *angle;
    return link;
  }
  const auto number = number_of_all(std::string_view(offset).substr(offset.front() == '+' ? 1 : 0));
  if (!number || !std::isfinite(*number)) reject();
  link.offset = *number;
  return link;
}

}  // namespace equipoise
