// One motion as JSON and in words, for lists of attractors.
#pragma once

#include <optional>
#include <string>

#include "equipoise/machine/datasheet/scales.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/results/types/attractor.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Units of tables of motions: mm, s, rpm and 1/s, or dimensionless.
struct TableUnits {
  double length = 1.0, time = 1.0, speed = 1.0, torque = 1.0, power = 1.0;
  std::string r, period, drift, moment, watts, rate;  // after the headings, and after a rate

  explicit TableUnits(const std::optional<model::Scales>& scales);
};

/// The slowest decay of a deviation, without shifts in time: "stable, slowest rate -0.02510".
std::string stability_text(const Attractor& a, const TableUnits& units);

void to_json(Json& json, const ContinuumPart& part);
/// The keys of `equipoise attractors --json`, without shares and state.
Json motion_json(const Attractor& a, const Study& study);

}  // namespace equipoise
