// What the output file of an ensemble says of its run.
#pragma once

#include <string>

#include "equipoise/kernels/cpu_target.hpp"
#include "equipoise/result_files/basin_file.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// What the output file of a basin() says of its run.
/// `own_starts`: of the caller's starts (checksum_of()), empty if they are drawn; `target`: the CPU target of the run.
BasinFileHeader basin_file_header(const Study& study, bool angles, bool transients = false,
                                  const std::string& own_starts = {}, const std::string& target = cpu_target());

}  // namespace equipoise
