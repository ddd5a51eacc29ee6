// The list of columns and their values.
#include "equipoise/results/result_files/start_columns.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include <fmt/format.h>

#include "equipoise/results/result_files/basin_file.hpp"

namespace equipoise::io {

namespace {

using study::Dimension;

template <class T>
constexpr DataColumn::Type data_type = std::is_same_v<T, double>  ? DataColumn::Type::real
                                       : std::is_same_v<T, float> ? DataColumn::Type::single
                                       : std::is_same_v<T, short> ? DataColumn::Type::small
                                                                  : DataColumn::Type::byte;

template <class T>
StartColumn column_of(const Column& told, std::vector<T> StartArrays::*values, std::size_t width = 1,
                      const char* along = "") {
  return {{told, data_type<T>, width, along}, values};
}

const char* outcome_meaning() {
  static const std::string text = [] {
    std::string others;
    for (const NoAttractor& n : no_attractors)
      others += fmt::format("{}{} {}", others.empty() ? "" : ", ", n.code, n.name);
    return "attractor that the start came to (kind_code), or " + others;
  }();
  return text.c_str();
}

}  // namespace

std::vector<StartColumn> start_columns(const BasinFileHeader& header) {
  const std::size_t balls = static_cast<std::size_t>(header.balls);
  std::vector<StartColumn> columns;
  const auto add = [&](bool kept, const StartColumn& column) {
    if (kept) columns.push_back(column);
  };
  add(header.angles, column_of({"phi", "initial ball angle from the direction of the centre of mass, rotating frame",
                                Dimension::angle},
                               &StartArrays::phi, balls, "ball"));
  add(header.full_starts,
      column_of({"rotor_state", "initial x, y in race radii and x_dot, y_dot, their derivatives in the rotating frame"},
                &StartArrays::rotor_state, 4, "rotor_component"));
  add(header.full_starts, column_of({"phi_dot", "initial rate of a ball in the rotating frame", Dimension::speed},
                                    &StartArrays::phi_dot, balls, "ball"));
  add(!header.own_starts.empty(),
      column_of({"psi", "initial angle of the rotor", Dimension::angle}, &StartArrays::psi));
  add(!header.drawn.empty(), column_of({"drawn", "uncertain values that the start drew, each in uncertain_unit"},
                                       &StartArrays::drawn, header.drawn.size(), "uncertain_value"));
  add(header.method == SamplingMethod::grid,
      column_of({"weight", "cells of the grid that the start's cell stands for"}, &StartArrays::weight));
  for (std::size_t k = 0; k < transient_figures.size(); ++k)
    add(header.transients.has_value(), {{transient_figures[k], data_type<float>}, k});
  add(true, column_of({"outcome", outcome_meaning()}, &StartArrays::outcome));
  add(true, column_of({"decision_time", "study time at which the outcome was known", Dimension::time},
                      &StartArrays::decision_time));
  add(header.driven,
      column_of({"mean_speed",
                 "mean rotor speed in the motion that the start came to, of an undecided one when it was last seen",
                 Dimension::speed, "missing where never measured"},
                &StartArrays::mean_speed));
  add(header.sticks, column_of({"left_unbalance", "unbalance that is left where dry friction holds the balls",
                                Dimension::unbalance, "missing where it holds none"},
                               &StartArrays::left_unbalance));
  add(header.touches,
      column_of({"balls_met", "1 where balls touched before the outcome was known, else 0"}, &StartArrays::balls_met));
  add(true, column_of({"decided_by", "grounds on which the outcome was decided"}, &StartArrays::decided_by));
  return columns;
}

std::vector<StartColumn> start_columns() {
  BasinFileHeader header;
  header.full_starts = header.driven = header.sticks = header.touches = true;
  header.own_starts = "given";
  header.drawn = {""};
  header.method = SamplingMethod::grid;
  header.transients.emplace();
  return start_columns(header);
}

double StartColumn::stored(const StartArrays& starts, std::size_t place) const {
  double stored = 0.0;
  visit(starts, [&]<class T>(const std::vector<T>& there) {
    stored = there[place];
    if constexpr (std::is_same_v<T, float>)
      if (!std::isfinite(stored)) stored = missing_figure;
  });
  return stored;
}

void StartColumn::take(const std::vector<double>& from_file, StartArrays& starts) const {
  const bool may_go_on = is_figure() && transient_figures[std::get<std::size_t>(values)].needs;
  const std::vector<float>& peaks = starts.transients[figure_place(&TransientRow::peak_radial)];
  visit(starts, [&]<class T>(std::vector<T>& there) {
    there.assign(from_file.begin(), from_file.end());
    if constexpr (std::is_same_v<T, float>)
      for (std::size_t i = 0; i < there.size(); ++i)
        if (there[i] == missing_figure)
          there[i] = may_go_on && !std::isnan(peaks[i]) ? std::numeric_limits<float>::infinity()
                                                        : std::numeric_limits<float>::quiet_NaN();
  });
}

}  // namespace equipoise::io
