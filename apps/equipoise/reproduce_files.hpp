// Files of a reproduction: pictures, data, report.
#pragma once

#include <string>

#include "equipoise/reproduction/reproduction.hpp"

namespace equipoise::app {

/// The folder for picture files, which is made: the folder of results, else one beside a Markdown report; empty where
/// no picture file is asked for. Either argument may be empty.
std::string picture_folder(const std::string& output, const std::string& report);

/// Draws every table, figure and slice of `r` (PNG and SVG), lists them in r.pictures, and puts the figures' curves
/// (CSV) and the slices (NetCDF) beside them.
void draw_pictures(Reproduction& r, const std::string& folder);

/// Writes the report (.html or .md); throws RunError if it cannot. `folder`: that of the pictures.
void write_report(const Reproduction& r, const std::string& path, const std::string& explorer,
                  const std::string& folder);

}  // namespace equipoise::app
