// Dimension, uncertainty and entropy of the basins in a slice, counted row by row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

/// For add_row(): a pixel that does not count, here or as the end of a balanced disc.
inline constexpr short left_out_code = not_computed_code + 1;

/// Undecided and failed pixels are left out. Intervals of slopes come from the line fitted through the scales;
/// intervals of means treat boxes as independent.
class SliceFigureCount {
 public:
  /// `plane`: a slice's study, axes and links.
  explicit SliceFigureCount(const BasinSlice& plane);

  /// Codes of the next row.
  void add_row(const short* codes);
  /// Needs all rows.
  SliceFigures figures() const;

 private:
  using Row = std::vector<short>;
  // Adjacent boxes of one side between pixel centres, in the current row of boxes.
  struct Boxes {
    Row outcome;         // of all pixels on and in a box so far; mixed_outcome if there are several
    int parts = 0;       // rows of half-size boxes, or of pixels, in it so far
    double mixed = 0.0;  // boxes of all rows
  };
  struct Pairs {
    std::uint64_t all = 0, unlike = 0;
  };
  // A balanced state, and the nearest pixel that does not balance.
  struct Disc {
    double x = 0.0, y = 0.0, edge = 0.0;  // edge: distance from the end of the slice
    std::vector<double> across;           // distances of columns
    double dx = 0.0, dy = 0.0;
    bool touched = false;
  };

  void add_boxes(const Row& row);
  void pass_up(std::size_t scale);
  void add_pairs(const Row& row);
  void add_entropies();
  void add_discs(const short* codes);
  void prepare_discs(const BasinSlice& plane);

  SliceAxis x_, y_;
  int row_ = 0;  // rows so far
  std::vector<int> scales_;
  std::vector<Boxes> boxes_;                        // by scale
  std::vector<Pairs> pairs_;                        // the same
  std::vector<Row> before_;                         // the last rows, cyclically, as far back as the largest scale
  std::vector<Row> band_;                           // rows for the boxes of entropies
  std::map<double, std::uint64_t> all_, boundary_;  // boxes by entropy
  std::vector<Disc> discs_;
};

}  // namespace equipoise
