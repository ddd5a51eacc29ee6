// Files of a reproduction: pictures, data, report.
#pragma once

#include <string>

#include "equipoise/extras/reproduction/reproduction.hpp"

namespace equipoise::app {

/// The folder for picture files in the folder of results, which is made; empty if `output` is.
std::string picture_folder(const std::string& output);

/// Draws every table, figure and slice of `r` (SVG) into `folder`, lists them in r.pictures, and puts the figures'
/// curves (CSV) and the slices (NetCDF) there; writes the report (HTML). Each may be empty. Throws RunError if a file
/// cannot be written.
void write_reproduction(Reproduction& r, const std::string& report, const std::string& explorer,
                        const std::string& folder);

}  // namespace equipoise::app
