// Outermost bearings, and whether they are all supports.
#include "equipoise/columns/watched_shaft.hpp"

#include <algorithm>

namespace equipoise {

namespace {

// Whatever bearings stated one by one draw, they are two bearings.
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
  if (study.bearings.size() == 2 && !study.standards.standing_mass && !draws_other_supports(study.uncertain))
    shaft.bearings = model::two_bearings(study.parameters, shaft.places);
  return shaft;
}

}  // namespace equipoise
