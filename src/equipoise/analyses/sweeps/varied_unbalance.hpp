// Unbalance as one quantity that can be varied, however the study states it.
#pragma once

#include <string>
#include <vector>

#include "equipoise/analyses/sweeps/sweep_axis.hpp"
#include "equipoise/analyses/sweeps/sweep_plan.hpp"

namespace equipoise {

/// The source of a study in physical units with its unbalance as one quantity, rotor.unbalance in g mm, where it is
/// stated otherwise (as an eccentricity, a balance grade or places) and neither uncertain nor varied by an axis; else
/// the same. Of a rotor that tilts rotor.unbalance then stands for its static unbalance, and capacity() varies all of
/// its unbalances in proportion; throws InputError where they are a couple alone, uncertain or varied by an axis.
StudySource with_unbalance(const StudySource& source, const std::vector<SweepAxis>& axes);

/// Whether with_unbalance() made this source of a rotor that tilts: rotor.unbalance stands for all its unbalances.
bool varies_all_unbalances(const StudySource& source);

/// Then the overrides with which its static unbalance is this (kg m), each unbalance keeping its share.
std::vector<std::string> unbalances_in_proportion(const SweepPlan& plan, double unbalance);

}  // namespace equipoise
