// One motion as JSON and in words: what lists of attractors say of each.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "equipoise/model/scales.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/types/attractor.hpp"

namespace equipoise {

/// What tables of motions are in: mm, s, rpm and 1/s, or dimensionless.
struct TableUnits {
  double length = 1.0, time = 1.0, speed = 1.0, torque = 1.0, power = 1.0;
  std::string r, period, drift, moment, watts, rate;  // behind the headings, and behind a rate

  explicit TableUnits(const std::optional<model::Scales>& scales);
};

/// The slowest way in which a deviation dies out, shifts in time left out: "stable, slowest rate -0.02510".
std::string stability_text(const Attractor& a, const TableUnits& units);

/// The keys of `equipoise attractors --json`, without shares and state.
nlohmann::ordered_json motion_json(const Attractor& a, const Study& study);

}  // namespace equipoise
