// Outermost bearings, and whether they are all supports.
#include "equipoise/results/columns/watched_shaft.hpp"

#include <algorithm>
#include <utility>
#include <vector>

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
  std::vector<model::Bearing>& each = shaft.bearings;
  std::sort(each.begin(), each.end(), [](const auto& a, const auto& b) { return a.at < b.at; });
  if (each.size() > 2) std::swap(each[1], each.back());  // the outermost two first
  return shaft;
}

}  // namespace equipoise
