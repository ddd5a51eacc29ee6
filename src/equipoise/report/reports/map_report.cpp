// Basin slices as a document and as JSON.
#include "equipoise/report/reports/reports.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/version.hpp"
#include "equipoise/report/answers/answer.hpp"
#include "equipoise/report/text/motion_words.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/plots/plots.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/report/text/text.hpp"

namespace equipoise {

namespace {

std::string axis_text(const char* letter, const SliceAxis& a, int every) {
  return fmt::format("{}: {} from {:.10g} to {:.10g}, {} pixels{}", letter, a.key, a.low, a.high, a.pixels,
                     every > 1 ? fmt::format(" ({} apart; all are in the output)", every) : "");
}

// Over which distances the exponent holds, and how it changes among them.
std::string scales_text(const SliceFigures& f) {
  if (!f.uncertainty_exponent) return "";
  std::string values;
  for (const LocalExponent& e : f.local_exponents)
    values += fmt::format("{}{:.2f}", values.empty() ? "" : ", ", e.value);
  return fmt::format(
      " The exponent is that of distances from {} to {} pixels; from each distance to its double it is {}.",
      f.local_exponents.front().from, f.local_exponents.back().to, values);
}

// How far single pixels can be trusted.
std::string flipped_text(const SliceFigures& f) {
  return f.flipped ? fmt::format(" With a tolerance {:.0f} times finer, {} of {} pixels tried end elsewhere ({}).",
                                 1.0 / SliceFigures::finer, f.flipped->count, f.flipped->total, interval(*f.flipped))
                   : "";
}

// How basins lie in each other.
DocumentTable figures_table(const SliceFigures& f) {
  DocumentTable table{{"how basins lie in each other", "value", "95 % interval"}};
  const auto row = [&](const char* name, const std::optional<Estimate>& figure) {
    if (figure)
      table.rows.push_back(row_of("tnn", {name, fmt::format("{:.3f}", figure->value),
                                          fmt::format("{:.3f} to {:.3f}", figure->low, figure->high)}));
  };
  row("box dimension of the boundary (1 smooth, 2 fills all)", f.box_dimension);
  row("uncertainty exponent (0: exact starts do not help)", f.uncertainty_exponent);
  row("basin entropy", f.basin_entropy);
  row("boundary basin entropy (above log 2 = 0.693: fractal)", f.boundary_basin_entropy);
  if (f.balanced_radius)
    table.rows.push_back(row_of(
        "tnn", {"all balanced within, around balanced angles", fmt::format("{:.3f} rad", *f.balanced_radius), ""}));
  table.caption = "95 % intervals: of the line fitted through the scales, and over boxes of 5 x 5 pixels." +
                  scales_text(f) + flipped_text(f);
  return table;
}

// Where balls start that neither an axis nor a link places.
std::string starts_text(const BasinSlice& map) {
  if (draws_starts(map))
    return fmt::format("Every pixel draws its own ball angles (seed {}); state initial.phi to start them all alike.",
                       map.study.sampling.seed);
  std::string text;
  for (int i = 1; i <= map.study.parameters.balls; ++i) {
    const std::string key = fmt::format("initial.phi_{}", i);
    const bool tied =
        std::any_of(map.links.begin(), map.links.end(), [&](const AngleLink& link) { return link.ball == i; });
    if (key != map.x.key && key != map.y.key && !tied)
      text += fmt::format("{}phi_{} = {:.6g}", text.empty() ? "" : ", ", i,
                          map.study.initial.phi[static_cast<std::size_t>(i - 1)]);
  }
  if (text.empty()) return text;
  text = fmt::format("All pixels start with {}{}.", text, states_angles(map.study) ? "" : ", evenly spread");
  const bool as_stated = map.links.empty() && !map.x.angle() && !map.y.angle();
  const std::string together = as_stated ? coincident_text(map.study) : "";
  return together.empty() ? text : text + "\nNote: " + together + ".";
}

// Pixels that count in shares.
std::uint64_t counted_pixels(const BasinSlice& map) { return map.pixels - map.pixels_left_out; }

// Pixels that a stopped run did not reach.
std::uint64_t open_pixels(const BasinSlice& map) { return counted_pixels(map) - map.codes.front().share.total; }

// After a stop: bounds whatever the open pixels come to.
std::string part_of_map(const BasinSlice& map, const Share& share) {
  const double all = static_cast<double>(counted_pixels(map)), count = static_cast<double>(share.count);
  const auto percents = [&](double pixels) { return 100.0 * pixels / all; };
  if (map.complete) return fmt::format("{:.2f} %", percents(count));
  return fmt::format("{:.2f} to {:.2f} %", percents(count), percents(count + static_cast<double>(open_pixels(map))));
}

}  // namespace

Document document_of(const BasinSlice& map) {
  const bool physical = map.study.scales.has_value(), any = open_pixels(map) < counted_pixels(map);
  Document document = document_with(map.study, answer_sentence(map), "");
  document.add_lines(axis_text("x", map.x, map.every) + "\n" + axis_text("y", map.y, map.every));
  std::string angles;
  for (const AngleLink& link : map.links)
    angles += fmt::format("phi_{} = phi_{} + {:.10g}\n", link.ball, link.of, link.offset);
  angles += starts_text(map);
  document.add_lines(angles);
  if (!map.complete)
    document.add(Paragraph{
        any ? fmt::format("PARTIAL: stopped with {} of {} pixels open. Shares of the map: the least if no open pixel "
                          "reaches an outcome, the most if all do.",
                          open_pixels(map), counted_pixels(map))
            : fmt::format("PARTIAL: stopped before any of {} pixels was done; nothing is known of the map.",
                          map.pixels),
        Tone::bad});
  document.add(Heading{2, "Where starts end", ""});
  DrawingRow row = map_drawing(map);
  std::replace(angles.begin(), angles.end(), '\n', ' ');
  if (!angles.empty()) row.details += ". " + angles;
  document.add(std::move(row));
  if (map.complete || any) {
    DocumentTable table{{"code", physical ? "what the balls do" : "outcome", "pixels", "of the map"}};
    if (map.complete) {  // the first pixels are not a sample of all
      table.header.emplace_back("95 % interval");
      table.caption = "Pixels lie on a grid; the interval is that of as many random starts.";
      table.spare = {4};
    }
    for (const OutcomeShare& c : map.codes) {
      std::vector<std::string> cells{fmt::format("{}", c.id), reader_title(c, physical),
                                     fmt::format("{}", c.share.count), part_of_map(map, c.share)};
      if (map.complete) cells.push_back(interval(c.share));
      table.rows.push_back(row_of("ntnnn", cells));
    }
    document.add(std::move(table));
  }
  if (DocumentTable figures = figures_table(map.figures); !figures.rows.empty()) document.add(std::move(figures));
  const bool collide = map.study.parameters.balls_collide(), everywhere = !collide && map.balls_together;
  if (everywhere)
    document.add(
        Paragraph{fmt::format("All {} pixels start some alike balls in one place, as you set them.", map.pixels)});
  if (map.pixels_left_out > 0)
    document.add(Paragraph{fmt::format(
        fmt::runtime(
            collide      ? "In {} pixels balls would overlap, which is not a start; shares and figures leave them out."
            : everywhere ? "{} of them start further alike balls in one place, a set of probability zero; shares and "
                           "figures leave these out."
                         : "{} pixels start alike balls in one place, a set of probability zero; shares and figures "
                           "leave them out."),
        map.pixels_left_out)});
  std::string words = fmt::format("{} pixels, a start each, followed until it is known where it ends.", map.pixels);
  if (map.pixels_kept > 0)
    words += fmt::format(" {} of them read from the output, where an earlier run left them.", map.pixels_kept);
  const double now = static_cast<double>(map.pixels_computed - map.pixels_kept);
  add_origin(
      document, map.study, words,
      computed_text(map) + (now > 0.0 ? fmt::format(", {:.0f} pixels/s", now / std::max(map.seconds, 1e-9)) : ""));
  return document;
}

void to_json(Json& json, const SliceAxis& axis) {
  std::vector<double> values;
  for (int k = 0; k < axis.pixels; ++k) values.push_back(axis.centre(k));
  json = object("key", axis.key, "values", values);
}

void to_json(Json& json, const AngleLink& link) {
  json = object("ball", link.ball, "of", link.of, "offset", link.offset);
}

void to_json(Json& json, const LocalExponent& e) { json = object("from", e.from, "to", e.to, "value", e.value); }

void to_json(Json& json, const SliceFigures& f) {
  json = object("box_dimension", f.box_dimension, "uncertainty_exponent", f.uncertainty_exponent, "local_exponents",
                f.local_exponents, "basin_entropy", f.basin_entropy, "boundary_basin_entropy", f.boundary_basin_entropy,
                "balanced_radius", f.balanced_radius, "tolerance_flips", f.flipped);
}

std::string json_text(const BasinSlice& map) {
  const auto code = [](const OutcomeShare& c) {
    return object("id", c.id, "name", c.name, "alias", c.alias, "pixels", c.share.count, "share", c.share.share);
  };
  std::string text = object("x", map.x, "y", map.y, "ties", map.links, "outcomes", list_of(map.codes, code)).dump();
  text.back() = ',';
  text += "\"outcome\":";
  append_rows(text, map.x.pixels, map.y.pixels, [&](std::size_t k) {
    return map.code[k] == not_computed_code ? std::nullopt : std::optional(map.code[k]);
  });
  text += ",\"time\":";
  append_rows(text, map.x.pixels, map.y.pixels,
              [&](std::size_t k) { return std::isfinite(map.time[k]) ? std::optional(map.time[k]) : std::nullopt; });
  Json json = object("figures", map.figures, "partial", !map.complete, "pixels", map.pixels, "pixels_open",
                     open_pixels(map), "pixels_left_out", map.pixels_left_out, "pixels_computed", map.pixels_computed,
                     "pixels_kept", map.pixels_kept, "draws_starts", draws_starts(map), "every", map.every);
  add_computed(json, map);
  return text + "," + json.dump().substr(1) + "\n";
}

}  // namespace equipoise
