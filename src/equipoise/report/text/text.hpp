// Pieces that reports share.
// This room: words, numbers and tables that reports share.
#pragma once

#include <string>

#include "equipoise/core/statistics/share.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// "60.40 %".
std::string percent(double share, int digits);
/// Digits of a percentage that its interval supports.
int digits_for(const Share& s);
/// "60.22 to 60.57 %", "below 0.0013 %".
std::string interval(const Share& s);
/// The same for the bounds that hold whatever open starts come to.
std::string bounds_text(const Share& s);
/// A rotor speed: in rpm if the study has scales, else dimensionless.
std::string rotor_speed_text(const Study& study, double speed);
/// Name, balls, rotor, speed, how long balls are held: the start of every report, with an empty line after it.
std::string study_heading(const Study& study);
/// "published" or "kinematic".
const char* name_of(model::SpeedLaw law);

}  // namespace equipoise
