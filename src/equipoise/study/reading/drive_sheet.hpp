// What a data sheet says of a drive, put into the keys that every study has: run-up time, nameplate, gear.
#pragma once

#include "equipoise/study/reading/table_reader.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise::study {

/// States speed.profile where a physical study leaves it out and its keys say which: `torque`, `run_up` with `final`,
/// or `speed` alone.
void infer_profile(StudyFile& file);

struct DriveSheet {
  double gear_ratio = 1.0;  ///< motor speed over rotor speed; speed.torque is at the motor's shaft
  double inertia = 0.0;     ///< that the motor adds to the rotor's, kg m^2
};
/// Replaces speed.run_up and a nameplate in speed.torque of a physical study by the keys that they stand for, and takes
/// out speed.gear_ratio and speed.motor_inertia. Throws InputError.
DriveSheet put_drive_sheet(StudyFile& file);

/// What a quantity at the motor's shaft is multiplied by at the rotor's: speeds by 1/ratio, torques by the ratio,
/// torques for a speed by its square.
double gear_factor(Dimension dimension, double ratio);

}  // namespace equipoise::study
