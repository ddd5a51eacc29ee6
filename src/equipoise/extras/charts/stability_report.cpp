// Sentences, a small table and notes; rows of numbers.
#include "equipoise/extras/charts/plane_reports.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/plots/plane_frame.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/report/text/csv.hpp"
#include "equipoise/report/text/quantities.hpp"
#include "equipoise/report/text/motion_words.hpp"
#include "equipoise/study/echo/given_value.hpp"

namespace equipoise {

namespace {

constexpr std::array balance_kinds{BalanceKind::stable, BalanceKind::unstable, BalanceKind::none, BalanceKind::marginal,
                                   BalanceKind::unknown};

// A value of a key: dimensionless, and in its unit where the study has one.
std::string parameter_text(const Study& study, const std::string& key, double value) {
  const std::string plain = fmt::format("{:.6g}", value);
  const auto unit = study::unit_of(study, key);
  return unit ? fmt::format("{} ({})", plain, engineering(value * unit->scale, unit->dimension)) : plain;
}

std::string part_text(const StabilityPlane& plane, BalanceKind kind) {
  return part_words(static_cast<double>(plane.count(kind)) / static_cast<double>(plane.points.size()));
}

std::string parts_sentence(const StabilityPlane& plane) {
  const std::string x = key_words(plane.x.key), y = key_words(plane.y.key);
  const char* balance =
      plane.one_of_many() ? "balance with the balls spread evenly, one state of a continuum," : "balance";
  const std::size_t missing = plane.count(BalanceKind::not_computed);
  if (missing == plane.points.size()) return fmt::format("Over {} and {}, nothing was computed (PARTIAL).", x, y);
  std::vector<std::string> parts;
  for (const BalanceKind kind : balance_kinds) {
    const std::size_t count = plane.count(kind);
    if (count == plane.points.size())
      return fmt::format("Over {} and {}, {} is {} at every point of the grid.", x, y, balance, balance_words(kind));
    if (count > 0) parts.push_back(fmt::format("{} in {}", balance_words(kind), part_text(plane, kind)));
  }
  std::string text;
  for (std::size_t k = 0; k < parts.size(); ++k)
    text += (k == 0 ? "" : k + 1 == parts.size() ? " and " : ", ") + parts[k];
  if (missing > 0)
    text += fmt::format("; {} of the plane was not computed (PARTIAL)", part_text(plane, BalanceKind::not_computed));
  return fmt::format("Over {} and {}, {} is {}.", x, y, balance, text);
}

std::string own_words(const StabilityPlane& plane, const BalancePoint& p) {
  const PageQuantities quantities(plane.study);
  const auto time = [&] { return quantities.text(1.0 / std::fabs(p.growth), study::Dimension::time); };
  const std::string swings =
      p.swings() ? fmt::format(", swinging at {}", quantities.text(p.frequency, study::Dimension::speed)) : "";
  switch (p.kind) {
    case BalanceKind::stable:
      return fmt::format("it is stable: the slowest deviation falls to 1/e in {}{}", time(), swings);
    case BalanceKind::unstable:
      return fmt::format("it is unstable: a deviation grows by a factor e in {}{} ({} unstable {})", time(), swings,
                         p.unstable, p.unstable == 1 ? "eigenvalue" : "eigenvalues");
    case BalanceKind::none:
      return "no balanced state exists";
    case BalanceKind::marginal:
      return "linear theory does not decide: the slowest deviation hardly changes";
    default:
      return "no balanced motion was found";
  }
}

std::string continuum_sentence(const StabilityPlane& plane, const ContinuumPart& part) {
  const PageQuantities quantities(plane.study);
  const bool all = part.stable == part.drawn;
  std::string text = part.slowest_rate == 0.0 ? "all are unstable"
                     : part.stable == 0       ? "all are unstable, though stable ones were found next to them"
                                              : fmt::format("{} are stable", all ? "all" : std::to_string(part.stable));
  if (part.stable > 0)
    text += fmt::format(": their slowest deviations fall to 1/e in {}",
                        quantities.range(-1.0 / part.fastest_rate, -1.0 / part.slowest_rate, study::Dimension::time));
  if (part.most_growth > 0.0)
    text += fmt::format("; deviations of unstable ones grow by a factor e in {} or more",
                        quantities.text(1.0 / part.most_growth, study::Dimension::time));
  return fmt::format("Of {} balanced states drawn evenly from the continuum {}.", part.drawn, text);
}

std::string boundary_sentence(const StabilityPlane& plane, const BalanceBoundary& b) {
  using Change = BalanceBoundary::Change;
  const std::string& key = b.along_x ? plane.x.key : plane.y.key;
  const char* way = b.upwards ? "larger" : "smaller";
  const std::string at = parameter_text(plane.study, key, b.value);
  if (b.change == Change::none)
    return fmt::format("With a {} {} nothing changes {} to the plane's end, {}.", way, key_words(key),
                       b.upwards ? "up" : "down", at);
  const bool existed = plane.own->point.kind != BalanceKind::none;
  const std::string what = b.change == Change::hopf
                               ? fmt::format("a pair of eigenvalues crosses (Hopf), at frequency {}",
                                             PageQuantities(plane.study).text(b.frequency, study::Dimension::speed))
                           : b.change == Change::zero ? "a real eigenvalue crosses zero"
                           : b.change == Change::lost ? "beyond it no balanced motion is found"
                           : b.change == Change::jump ? "there it jumps, as where a motor comes to hold another speed"
                           : existed                  ? "the balanced state ends"
                                                      : "a balanced state begins to exist";
  return fmt::format("With a {} {} this changes at {}: {}.", way, key_words(key), at, what);
}

}  // namespace

const char* balance_words(BalanceKind kind) {
  constexpr std::array words{"impossible", "stable", "unstable", "undecided by linear theory", "not found"};
  const auto place = static_cast<std::size_t>(kind);
  return place < words.size() ? words[place] : words.back();
}

std::string stability_answer(const StabilityPlane& plane) {
  std::string text = parts_sentence(plane);
  if (!plane.own) return text;
  const auto own = [&](const SliceAxis& axis, double value) {
    return fmt::format("{} = {}", axis.key, parameter_text(plane.study, axis.key, value));
  };
  text += " " + fmt::format("At the study's own values, {} and {}, {}.", own(plane.x, plane.own->x),
                            own(plane.y, plane.own->y), own_words(plane, plane.own->point));
  if (plane.own->continuum) text += " " + continuum_sentence(plane, *plane.own->continuum);
  if (plane.own->boundaries.empty()) text += std::string(" ") + "These values lie outside the plane.";
  for (const BalanceBoundary& b : plane.own->boundaries) text += " " + boundary_sentence(plane, b);
  return text;
}

std::string plane_notes(const StabilityPlane& plane) {
  std::string text;
  constexpr std::array<std::pair<LeftOut, const char*>, 4> all{
      {{dry_friction_left_out, "dry friction"},
       {gravity_left_out, "gravity"},
       {unequal_supports_left_out, "the difference between the supports in x and y"},
       {motor_left_out, "what the motor does about deviations of the speed"}}};
  const std::size_t exists = plane.count_if([](const BalancePoint& p) { return std::isfinite(p.growth); });
  for (const auto& [bit, name] : all) {
    const std::size_t points = plane.count_if([bit = bit](const BalancePoint& p) { return (p.left_out & bit) != 0; });
    if (points > 0)
      text += fmt::format("At {} {} is left out.\n",
                          points >= exists ? "all points" : fmt::format("{} point{}", points, plural(points)), name);
  }
  if (plane.one_of_many())
    text +=
        "The balanced states form a continuum. What is called stable or unstable, and its rates, are those of one of "
        "them, with the balls spread evenly: laid end to end in their order, unbalance and balls are a polygon "
        "inscribed in a circle.\n";
  if (plane.of_several())
    text +=
        "The balls balance in several states, whose rates differ. What is called stable or unstable, and its rates, "
        "are those of the most stable state at each point; others may be unstable there.\n";
  if (plane.contact()) text += "Balls at rest in balance do not touch, so contact plays no part.\n";
  if (plane.count_if([](const BalancePoint& p) { return p.by_multipliers && std::isfinite(p.growth); }) > 0)
    text +=
        "The equations depend on the rotor's angle: rates are those of multipliers, and frequencies are known but for "
        "whole turns.\n";
  const std::size_t left = plane.count(BalanceKind::not_computed);
  if (left > 0)
    text += fmt::format("PARTIAL: {} of {} points were computed.\n", plane.points.size() - left, plane.points.size());
  else if (!plane.complete)
    text += "PARTIAL: stopped before all changes next to the study's own values were found.\n";
  return text;
}

std::string axes_text(const StabilityPlane& plane) {
  std::string text;
  for (const auto& [letter, axis] : {std::pair{"x", &plane.x}, {"y", &plane.y}})
    text += fmt::format("{}: {} from {} to {} in {} points\n", letter, axis->key,
                        parameter_text(plane.study, axis->key, axis->low),
                        parameter_text(plane.study, axis->key, axis->high), axis->pixels);
  return text;
}

Document document_of(const StabilityPlane& plane) {
  Document document = document_with(plane.study, stability_answer(plane), axes_text(plane));
  DocumentTable table{{"balance is", "points", "of the plane", "rates, omega_c"}};
  for (const BalanceKind kind : balance_kinds) {
    double low = INFINITY, high = -INFINITY;
    for (const BalancePoint& p : plane.points)
      if (p.kind == kind && std::isfinite(p.growth)) low = std::min(low, p.growth), high = std::max(high, p.growth);
    if (plane.count(kind) == 0) continue;
    table.rows.push_back(
        row_of("tnnn", {balance_words(kind), fmt::format("{}", plane.count(kind)), part_text(plane, kind),
                        low <= high ? fmt::format("{:.3g} to {:.3g}", low, high) : ""}));
  }
  if (const std::size_t missing = plane.count(BalanceKind::not_computed); missing > 0)
    table.rows.push_back(
        row_of("tnnn", {"not computed", fmt::format("{}", missing), part_text(plane, BalanceKind::not_computed), ""}));
  document.add(stability_drawing(plane));
  document.add(std::move(table));
  document.add_lines(plane_notes(plane));
  const std::size_t computed = plane.points.size() - plane.count(BalanceKind::not_computed);
  document.add(Paragraph{fmt::format("{} points; {}, {:.0f} points/s; equipoise {}", computed, computed_text(plane),
                                     static_cast<double>(computed) / std::max(plane.seconds, 1e-9), version_string)});
  return document;
}

void to_json(Json& json, const BalanceBoundary& b) {
  json = object("axis", b.along_x ? "x" : "y", "upwards", b.upwards, "change",
                boundary_change_names[static_cast<std::size_t>(b.change)], "value", b.value, "frequency", b.frequency);
}

void to_json(Json& json, const OwnPoint& own) {
  json = object("x", own.x, "y", own.y);
  for (const PointNumber& n : point_numbers) {
    const double value = n.value(own.point);
    json[n.name] = n.whole ? Json(static_cast<int>(value)) : Json(value);
  }
  put(json, "continuum", own.continuum, "boundaries", own.boundaries);
}

std::string json_text(const StabilityPlane& plane) {
  Json points;
  for (std::size_t k = 0; k < balance_kind_names.size(); ++k)
    points[balance_kind_names[k]] = plane.count(static_cast<BalanceKind>(k));
  std::string text = object("x", plane.x, "y", plane.y, "answer", stability_answer(plane), "one_of_many",
                            plane.one_of_many(), "of_several", plane.of_several(), "points", points, "own", plane.own)
                         .dump();
  text.pop_back();
  for (const PointNumber& n : point_numbers) {
    text += fmt::format(",\"{}\":", n.name);
    append_rows(text, plane.x.pixels, plane.y.pixels, [&](std::size_t k) {
      const double value = n.value(plane.points[k]);
      return std::isfinite(value) ? std::optional(value) : std::nullopt;
    });
  }
  Json json = object("partial", !plane.complete);
  add_computed(json, plane);
  return text + "," + json.dump().substr(1) + "\n";
}

std::string stability_csv(const StabilityPlane& plane) {
  std::string text =
      plane.complete ? "" : fmt::format("# equipoise {}: stability, PARTIAL: stopped early\n", version_string);
  const PlaneColumns axes(plane.study, plane.x, plane.y);
  text += axes.titles;
  for (const PointNumber& n : point_numbers) text += "," + csv_title(n, plane.study.scales);
  text += "\n";
  for (int row = 0; row < plane.y.pixels; ++row)
    for (int column = 0; column < plane.x.pixels; ++column) {
      text += axes.values(plane.x.centre(column), plane.y.centre(row));
      text += csv_numbers(point_numbers, plane.points[plane.at(column, row)]) + "\n";
    }
  return text;
}

}  // namespace equipoise
