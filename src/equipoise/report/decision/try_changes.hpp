// The changes that an engineer would try first, each tried.
#pragma once

#include <vector>

#include "equipoise/core/running/run_options.hpp"
#include "equipoise/report/decision/usual_changes.hpp"
#include "equipoise/report/decision/verdict.hpp"

namespace equipoise {

/// No further change is begun after so many seconds of CPU time; one that then runs is given up a little later, as is
/// one that takes longer than the others need: an answer is wanted within a minute. How many changes are tried may thus
/// depend on the machine; what each is worth does not.
inline constexpr double seconds_for_changes = 30.0, longest_for_changes = 45.0, longest_for_a_change = 15.0;

/// The usual changes tried on the study's first starts, in their order; stops after the first that makes the balancer
/// fit. Each has starts_of_a_change starts or, where it surely fails and is not the best, starts_of_a_look. Stopped, it
/// returns what is done. Progress counts changes.
std::vector<TriedChange> try_changes(const Study& study, const RunOptions& options = {});
/// The same of a result's study, if its verdict asks for it: none for a balancer that does what is asked, is not needed
/// or is not judged yet, nor for a result that was stopped.
std::vector<TriedChange> changes_asked_for(const BasinResult& result, const RunOptions& options = {});

}  // namespace equipoise
