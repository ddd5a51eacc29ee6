// Standards in sentences and as JSON, each figure with the standard that it is from.
#include "equipoise/report/decision/standards_text.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/machine/balance/balance_grade.hpp"
#include "equipoise/machine/standards/hand_arm.hpp"
#include "equipoise/machine/standards/severity.hpp"
#include "equipoise/report/reports/transient_report.hpp"
#include "equipoise/report/text/quantities.hpp"
#include "equipoise/report/text/grade_text.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/report/text/text.hpp"

namespace equipoise {

namespace {

constexpr char no_balls[] = "no balls";

using Judged = JudgedByStandards;

constexpr std::size_t zones = 3, sliding = 3;  // in standard_levels

// The speed in the end, Hz.
double turns_a_second(const BasinResult& r, const TransientGroup& group) {
  const double speed =
      r.study.speed.driven() && group.mean_speed ? *group.mean_speed : r.study.speed_profile().final_speed();
  return std::fabs(speed) * r.study.scales->frequency / two_pi;
}

// m/s^2: of what is judged in the median and in nine of ten, and of the rotor next to it.
struct HandArm {
  double median, ninety;
  std::optional<double> bare;
};

std::optional<HandArm> hand_arm(const Judged& j) {
  const BasinResult& r = j.result;
  if (!r.study.standards.hand_held) return std::nullopt;
  const auto acceleration = [&](const TransientGroup& group, std::size_t quantile) {
    const double velocity = group.figure(&TransientRow::rms_velocity).quantiles[quantile].value;
    return standards::hand_arm_acceleration(turns_a_second(r, group), velocity * r.study.scales->velocity());
  };
  HandArm arms{acceleration(j.all, 0), acceleration(j.all, 1), std::nullopt};
  if (j.beside) arms.bare = acceleration(*j.beside, 0);
  return arms;
}

std::string hours_text(double acceleration, double value) {
  const double hours = standards::hours_to_exposure(acceleration, value);
  return !(hours < 24.0) ? "over 24 h"
         : hours >= 1.0  ? fmt::format("{:.2g} h", hours)
                         : fmt::format("{:.2g} min", 60.0 * hours);
}

DocumentTable hand_arm_table(const HandArm& a, const Judged& j) {
  const Study& study = j.result.study;
  DocumentTable table{{"hand-arm vibration"}};
  std::vector<double> columns;
  const auto add = [&](const char* title, double value) {
    table.header.emplace_back(title);
    columns.push_back(value);
  };
  add(j.one ? no_balls : "median", a.median);
  if (!j.one) add("90 % below", a.ninety);
  if (a.bare) add(no_balls, *a.bare);
  const auto row = [&](const std::string& name, auto&& text) {
    table.rows.push_back({label_cell(name)});
    for (const double value : columns) table.rows.back().push_back(number_cell(text(value)));
  };
  row("a_hv, m/s2", [](double v) { return fmt::format("{:.3g}", v); });
  for (const auto& [value, name] : {std::pair{standards::exposure_action_value, "action value"},
                                    std::pair{standards::exposure_limit_value, "limit value"}})
    row(fmt::format("work until A(8) is {} m/s2, the {}", value, name),
        [&, of = value](double v) { return hours_text(v, of); });
  table.caption = fmt::format(
      "a_hv by ISO 5349-1, a day's exposure A(8) and its values by 2002/44/EC. An estimate, not a declared value: the "
      "handles move as {}, at the speed of rotation only.",
      !study.parameters.tilts() ? "the race's centre"
      : study.bearings.empty()  ? "the shaft at the centre of mass"
                                : "the outermost bearing that moves faster");
  return table;
}

const standards::SeverityClass& class_of(const Study& study) {
  return standards::severity_classes[static_cast<std::size_t>(*study.standards.severity_class)];
}

std::string bare_zone(const BasinResult& r) {
  const TransientGroup& bare = r.without_balls->bare.figures;
  const double velocity =
      1000.0 * bare.figure(&TransientRow::rms_velocity_one_direction).quantiles[0].value * r.study.scales->velocity();
  return standards::zone_names[static_cast<std::size_t>(standards::zone_of(class_of(r.study), velocity))];
}

Block severity(const Judged& j) {
  const BasinResult& r = j.result;
  if (!j.all.beyond[0])
    return Paragraph{
        fmt::format("Severity: at {:.3g} turns per second no zone is given; the band of ISO 10816-1 begins at {} Hz.",
                    turns_a_second(r, j.all), standards::lowest_severity_frequency)};
  const auto& machine = class_of(r.study);
  std::string caption = fmt::format(
      "Without balls: zone {}. Zones of ISO 10816-1:1995, class {} ({}), of {}. ISO 20816-1:2016 took its place; ISO "
      "20816-3 begins at 15 kW.",
      bare_zone(r), machine.name, machine.machines,
      has_directions(r.study) ? "the direction that has more" : "one direction");
  if (j.one) return Paragraph{"Severity: " + caption};
  DocumentTable table{{"severity zone", "ends there", "RMS velocity"}, {}, std::move(caption), false, {}};
  constexpr const char* names[] = {"A, as new", "A or B, for long operation", "A to C; D may damage"};
  for (std::size_t k = 0; k < zones; ++k)
    table.rows.push_back(row_of("lnn", {names[k], share_with_interval(complement(*j.all.beyond[k])),
                                        fmt::format("to {} mm/s", machine.boundaries[k])}));
  return table;
}

std::string sliding_text(const Judged& j) {
  const BasinResult& r = j.result;
  const double level = *sliding_level(r.study), force = r.study.scales->force();
  const TransientGroup& bare = r.without_balls->bare.figures;
  const double without = bare.figure(&TransientRow::peak_force).quantiles[0].value;
  const std::string share =
      j.one ? "" : fmt::format(": so it is in {} of starts", share_with_interval(*j.all.beyond[sliding]));
  return fmt::format(
      "A machine of {:.4g} kg on feet with friction {} may slide when {:.4g} N act on the supports{}; without balls "
      "the peak is {:.4g} N{}. It may turn on its feet at a smaller force [PP].",
      *r.study.standards.standing_mass * r.study.scales->mass, *r.study.standards.friction, level * force, share,
      without * force, without > level ? j.beside ? ", which would also make it slide" : ", enough for that" : "");
}

// What a grade leaves to the rotor at its speed in the end, U_per = M G/omega, and what is left on average; in kg m.
struct Permissible {
  double grade, unbalance, left;  // mm/s, kg m, kg m
  double speed;                   // rad/s
};

// By the grade of [limits], or else the standard's that is met.
std::optional<Permissible> permissible(const Judged& j) {
  const BasinResult& r = j.result;
  const auto left = left_grade(j.all, r.study);
  const double omega = two_pi * turns_a_second(r, j.all), mass = r.study.scales->mass;
  if (!left || !(omega > 0.0)) return std::nullopt;
  const auto& limit = r.study.limits.grade;
  const auto grade =
      limit ? std::optional(1e3 * *limit * r.study.scales->velocity()) : model::standard_grade_met(*left);
  if (!grade) return std::nullopt;
  return Permissible{*grade, 1e-3 * *grade * mass / omega, 1e-3 * *left * mass / omega, omega};
}

std::string permissible_text(const Permissible& p) {
  return fmt::format(" G {:.3g} at {} permits {}; {} is left.", p.grade, engineering(p.speed, study::Dimension::speed),
                     engineering(p.unbalance, study::Dimension::unbalance),
                     engineering(p.left, study::Dimension::unbalance));
}

std::string balance_quality_text(double grade, std::optional<double> beside) {
  if (!beside) return fmt::format("Balance quality e omega [ISO 21940-11]: {}.", grade_text(grade));
  return fmt::format("Balance quality e omega [ISO 21940-11]: {} left on average; without balls {}.", grade_text(grade),
                     grade_text(*beside));
}

}  // namespace

std::optional<JudgedByStandards> judged_by_standards(const BasinResult& r) {
  if (!r.study.scales || !r.without_balls || r.without_balls->bare.figures.starts == 0) return std::nullopt;
  const OneBodyRuns& bare = r.without_balls->bare;
  if (r.study.parameters.balls == 0) return Judged{r, bare.figures, nullptr, bare.one};
  if (!tells_without_balls(r)) return std::nullopt;
  return Judged{r, r.transients->groups.front(), &bare.figures, false};
}

std::vector<Block> standards_blocks(const BasinResult& r) {
  const auto j = judged_by_standards(r);
  if (!j) return {};
  std::vector<Block> blocks;
  const auto allowed = permissible(*j);
  if (const auto grade = left_grade(j->all, r.study))
    if (const auto beside = j->beside ? left_grade(*j->beside, r.study) : std::nullopt; beside || !j->beside)
      blocks.push_back(Paragraph{balance_quality_text(*grade, beside) + (allowed ? permissible_text(*allowed) : "")});
  if (r.study.standards.severity_class) blocks.push_back(severity(*j));
  if (const auto arms = hand_arm(*j)) blocks.push_back(hand_arm_table(*arms, *j));
  if (j->all.beyond[sliding]) blocks.push_back(Paragraph{sliding_text(*j)});
  return blocks;
}

std::vector<std::vector<Block>> balancer_blocks(const BasinResult& r) {
  std::vector<std::vector<Block>> groups;
  if (tells_without_balls(r)) {
    std::vector<Block>& group = groups.emplace_back();
    group.push_back(way_table(r));
    for (const std::string& sentence : without_balls_words(r)) group.push_back(Paragraph{sentence});
  }
  const TransientGroup* all = r.transients ? r.transients->of(std::nullopt) : nullptr;
  if (!all) return groups;
  std::array judged_by{limits_blocks(*all, r.study), standards_blocks(r)};
  for (std::vector<Block>& group : judged_by)
    if (!group.empty()) groups.push_back(std::move(group));
  return groups;
}

void to_json(Json& json, const JudgedByStandards& j) {
  const BasinResult& r = j.result;
  json = Json::object();
  const auto grade = left_grade(j.all, r.study), bare = left_grade(r.without_balls->bare.figures, r.study);
  if (grade && bare) {
    Json& quality = json["balance_quality"];
    if (j.beside) put(quality, "mean", *grade);
    put(quality, "without_balls", *bare, "unit", "mm/s", "source", "ISO 21940-11");
    if (const auto allowed = permissible(j))
      put(json, "permissible_unbalance",
          object("grade", allowed->grade, "unbalance", 1e6 * allowed->unbalance, "left", 1e6 * allowed->left, "unit",
                 "g mm", "source", "ISO 21940-11"));
  }
  if (j.all.beyond[0]) {
    Json within;
    for (std::size_t k = 0; k < zones; ++k) within[standards::zone_names[k]] = sure(complement(*j.all.beyond[k]));
    put(json, "severity",
        object("class", class_of(r.study).name, "without_balls", bare_zone(r), "source", "ISO 10816-1:1995", "within",
               within));
  }
  if (const auto arms = hand_arm(j)) {
    const auto times = [](double a) {
      return object("acceleration", a, "hours_to_action_value",
                    standards::hours_to_exposure(a, standards::exposure_action_value), "hours_to_limit_value",
                    standards::hours_to_exposure(a, standards::exposure_limit_value));
    };
    Json& told = json["hand_arm"];
    if (!j.one) put(told, "median", times(arms->median), "at_most_in_90_percent", times(arms->ninety));
    if (arms->bare || j.one) put(told, "without_balls", times(arms->bare.value_or(arms->median)));
    put(told, "unit", "m/s2", "source", "ISO 5349-1:2001, Directive 2002/44/EC");
  }
  if (j.all.beyond[sliding])
    put(json, "slides",
        object("force", *sliding_level(r.study) * r.study.scales->force(), "unit", "N", "share",
               sure(*j.all.beyond[sliding])));
}

}  // namespace equipoise
