// What a data sheet says of a drive, put into the keys that every study has: run-up time, nameplate, gear.
#pragma once

#include "equipoise/study/table_reader.hpp"

namespace equipoise::study {

/// States speed.profile where a physical study leaves it out and its keys say which: `torque`, `run_up` with `final`,
/// or `speed` alone.
void infer_profile(Document& document);

/// Replaces speed.run_up, a nameplate in speed.torque, speed.gear_ratio and speed.motor_inertia of a physical study by
/// quantities at the rotor's shaft. Returns the moment of inertia that the motor adds to the rotor's, kg m^2. Throws
/// InputError.
double put_drive_sheet(Document& document);

}  // namespace equipoise::study
