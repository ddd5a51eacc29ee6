// The changes of a balancer that an engineer would try first, each tried.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "equipoise/core/running/run_options.hpp"
#include "equipoise/report/decision/verdict.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Starts on which each change is tried: if all meet the limits, 96 % do (95 % confidence).
inline constexpr std::uint64_t starts_of_a_change = 100;
/// The first of them. A change that certainly fails on these is tried on all only if it may still be the best.
inline constexpr std::uint64_t starts_of_a_look = 32;

/// A study with one thing changed, with this many random starts, and what the change is: "twice the drag".
struct Change {
  std::string words;
  Study study;
};

/// Drag twice and half, more and fewer balls, larger and smaller ones, a latch that holds the balls until well above
/// resonance, a faster run-up: those that make a valid study. None for a study with uncertain values, whose draws
/// cannot be changed in it, or without balls.
std::vector<Change> usual_changes(const Study& study);

/// No further change is begun after this many seconds of CPU time; one that then runs is given up a little later, as is
/// one that takes longer than the others, because an answer is wanted within a minute. So the number of changes tried
/// may depend on the machine, but what each is worth does not.
inline constexpr double seconds_for_changes = 30.0, longest_for_changes = 45.0, longest_for_a_change = 15.0;

/// Tries the usual changes on the study's first starts, in order, up to the first that makes the balancer fit. Each has
/// starts_of_a_change starts or, if it certainly fails and is not the best, starts_of_a_look. If stopped, returns what
/// is done. Progress counts changes.
std::vector<TriedChange> try_changes(const Study& study, const RunOptions& options = {});
/// The same for a result's study, if its verdict asks for it: none for a balancer that meets the requirements, is not
/// needed or is not judged yet, nor for a stopped result.
std::vector<TriedChange> changes_asked_for(const BasinResult& result, const RunOptions& options = {});

}  // namespace equipoise
