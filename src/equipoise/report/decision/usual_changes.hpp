// Changes of a balancer that an engineer would try first.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Starts on which each change is tried: if all keep the limits, 96 % surely do.
inline constexpr std::uint64_t starts_of_a_change = 100;
/// The first of them. A change that surely fails on these is tried on all only if it may still be the best.
inline constexpr std::uint64_t starts_of_a_look = 32;

/// A study with one thing changed, of so many random starts, and what the change is: "twice the drag".
struct Change {
  std::string words;
  Study study;
};

/// Drag twice and half, more and fewer balls, larger and smaller ones, a latch that holds the balls until well above
/// resonance, a faster run-up: those that make a valid study. None for a study with uncertain values, whose draws
/// cannot be changed in it, or without balls.
std::vector<Change> usual_changes(const Study& study);

}  // namespace equipoise
