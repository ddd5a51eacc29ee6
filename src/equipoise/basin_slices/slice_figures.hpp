// Dimension, uncertainty and entropy of the basins in a map, counted row by row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "equipoise/results/basin_slice.hpp"
#include "equipoise/results/slice_figures.hpp"

namespace equipoise {

/// Undecided and failed pixels are no outcome: nothing is said of them. Intervals of slopes are those of the straight
/// line through the scales, of means those of boxes as if independent.
class SliceFigureCount {
 public:
  /// `plane`: a map's study, axes and ties.
  explicit SliceFigureCount(const BasinSlice& plane);

  /// Codes of the next row.
  void add_row(const short* codes);
  /// Of a whole map.
  SliceFigures figures() const;

 private:
  using Row = std::vector<short>;
  // Boxes of one side that lie side by side between pixel centres, in the row of boxes that is at work.
  struct Boxes {
    Row outcome;         // of all pixels on and in a box so far; mixed_outcome if there are several
    int parts = 0;       // rows of boxes half the side, or of pixels, that are in it
    double mixed = 0.0;  // boxes of all rows
  };
  struct Pairs {
    std::uint64_t all = 0, unlike = 0;
  };
  // A balanced state, and the pixel nearest to it that does not balance.
  struct Disc {
    double x = 0.0, y = 0.0, edge = 0.0;  // edge: distance from where the map ends
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
  std::vector<Pairs> pairs_;                        // likewise
  std::vector<Row> before_;                         // rows, in turn, as far back as the largest scale
  std::vector<Row> band_;                           // of boxes for entropies
  std::map<double, std::uint64_t> all_, boundary_;  // boxes by entropy
  std::vector<Disc> discs_;
};

}  // namespace equipoise
