// The NetCDF file of a basin slice, written and read some rows at a time.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "equipoise/results/commands/basin_slice.hpp"
#include "equipoise/results/io/netcdf.hpp"
#include "equipoise/results/io/replacement.hpp"

namespace equipoise::io {

/// What a slice's file states besides its pixels.
struct SliceFileHeader {
  std::string study;  ///< resolved, as TOML
  SliceAxis x, y;
  std::vector<AngleLink> links;
  std::string arithmetic;  ///< BasinFileHeader::arithmetic
  bool one_rotor = true;
  SlicePixel rotor{};          ///< for one rotor: its numbers
  std::size_t components = 0;  ///< of a state
};

/// Everything that determines the pixels; one key per line, as in a study.
std::string identity_of(const SliceFileHeader& header);

/// Writes a new file, which finish() puts in its place.
class SliceWriter {
 public:
  /// `codes`: all codes that pixels may have except not_computed_code; their shares are not known yet. Throws RunError
  /// if the file cannot be written, as do the other members.
  SliceWriter(const std::string& path, const SliceFileHeader& header, const std::vector<OutcomeShare>& codes,
              const std::vector<std::vector<double>>& discoveries, bool complete);
  /// Every row must be written once.
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
  int x_ = -1, y_ = -1, outcome_ = -1;
  std::array<int, pixel_numbers.size()> numbers_{};
  int code_ = -1, name_ = -1, alias_ = -1, share_ = -1, discovery_ = -1;
};

/// Reads a file that a SliceWriter finished.
class SliceReader {
 public:
  /// Throws InputError, naming the file, for other or damaged files.
  explicit SliceReader(const std::string& path);

  std::string identity() const { return file_.attribute("identity"); }
  bool complete() const { return file_.attribute("complete") == "yes"; }
  const SliceAxis& x() const { return x_; }
  const SliceAxis& y() const { return y_; }
  /// Attractors only.
  std::vector<OutcomeShare> codes() const;
  /// Throws RunError unless each has this number of components.
  std::vector<std::vector<double>> discoveries(std::size_t components) const;
  void read_rows(int first, int rows, SlicePixel* pixels) const;

 private:
  SliceAxis read_axis(const std::string& letter) const;
  template <class T>
  void read_column(int variable, int first, int rows, SlicePixel* pixels, T SlicePixel::*value) const;

  NetcdfFile file_;
  SliceAxis x_, y_;
  int outcome_ = -1;
  std::array<int, pixel_numbers.size()> numbers_{};
  bool one_rotor_ = true;
};

}  // namespace equipoise::io
