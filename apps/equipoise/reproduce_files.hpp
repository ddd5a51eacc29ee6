// Files of a reproduction: pictures, data, report.
#pragma once

#include <string>

#include "equipoise/extras/reproduction/reproduction.hpp"

namespace equipoise::app {

/// The folder for picture files, which is made: the folder of results, else one beside a Markdown report; empty where
/// no picture file is asked for. Either argument may be empty.
std::string picture_folder(const std::string& output, const std::string& report);

/// Draws every table, figure and slice of `r` (SVG) into `folder`, lists them in r.pictures, and puts the figures'
/// curves (CSV) and the slices (NetCDF) beside them; writes the report (.html or .md). Each may be empty. Throws
/// RunError if a file cannot be written.
void write_reproduction(Reproduction& r, const std::string& report, const std::string& explorer,
                        const std::string& folder);

}  // namespace equipoise::app
