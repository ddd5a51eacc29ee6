// Follows a machine's start for as long as wanted, with no rule that might end it early, and describes it by means and
// extremes alone.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "equipoise/study/contents/study.hpp"

namespace machine_follow {

struct Seen {
  bool lost = false;
  double speed = 0.0, r = 0.0;                                       // mean psi', rms r of the later half
  double last_r = 0.0;                                               // rms r of the last tenth
  std::array<double, equipoise::model::max_balls> turned{}, rate{};  // of each ball; its largest |phi'|
  int oppositions = 0;                                               // times that two balls passed opposite places
  bool one_side = false;                                             // at the end half the race holds all balls
};

Seen follow(const equipoise::Study& study, std::uint64_t index, double until);

/// Names of motions without recurrence, with "rest" for all balls captured, whether r is above rounding or not.
std::string kind_of(const equipoise::Study& study, const Seen& seen);

}  // namespace machine_follow
