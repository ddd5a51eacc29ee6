// The rules of thumb applied to a study.
#pragma once

#include <vector>

#include "equipoise/results/explanation.hpp"
#include "equipoise/study/ball_details.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// The angle that each ball takes up in the race, whether the study lets balls pass each other or not: real ones
/// cannot. Empty where the study does not give their size.
std::vector<double> ball_widths(const Study& study, const BallDetails& balls);

/// Of an explanation that has all but advice and warnings. A rule that says nothing of the study says why.
std::vector<RuleOfThumb> advice(const Explanation& e);

}  // namespace equipoise
