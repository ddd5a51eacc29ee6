// The NetCDF file of a map, written and read some rows at a time.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "equipoise/io/netcdf.hpp"
#include "equipoise/io/replacement.hpp"
#include "equipoise/results/basin_slice.hpp"

namespace equipoise::io {

/// What a map's file says beside its pixels.
struct SliceFileHeader {
  std::string study;  ///< resolved, as TOML
  SliceAxis x, y;
  std::vector<AngleLink> links;
  int block = 0;           ///< BasinSlice::block
  std::string arithmetic;  ///< BasinFileHeader::arithmetic
  bool one_rotor = true;
  SlicePixel rotor{};  ///< if so, its numbers
};

/// All that decides what stands in a pixel but its place, and that with the places; a key a line as in a study.
std::string subject_of(const SliceFileHeader& header);
std::string identity_of(const SliceFileHeader& header);

/// A new file, which takes its place with finish().
class SliceWriter {
 public:
  /// `codes`: all that pixels may have but not_computed_code; their shares are not known yet. Throws RunError if there
  /// is no room, as do all others.
  SliceWriter(const std::string& path, const SliceFileHeader& header, const std::vector<OutcomeShare>& codes,
              const std::vector<std::vector<double>>& discoveries, bool complete);
  /// Every row once.
  void write_rows(int first, int rows, const SlicePixel* pixels);
  /// Codes as before, with shares.
  void finish(const std::vector<OutcomeShare>& codes);

 private:
  void define(const std::vector<OutcomeShare>& codes, const std::vector<std::vector<double>>& discoveries,
              bool complete);
  void define_pixels(int y, int x, const std::vector<OutcomeShare>& codes);
  void define_attributes(bool complete);
  void write_axis(int variable, const SliceAxis& axis);
  template <class T>
  void write_column(int variable, int first, int rows, const SlicePixel* pixels, T SlicePixel::*value);

  const SliceFileHeader header_;
  std::string path_;
  Replacement place_;
  NetcdfFile file_;
  std::vector<std::string> names_, aliases_;
  int x_ = -1, y_ = -1, outcome_ = -1, computed_ = -1;
  std::array<int, pixel_numbers.size()> numbers_{};
  int code_ = -1, name_ = -1, alias_ = -1, share_ = -1, discovery_ = -1;
};

/// A file that such a writer finished.
class SliceReader {
 public:
  /// Throws InputError, naming the file, if it is none or damaged.
  explicit SliceReader(const std::string& path);

  std::string identity() const { return file_.attribute("identity"); }
  std::string subject() const { return file_.attribute("subject"); }
  bool complete() const { return file_.attribute("complete") == "yes"; }
  const SliceAxis& x() const { return x_; }
  const SliceAxis& y() const { return y_; }
  /// Attractors alone.
  std::vector<OutcomeShare> codes() const;
  std::vector<std::vector<double>> discoveries() const;
  void read_rows(int first, int rows, SlicePixel* pixels) const;

 private:
  SliceAxis read_axis(const std::string& letter) const;
  template <class T>
  void read_column(int variable, int first, int rows, SlicePixel* pixels, T SlicePixel::*value) const;

  NetcdfFile file_;
  SliceAxis x_, y_;
  int outcome_ = -1, computed_ = -1;
  std::array<int, pixel_numbers.size()> numbers_{};
  bool one_rotor_ = true;
};

}  // namespace equipoise::io
