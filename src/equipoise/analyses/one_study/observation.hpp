// Records how far an ensemble's starts are from balance as time passes, for tests that end at a finite time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "equipoise/core/running/run_options.hpp"
#include "equipoise/machine/drives/speed.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

struct ObservationSettings : RunOptions {
  std::uint64_t first = 0;      ///< index of the first start
  std::uint64_t starts = 4096;  ///< above 0
  double window = 10.0;         ///< above 0
  double until = 1000.0;        ///< study time; the last whole window that fits is the last recorded
};

/// r^2 = x^2 + y^2, of a tilting rotor at the outermost bearing that is further out, in windows [k window, (k + 1)
/// window] of study time. Windows that end before the release hold not-a-number; one that contains it counts from
/// there. A lost trajectory is infinite from then on.
struct Observation {
  std::size_t starts = 0, windows = 0;
  double window = 0.0;
  std::vector<float> largest;  ///< starts x windows, row-major: the largest r^2 within
  std::vector<float> at_end;   ///< the same shape: r^2 when the window ends
  bool complete = false;       ///< false if stopped early; the tables are then unusable

  double end_of(std::size_t k) const { return static_cast<double>(k + 1) * window; }
};

/// Follows random starts of `study` (whatever [sampling] method says) through its spin-up, release and pieces of its
/// drive. The record of start i depends on the study and i alone (for one CPU target), not on threads. Between steps
/// r^2 is a cubic, so largest values are good to 1 %. Throws InputError for studies that cannot be decided (see
/// basin()) and for unusable settings.
Observation observe(const Study& study, const ObservationSettings& settings);

/// The same with `segments` in place of the study's [speed] and [release]. They must be contiguous from 0, clamped ones
/// first; the last must be free, at constant speed and without end.
Observation observe(const Study& study, const std::vector<model::Segment>& segments,
                    const ObservationSettings& settings);

}  // namespace equipoise
