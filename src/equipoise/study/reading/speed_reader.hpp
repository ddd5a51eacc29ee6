// [speed]: a ramp function or a motor with its load.
#pragma once

#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/reading/table_reader.hpp"

namespace equipoise::study {

/// Reads [speed] into the study, whose rotor has been read. Throws InputError.
void read_speed(const StudyFile& file, Study& study);

}  // namespace equipoise::study
