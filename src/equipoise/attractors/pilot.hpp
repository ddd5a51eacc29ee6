// From a pilot's stationary motions to boxes that recognise them early.
#pragma once

#include <vector>

#include "equipoise/attractors/decision_rule.hpp"
#include "equipoise/attractors/fate.hpp"

namespace equipoise {

/// Groups stationary motions whose long-window features agree, and bounds the short-window features of each group of at
/// least three: their range, widened on both sides by itself and by 2 % of the largest r or rate. A box that would
/// admit a centred rotor with resting balls is left out.
std::vector<FeatureBox> boxes_from_pilot(const std::vector<PilotRecord>& records, const DecisionRule& rule);

}  // namespace equipoise
