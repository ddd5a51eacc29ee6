// What the study reader asks of rotors that tilt.
#pragma once

#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/reading/table_reader.hpp"

namespace equipoise::study {

/// Reads [rotor.tilt], if it is there, for a study whose [rotor] has been read. Throws InputError.
void read_tilt(const StudyFile& file, Study& study);

/// Of balls and race a rotor that tilts takes the planes, and no more than the drag of balls that slide. Throws
/// InputError.
void check_tilting_balls(const StudyFile& file, const model::Parameters& p);

/// Forces on each of several bearings are gathered where each is known, and no feet slide by their sum; else a sum, in
/// which what tilts the rotor does not show, and which limits.force does not take. Throws InputError.
void check_force_limit(const StudyFile& file, const Study& study);

/// Of a rotor that tilts, limits.residual and limits.grade need the places of two bearings, in whose planes its
/// unbalance is judged. Throws InputError.
void check_unbalance_limits(const StudyFile& file, const Study& study);

}  // namespace equipoise::study
