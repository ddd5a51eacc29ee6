// Maps: the outcome of one start at every pixel of a plane of two quantities.
#pragma once

#include <vector>

#include "equipoise/base/run_options.hpp"
#include "equipoise/results/plane_map.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// Progress is in pixels.
struct PlaneMapSettings : RunOptions {
  MapAxis x, y;
  std::vector<AngleLink> links;  ///< applied in order, after the axes
};

/// Follows the start [initial] of `study`, with the pixel's two values. Over two initial values pixels are
/// decided as basin() decides its starts (maps_starts()). Else each is followed until it is seen to approach a motion
/// that exists and is linearly stable there (settle()), for numerics.horizon (unset: 3000) after the last branch
/// begins: what becomes steady in no way by then is undecided. Codes are the identifiers of the catalogue; motions
/// without one of their own get the next ones, one a name: those usual in maps the same ones everywhere, others in the
/// order of pixels. The map depends on the study and the axes alone. Throws InputError for keys, links and values that
/// make no study, and studies that cannot be decided.
PlaneMap plane_map(const Study& study, const PlaneMapSettings& settings);

}  // namespace equipoise
