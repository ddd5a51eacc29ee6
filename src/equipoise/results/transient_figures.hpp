// How figures of transients are presented: one line each, used by tables, pages, designs and Python.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "equipoise/study/study.hpp"
#include "equipoise/types/transient_table.hpp"
#include "equipoise/units/units.hpp"

namespace equipoise {

/// A column of transient_columns with its presentation.
struct TransientFigure : TransientColumn {
  study::Dimension dimension;
  const char* title;  ///< in tables and pictures
  /// On a page, if it has its own line there; null: none.
  const char* page_title = nullptr;
  /// Only asked for with this limit; null: always, except for the drive's work (WorkSource).
  std::optional<double> Limits::*needs = nullptr;
  /// For a figure that may have no end: words for a start whose motion exceeds the limit for good, the same on a page,
  /// and words for a start that had not come below it when last followed.
  std::array<const char*, 3> open{"?", "", "?"};

  /// An unbalance is shown over the rotor's mass, as a length.
  study::Dimension told_in() const {
    return dimension == study::Dimension::unbalance ? study::Dimension::length : dimension;
  }
};
inline constexpr std::array<TransientFigure, transient_columns.size()> transient_figures{{
    {transient_columns[0], study::Dimension::length, "peak displacement", "peak displacement"},
    {transient_columns[1], study::Dimension::length, "peak displacement after release"},
    {transient_columns[2], study::Dimension::length, "peak displacement at the end"},
    {transient_columns[3], study::Dimension::force, "peak bearing force", "peak force on the supports"},
    {transient_columns[4], study::Dimension::force, "RMS bearing force at the end"},
    {transient_columns[5], study::Dimension::velocity, "RMS velocity at the end", "RMS velocity in the end"},
    {transient_columns[6], study::Dimension::unbalance, "residual unbalance U/M"},
    {transient_columns[7],
     study::Dimension::time,
     "time above the limit",
     "time above the limit",
     &Limits::displacement,
     {"lasting", "for good", "not over"}},
    {transient_columns[8],
     study::Dimension::time,
     "settling time",
     "settled after release",
     &Limits::settled,
     {"never", "never", "not yet"}},
    {transient_columns[9], study::Dimension::energy, "work of the drive", "work of the drive"},
    {transient_columns[10], study::Dimension::time, "followed until"},
}};
constexpr std::size_t figure_place(float TransientRow::*value) {
  std::size_t k = 0;
  while (transient_figures[k].value != value) ++k;
  return k;
}

/// A limit whose excess is counted, in the order of TransientGroup::exceeded.
struct TransientLimit {
  const char* name;  ///< key of [limits]
  std::optional<double> Limits::*limit;
  float TransientRow::*value;  ///< the figure that it limits
  const char* exceeded;        ///< follows the limit: "5 mm is exceeded on the way"
  bool at_end = false;         ///< the others are peaks, which stay exceeded

  const TransientFigure& figure() const { return transient_figures[figure_place(value)]; }
};
inline constexpr std::array<TransientLimit, 3> transient_limits{{
    {"displacement", &Limits::displacement, &TransientRow::peak_radial, " is exceeded on the way"},
    {"force", &Limits::force, &TransientRow::peak_force, " on the supports is exceeded on the way"},
    {"velocity", &Limits::velocity, &TransientRow::rms_velocity, " RMS in the end is exceeded", true},
}};

}  // namespace equipoise
