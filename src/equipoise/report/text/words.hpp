// Sentences and words that more than one file of this chapter, or of those below it, prints.
#pragma once

#include <array>
#include <utility>

namespace equipoise::words::decision {

// Where no start was followed.
inline constexpr char by_linear_theory[] = "By linear theory; no start has to be followed for that.";

// Motions (attractors/motions/motion_name.cpp), by how their names begin; longer beginnings first.
inline constexpr std::array<std::pair<const char*, const char*>, 11> plain_words{{
    {"co-drifting", "balls circulate together"},
    {"drifting apart", "balls circulate apart"},
    {"drifting at different rates", "balls circulate at different rates"},
    {"drifting", "ball circulates"},
    {"pair drift", "balls circulate as a pair"},
    {"one captured", "one ball stays, one circulates"},
    {"both captured", "balls stay, off balance"},
    {"all captured", "balls stay, off balance"},
    {"captured", "ball stays, off balance"},
    {"locked", "balls stay, off balance"},
    {"hanging", "balls stay below the shaft"},
}};

}  // namespace equipoise::words::decision

namespace equipoise::words::pages {

// Used on several pages.
inline constexpr char before_varied[] = "in the study, before anything is varied";
inline constexpr char csv_holds_all[] = "the CSV file holds all of them";

// Design.
inline constexpr char margins[] = "How far each may be off";

}  // namespace equipoise::words::pages

namespace equipoise::words::reports {

// Of a rotor that tilts. Speeds without balls, with balls.
inline constexpr char forward_whirl[] = "forward whirl: {} without balls{}";
inline constexpr char one_forward_whirl[] =
    "the gyroscopic moment of this disc leaves no second critical speed of forward whirl";

// Of a rotor that tilts: static part, couple part; place, unbalance, least, most.
inline constexpr char static_and_couple[] = "static unbalance {}, couple unbalance {}";
inline constexpr char plane_cancels[] = "plane at {}: unbalance {}; its balls cancel from {} to {}";

// Forces.
inline constexpr char forces_at_bearings[] = "{} of force at the bearings, at the largest";

}  // namespace equipoise::words::reports

namespace equipoise::words::study_check {

// The speed where the motor's torque vanishes, that where unbalance takes all of it.
inline constexpr char with_the_race[] =
    "; the off-centre race makes it {} at the final speed, which the balls have to cancel";

}  // namespace equipoise::words::study_check

namespace equipoise::words::text {

// Titles of columns.
inline constexpr char without_balls[] = "without balls";

// Why to leave the balancer out below the critical speed. Speed, critical speed, what balls do there.
inline constexpr char leave_out[] = "Leave the balancer out: {}.";

}  // namespace equipoise::words::text
