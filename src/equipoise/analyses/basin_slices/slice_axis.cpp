// Reads LOW:HIGH, WIDTHxHEIGHT and phi_2=phi_1+pi.
#include "equipoise/analyses/basin_slices/slice_axis.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/read_number.hpp"
#include "equipoise/study/echo/given_value.hpp"
#include "equipoise/study/toml/overrides.hpp"

namespace equipoise {

namespace {

// The number without a sign at the front of `text`, which loses it; 1 if there is none.
std::optional<double> leading_number(std::string_view& text) {
  const std::string_view digits = text.substr(0, text.find_first_not_of("0123456789."));
  text.remove_prefix(digits.size());
  return digits.empty() ? 1.0 : number_of_all(digits);
}

// "2pi", "-pi/2", "0.5*pi".
std::optional<double> part_of_pi(std::string_view text) {
  const double sign = text.starts_with('-') ? -1.0 : 1.0;
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  const std::optional<double> factor = leading_number(text);
  if (text.starts_with('*')) text.remove_prefix(1);
  if (!factor || !text.starts_with("pi")) return std::nullopt;
  text.remove_prefix(2);
  if (text.empty()) return sign * *factor * pi;
  if (text.front() != '/' || text.size() == 1) return std::nullopt;
  text.remove_prefix(1);
  const std::optional<double> divisor = leading_number(text);
  return divisor && text.empty() ? std::optional(sign * *factor * pi / *divisor) : std::nullopt;
}

// "100 g mm": a number, and letters after it.
bool is_quantity(std::string_view text) {
  const auto skip = [&](const char* these) {
    const std::size_t end = std::min(text.find_first_not_of(these), text.size());
    text.remove_prefix(end);
    return end;
  };
  skip(" \t");
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  if (skip("0123456789.") == 0) return false;
  skip(" \t");
  return !text.empty() && (text[0] == '%' || std::isalpha(static_cast<unsigned char>(text[0])));
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
  const std::vector<std::string> ends = parts_of(range, ':');
  if (ends.size() != 2) reject(allowed);
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
  axis.low = read(ends[0]);
  axis.high = read(ends[1]);
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
  const auto reject = [&] {
    throw InputError(option, "", display_text(text), "must be phi_I=phi_J or phi_I=phi_J+ANGLE, e.g. phi_2=phi_1+pi");
  };
  std::string_view offset = text;
  const auto take = [&](std::string_view word) {
    const bool there = offset.starts_with(word);
    if (there) offset.remove_prefix(word.size());
    return there;
  };
  const auto ball = [&] {
    take("initial.");
    if (!take("phi_") || offset.empty() || offset[0] < '0' || offset[0] > '9') reject();
    const int number = offset[0] - '0';
    offset.remove_prefix(1);
    return number;
  };
  AngleLink link;
  link.ball = ball();
  if (!take("=")) reject();
  link.of = ball();
  if (offset.empty()) return link;
  if ((offset[0] != '+' && offset[0] != '-') || offset.size() == 1) reject();
  if (const auto angle = part_of_pi(offset)) {
    link.offset = *angle;
    return link;
  }
  const auto number = number_of_all(offset.substr(offset[0] == '+' ? 1 : 0));
  if (!number || !std::isfinite(*number)) reject();
  link.offset = *number;
  return link;
}

}  // namespace equipoise
