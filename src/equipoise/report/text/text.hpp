// Pieces that reports share.
// This room: words, numbers and tables that reports share.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

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
/// count, share, low, high.
nlohmann::ordered_json share_json(const Share& s);
/// The same with least and most.
nlohmann::ordered_json sure_share_json(const Share& s);
/// A value of a study.
nlohmann::ordered_json tree_json(const StudyValue& value);
/// The resolved study.
nlohmann::ordered_json study_json(const Study& study);

}  // namespace equipoise
