// Numbers with units, and texts of studies: why they cannot be read.
#pragma once

namespace equipoise::words::units {

// Before the units that are allowed ("must be a mass, such as ...").
inline constexpr char no_number[] = "does not begin with a number; {}";
inline constexpr char number_out_of_range[] = "the number is out of range; {}";
inline constexpr char no_unit[] = "has no unit; {}";
inline constexpr char no_number_with_unit[] = "is not a number with a unit; {}";
// The unit, the units that are allowed.
inline constexpr char measures_something_else[] = "\"{}\" is a unit of something else; {}";

// Behind them, of speeds of rotation.
inline constexpr char speed_units[] = "; in rpm, 1/min, rad/s or Hz (turns a second)";

// What a quantity is.
inline constexpr char torque_for_a_speed[] = "a torque for a speed of rotation";
inline constexpr char force_for_a_speed[] = "a force for a speed of tilting";
inline constexpr char weight_inertia[] = "a weight times a diameter squared";

// A plain number in a field of the guide.
inline constexpr char no_plain_number[] = "is not a plain number";

// A study in TOML.
inline constexpr char too_many_key_parts[] = "a key has more than {} parts; no key of a study does";
inline constexpr char no_ascii[] =
    "a character that is not ASCII, outside of comments and values in quotes; no study needs one";

// Faults of the program.
inline constexpr char dimension_without_numbers[] = "no dimensionless study has this dimension";
inline constexpr char members_of_no_table[] = "a value that is no table has no members";

}  // namespace equipoise::words::units
