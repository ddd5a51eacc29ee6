// The NetCDF file of a map, written and read some rows at a time.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "equipoise/files/netcdf.hpp"
#include "equipoise/files/replacement.hpp"
#include "equipoise/results/plane_map.hpp"

namespace equipoise::store {

/// What a map's file says beside its pixels.
struct MapFileHeader {
  std::string study;  ///< resolved, as TOML
  MapAxis x, y;
  std::vector<AngleLink> links;
  int block = 0;           ///< PlaneMap::block
  std::string arithmetic;  ///< BasinFileHeader::arithmetic
  bool one_rotor = true;
  MapPixel rotor{};  ///< if so, its numbers
};

/// All that decides what stands in a pixel but its place, and that with the places; a key a line as in a study.
std::string subject_of(const MapFileHeader& header);
std::string identity_of(const MapFileHeader& header);

/// A new file, which takes its place with finish().
class MapWriter {
 public:
  /// `codes`: all that pixels may have but not_computed_code; their shares are not known yet. Throws RunError if there
  /// is no room, as do all others.
  MapWriter(const std::string& path, const MapFileHeader& header, const std::vector<OutcomeShare>& codes,
            const std::vector<std::vector<double>>& discoveries, bool complete);
  /// Every row once.
  void write_rows(int first, int rows, const MapPixel* pixels);
  /// Codes as before, with shares.
  void finish(const std::vector<OutcomeShare>& codes);

 private:
  void define(const std::vector<OutcomeShare>& codes, const std::vector<std::vector<double>>& discoveries,
              bool complete);
  void define_pixels(int y, int x, const std::vector<OutcomeShare>& codes);
  void define_attributes(bool complete);
  void write_axis(int variable, const MapAxis& axis);
  template <class T>
  void write_column(int variable, int first, int rows, const MapPixel* pixels, T MapPixel::*value);

  const MapFileHeader header_;
  std::string path_;
  Replacement place_;
  NetcdfFile file_;
  std::vector<std::string> names_, aliases_;
  int x_ = -1, y_ = -1, outcome_ = -1, computed_ = -1;
  std::array<int, pixel_numbers.size()> numbers_{};
  int code_ = -1, name_ = -1, alias_ = -1, share_ = -1, discovery_ = -1;
};

/// A file that such a writer finished.
class MapReader {
 public:
  /// Throws InputError, naming the file, if it is none or damaged.
  explicit MapReader(const std::string& path);

  std::string identity() const { return file_.attribute("identity"); }
  std::string subject() const { return file_.attribute("subject"); }
  bool complete() const { return file_.attribute("complete") == "yes"; }
  const MapAxis& x() const { return x_; }
  const MapAxis& y() const { return y_; }
  /// Attractors alone.
  std::vector<OutcomeShare> codes() const;
  std::vector<std::vector<double>> discoveries() const;
  void read_rows(int first, int rows, MapPixel* pixels) const;

 private:
  MapAxis read_axis(const std::string& letter) const;
  template <class T>
  void read_column(int variable, int first, int rows, MapPixel* pixels, T MapPixel::*value) const;

  NetcdfFile file_;
  MapAxis x_, y_;
  int outcome_ = -1, computed_ = -1;
  std::array<int, pixel_numbers.size()> numbers_{};
  bool one_rotor_ = true;
};

}  // namespace equipoise::store
