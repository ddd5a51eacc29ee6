// The NetCDF file of a basin slice, written and read some rows at a time.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "equipoise/results/commands/basin_slice.hpp"
#include "equipoise/results/io/dataset_file.hpp"

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
  /// `codes`: all codes that pixels may have except not_computed_code; their shares are needed in the end. Throws
  /// RunError if the file cannot be written, as do the other members. Refers to the arguments.
  SliceWriter(const std::string& path, const SliceFileHeader& header, const std::vector<OutcomeShare>& codes,
              const std::vector<std::vector<double>>& discoveries, bool complete);
  /// Every row must be written once.
  void write_rows(int first, int rows, const SlicePixel* pixels);
  void finish() { file_.finish(); }

 private:
  static Dataset contents(const SliceFileHeader& header, const std::vector<OutcomeShare>& codes,
                          const std::vector<std::vector<double>>& discoveries, bool complete);

  const SliceFileHeader header_;
  const Dataset data_;
  DatasetFile file_;
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
