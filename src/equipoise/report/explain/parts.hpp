// The parts of an explanation, in the order in which explain() makes them.
#pragma once

#include <optional>
#include <vector>

#include "equipoise/results/commands/explanation.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// A study's quantities, in the order of its own tables.
std::vector<ExplainedQuantity> quantity_table(const Study& study);

/// Fills `e.speed` and what is said of it: of a motor, where a balanced rotor needs what the motor gives; of a motor
/// that lets go, the speed then if nothing has braked the rotor.
void put_final_speed(Explanation& e);
/// When a ramp function reaches its last speed; none if it is constant.
std::optional<double> last_time(const RampSetting& s);

/// The angle that each ball takes up in the race, also where the study lets balls pass each other: real ones cannot.
/// Empty where the study does not give their size.
std::vector<double> ball_widths(const Study& study);

/// The rules of thumb applied to an explanation that lacks only advice and warnings. A rule that says nothing of the
/// study says why.
std::vector<RuleOfThumb> advice(const Explanation& e);

/// Of a rotor that tilts: critical speeds, balance, sag and vibration. The explanation has speed and `ball_width`,
/// which this takes.
void explain_tilt(Explanation& e);

/// To an explanation that has all else.
void add_warnings(Explanation& e);

}  // namespace equipoise
