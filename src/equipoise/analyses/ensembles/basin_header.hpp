// The header of an ensemble's output file.
#pragma once

#include <string>

#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Describes a run of basin() for its output file. `given_starts`: checksum_of() the caller's starts, empty if starts
/// are drawn. `target`: the CPU target of the run.
BasinFileHeader basin_file_header(const Study& study, bool angles, bool transients = false,
                                  const std::string& given_starts = {}, const std::string& target = cpu_target());

}  // namespace equipoise
