// Files of a reproduction: pictures, data, report.
#pragma once

#include <string>

#include "equipoise/reproduction/reproduction.hpp"

namespace equipoise::app {

/// The folder for pictures: the folder of results; else one beside a Markdown report; else, for a page that embeds
/// them, a folder that is removed afterwards.
class PictureFolder {
 public:
  /// Either path may be empty; with both empty there is no folder.
  PictureFolder(const std::string& output, const std::string& report);
  ~PictureFolder();
  PictureFolder(const PictureFolder&) = delete;
  PictureFolder& operator=(const PictureFolder&) = delete;

  const std::string& path() const { return path_; }
  bool temporary() const { return temporary_; }

 private:
  std::string path_;
  bool temporary_ = false;
};

/// Draws every table, figure and slice of `r` (PNG, and SVG if they are kept), lists them in r.pictures, and puts the
/// figures' curves (CSV) and the slices (NetCDF) beside them.
void draw_pictures(Reproduction& r, const PictureFolder& folder);

/// Writes the report (.html or .md); throws RunError if it cannot.
void write_report(const Reproduction& r, const std::string& path, const std::string& explorer,
                  const PictureFolder& folder);

}  // namespace equipoise::app
