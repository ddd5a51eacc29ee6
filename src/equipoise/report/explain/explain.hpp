// What a study's numbers say before anything is simulated.
// This room: a study explained and checked.
#pragma once

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/results/commands/explanation.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Takes any study that read_study() accepts. Of a rotor that tilts there are no rules of thumb, and no run-up. Once
/// `stop` is set, rates near balance are left out.
Explanation explain(const Study& study, const StopFlag* stop = nullptr);

/// Throws InputError for a study of which pages know nothing.
void check_pages(const Study& study);

}  // namespace equipoise
