// What a study's numbers say before anything is simulated.
// This room: a study explained and checked.
#pragma once

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/results/commands/explanation.hpp"
#include "equipoise/study/contents/ball_details.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Takes any study that read_study() accepts. `balls`: for the Reynolds number and for whether the balls have room. Of
/// a rotor that tilts there are no rules of thumb, and no run-up. Once `stop` is set, rates near balance are left out.
Explanation explain(const Study& study, const BallDetails& balls = {}, const StopFlag* stop = nullptr);

/// Throws InputError for a study of which pages know nothing.
void check_pages(const Study& study);

}  // namespace equipoise
