// The list of columns and their values.
#include "equipoise/results/result_files/start_columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/results/types/fate.hpp"

namespace equipoise::io {

const float missing_figure = NC_FILL_FLOAT;

namespace {

using study::Dimension;

template <class T>
constexpr DataColumn::Type data_type = std::is_same_v<T, double>  ? DataColumn::Type::real
                                       : std::is_same_v<T, float> ? DataColumn::Type::single
                                       : std::is_same_v<T, short> ? DataColumn::Type::small
                                                                  : DataColumn::Type::byte;

// `of`: the value of one of the array's entries.
template <class Entry, class Of>
StartColumn of_each(const Column& told, const Entry* StartBatch::*entries, const Of& of) {
  using T = std::invoke_result_t<Of, const Entry&>;
  const auto value = [=](const StartBatch& batch, std::size_t place) -> double {
    const T there = of((batch.*entries)[place]);
    if constexpr (std::is_same_v<T, float>) return std::isfinite(there) ? there : missing_figure;
    return there;
  };
  return {{told, data_type<T>}, value};
}

StartColumn as_given(const Column& told, const double* StartBatch::*values, std::size_t width = 1,
                     const char* along = "") {
  const auto value = [=](const StartBatch& batch, std::size_t place) { return (batch.*values)[place]; };
  return {{told, DataColumn::Type::real, width, along}, value};
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
  const auto of_fates = [](const Column& told, const auto& of) { return of_each(told, &StartBatch::fates, of); };
  add(header.angles,
      as_given({"phi", "initial ball angle from the direction of the centre of mass, rotating frame", Dimension::angle},
               &StartBatch::phi, balls, "ball"));
  add(header.full_starts,
      as_given({"rotor_state", "initial x, y in race radii and x_dot, y_dot, their derivatives in the rotating frame"},
               &StartBatch::rotor, 4, "rotor_component"));
  add(header.full_starts, as_given({"phi_dot", "initial rate of a ball in the rotating frame", Dimension::speed},
                                   &StartBatch::phi_dot, balls, "ball"));
  add(!header.own_starts.empty(), as_given({"psi", "initial angle of the rotor", Dimension::angle}, &StartBatch::psi));
  add(!header.drawn.empty(), as_given({"drawn", "uncertain values that the start drew, each in uncertain_unit"},
                                      &StartBatch::drawn, header.drawn.size(), "uncertain_value"));
  add(header.method == SamplingMethod::grid,
      as_given({"weight", "cells of the grid that the start's cell stands for"}, &StartBatch::weight));
  for (const TransientFigure& f : transient_figures)
    add(header.transients.has_value(),
        of_each(f, &StartBatch::rows, [value = f.value](const TransientRow& row) { return row.*value; }));
  add(true, of_fates({"outcome", outcome_meaning()}, [](const Fate& f) { return code_of(f); }));
  add(true, of_fates({"decision_time", "study time at which the outcome was known", Dimension::time},
                     [](const Fate& f) { return f.time; }));
  add(header.driven,
      of_fates({"mean_speed",
                "mean rotor speed in the motion that the start came to, of an undecided one when it was last seen",
                Dimension::speed, "missing where never measured"},
               [](const Fate& f) { return f.mean_speed; }));
  add(header.sticks, of_fates({"left_unbalance", "unbalance that is left where dry friction holds the balls",
                               Dimension::unbalance, "missing where it holds none"},
                              [](const Fate& f) { return f.unbalance; }));
  add(header.touches, of_fates({"balls_met", "1 where balls touched before the outcome was known, else 0"},
                               [](const Fate& f) { return static_cast<signed char>(f.met); }));
  add(true, of_fates({"decided_by", "grounds on which the outcome was decided"},
                     [](const Fate& f) { return static_cast<signed char>(f.by); }));
  return columns;
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

// Of every start that was not lost there is a peak, the first figure.
void restore_missing(const TransientFigure& figure, std::vector<double>& values, std::vector<bool>& lost) {
  if (lost.empty())
    for (const double peak : values) lost.push_back(peak == missing_figure);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] == missing_figure)
      values[i] =
          figure.needs && !lost[i] ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace equipoise::io
