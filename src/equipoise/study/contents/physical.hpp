// Studies in physical units: every quantity, a string with its unit, becomes a dimensionless key of the study reader.
#pragma once

#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/reading/table_reader.hpp"

namespace equipoise::study {

/// Whether the study is in physical units, by keys that no other study has, such as rotor.mass.
bool is_physical(const StudyFile& file);

/// Replaces the physical keys of a physical study by dimensionless ones, in place. The original values are kept for
/// messages. Sets file.scales, and what `study` keeps of a data sheet. A dimensionless study stays unchanged. Throws
/// InputError for values that are missing, given twice, of the wrong dimension, out of range, or plain numbers.
void make_dimensionless(StudyFile& file, Study& study);

}  // namespace equipoise::study
