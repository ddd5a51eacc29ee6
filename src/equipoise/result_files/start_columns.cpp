// The list of columns and their values.
#include "equipoise/result_files/start_columns.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/result_files/basin_file.hpp"
#include "equipoise/types/outcomes.hpp"

namespace equipoise::io {

const float missing_figure = NC_FILL_FLOAT;

std::vector<StartColumn> start_columns(const BasinFileHeader& header) {
  const std::size_t balls = static_cast<std::size_t>(header.balls);
  std::vector<StartColumn> columns;
  if (header.angles)
    columns.push_back({"phi", NC_DOUBLE, 8, balls, "ball", "radian",
                       "initial ball angle from the direction of the centre of mass, rotating frame"});
  if (header.full_starts) {
    columns.push_back({"rotor_state", NC_DOUBLE, 8, 4, "rotor_component", "1",
                       "initial x, y in race radii and x_dot, y_dot, their derivatives in the rotating frame"});
    columns.push_back({"phi_dot", NC_DOUBLE, 8, balls, "ball", "1",
                       "initial rate of a ball in the rotating frame, radians times omega_c"});
  }
  if (!header.own_starts.empty())
    columns.push_back({"psi", NC_DOUBLE, 8, 1, "", "radian", "initial angle of the rotor"});
  if (!header.drawn.empty())
    columns.push_back({"drawn", NC_DOUBLE, 8, header.drawn.size(), "uncertain_value", "1",
                       "uncertain values that the start drew, each in uncertain_unit"});
  if (header.method == SamplingMethod::grid)
    columns.push_back({"weight", NC_DOUBLE, 8, 1, "", "1", "cells of the grid that the start's cell stands for"});
  if (header.transients)
    for (const TransientColumn& c : transient_columns)
      columns.push_back({c.name, NC_FLOAT, 4, 1, "", "1", c.long_name});
  std::string others;
  for (const NoAttractor& n : no_attractors)
    others += fmt::format("{}{} {}", others.empty() ? "" : ", ", n.code, n.name);
  columns.push_back({"outcome", NC_SHORT, 2, 1, "", "1", "attractor that the start came to (kind_code), or " + others});
  columns.push_back(
      {"decision_time", NC_DOUBLE, 8, 1, "", "1", "study time at which the outcome was known, in 1/omega_c"});
  if (header.driven)
    columns.push_back(
        {"mean_speed", NC_FLOAT, 4, 1, "", "1",
         "mean rotor speed in the motion that the start came to, of an undecided one when it was last seen, in "
         "omega_c; missing where never measured"});
  if (header.sticks)
    columns.push_back({"left_unbalance", NC_FLOAT, 4, 1, "", "1",
                       "unbalance that is left where dry friction holds the balls, in rotor masses times race radii; "
                       "missing where it holds none"});
  if (header.touches)
    columns.push_back(
        {"balls_met", NC_BYTE, 1, 1, "", "1", "1 where balls touched before the outcome was known, else 0"});
  columns.push_back({"decided_by", NC_BYTE, 1, 1, "", "1", "grounds on which the outcome was decided"});
  return columns;
}

namespace {

template <class T, class Value>
void put(std::vector<char>& bytes, std::size_t count, const Value& value_of) {
  for (std::size_t i = 0; i < count; ++i) {
    const T value = value_of(i);
    const char* from = reinterpret_cast<const char*>(&value);
    bytes.insert(bytes.end(), from, from + sizeof value);
  }
}

void put_given(std::vector<char>& bytes, std::size_t count, const double* values) {
  const char* from = reinterpret_cast<const char*>(values);
  bytes.insert(bytes.end(), from, from + count * sizeof(double));
}

}  // namespace

std::vector<char> pack(const std::vector<StartColumn>& columns, const StartBatch& b) {
  std::vector<char> bytes;
  for (const StartColumn& c : columns) {
    const double* given = c.name == "phi"           ? b.phi
                          : c.name == "rotor_state" ? b.rotor
                          : c.name == "phi_dot"     ? b.phi_dot
                          : c.name == "psi"         ? b.psi
                          : c.name == "drawn"       ? b.drawn
                          : c.name == "weight"      ? b.weight
                                                    : nullptr;
    if (given)
      put_given(bytes, b.count * c.width, given);
    else if (c.name == "outcome")
      put<short>(bytes, b.count, [&](std::size_t i) { return code_of(b.fates[i]); });
    else if (c.name == "decision_time")
      put<double>(bytes, b.count, [&](std::size_t i) { return b.fates[i].time; });
    else if (c.name == "mean_speed")
      put<float>(bytes, b.count, [&](std::size_t i) {
        const float speed = b.fates[i].mean_speed;
        return std::isfinite(speed) ? speed : missing_figure;
      });
    else if (c.name == "left_unbalance")
      put<float>(bytes, b.count, [&](std::size_t i) {
        const float left = b.fates[i].unbalance;
        return std::isfinite(left) ? left : missing_figure;
      });
    else if (c.name == "balls_met")
      put<signed char>(bytes, b.count, [&](std::size_t i) { return static_cast<signed char>(b.fates[i].met); });
    else if (c.name == "decided_by")
      put<signed char>(bytes, b.count, [&](std::size_t i) { return static_cast<signed char>(b.fates[i].by); });
    else
      for (const TransientColumn& figure : transient_columns)
        if (c.name == figure.name)
          put<float>(bytes, b.count, [&](std::size_t i) {
            const float value = b.rows[i].*figure.value;
            return std::isfinite(value) ? value : missing_figure;
          });
  }
  return bytes;
}

bool fate_from(short code, signed char by, double time, Fate& fate) {
  const auto none =
      std::find_if(no_attractors.begin(), no_attractors.end(), [&](const auto& n) { return n.code == code; });
  if ((code <= 0 && none == no_attractors.end()) || by < 0 || by >= decided_by_count) return false;
  fate.outcome = code > 0 ? Outcome::attracted : none->outcome;
  fate.attractor = std::max<short>(code, 0);
  fate.by = static_cast<DecidedBy>(by);
  fate.time = time;
  return true;
}

}  // namespace equipoise::io
