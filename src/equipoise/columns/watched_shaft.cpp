// Outermost bearings, and whether they are all supports.
#include "equipoise/columns/watched_shaft.hpp"

#include <algorithm>
#include <cstddef>

namespace equipoise {

namespace {

// Whatever bearings stated one by one draw, each of them is known.
bool draws_other_supports(const Uncertainty& drawn) {
  if (drawn.physical && drawn.physical->find_path("rotor.tilt.bearings")) return false;
  return std::any_of(drawn.values.begin(), drawn.values.end(),
                     [](const UncertainValue& v) { return v.key.starts_with("rotor."); });
}

}  // namespace

WatchedShaft watched_shaft(const Study& study) {
  WatchedShaft shaft;
  if (study.bearings.empty()) return shaft;
  const auto [least, most] = std::minmax_element(study.bearings.begin(), study.bearings.end());
  shaft.places = {*least, *most};
  if (study.standards.standing_mass || draws_other_supports(study.uncertain)) return shaft;
  shaft.bearings = study.each_bearing();
  const auto first = [&](std::size_t k) {
    const auto found = std::find_if(shaft.bearings.begin() + static_cast<std::ptrdiff_t>(k), shaft.bearings.end(),
                                    [&](const model::Bearing& b) { return b.at == shaft.places[k]; });
    std::iter_swap(shaft.bearings.begin() + static_cast<std::ptrdiff_t>(k), found);
  };
  for (std::size_t k = 0; k < shaft.places.size() && !shaft.bearings.empty(); ++k) first(k);
  return shaft;
}

}  // namespace equipoise
