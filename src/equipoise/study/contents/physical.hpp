// Studies in physical units: every quantity, a string with its unit, becomes a dimensionless key of the study reader.
#pragma once

#include "equipoise/study/contents/ball_details.hpp"
#include "equipoise/study/reading/table_reader.hpp"

namespace equipoise::study {

/// Whether the study is in physical units, by keys that no other study has, such as rotor.mass.
bool is_physical(const StudyFile& file);

/// Replaces the physical keys of a physical study by dimensionless ones, in place, and sets file.scales. The
/// original values are kept for messages. A dimensionless study stays unchanged. Throws InputError for values that are
/// missing, given twice, of the wrong dimension, out of range, or plain numbers.
void make_dimensionless(StudyFile& file);

/// The angle from the rotor's own unbalance to the resultant with every [[place]], at medians: x of the model points
/// there. 0 without places. Of a rotor that tilts: from its angle 0 to the resultant couple unbalance. In radians.
double resultant_direction(StudyFile file);

/// What a physical study says of its balls; call before it is made dimensionless.
BallDetails ball_details(const StudyFile& file);

}  // namespace equipoise::study
