// A grid of cells over the ball angles with two random starts in each.
#pragma once

#include <cstdint>

namespace equipoise {

/// Stratified sampling of ball angles: m^n equal cells, m per turn, with two independent uniform starts each, whose
/// differences give the variance without bias (S. Haber, Math. Comp. 21 (1967) 388). With `exchange` (exchanging balls
/// changes no outcome's probability) only cells c_1 <= ... <= c_n are evaluated, each for all its mirror images. The
/// seed shuffles the cells, so that the first starts are also a fair sample.
class JitteredGrid {
 public:
  /// The largest grid that fits into `starts` >= 2 starts.
  JitteredGrid(int balls, bool exchange, std::uint64_t starts);

  std::uint64_t side() const { return side_; }         ///< m
  std::uint64_t cells() const { return cells_; }       ///< evaluated
  std::uint64_t starts() const { return 2 * cells_; }  ///< starts 0 to starts() - 1 fill the grid
  double all_cells() const;                            ///< m^n
  bool exchange() const { return exchange_; }

  /// Writes the ball angles of start `index` < starts(); starts 2 k and 2 k + 1 share a cell.
  void angles(std::uint64_t seed, std::uint64_t index, double* phi) const;
  /// How many cells of the whole grid the start's cell stands for: 1 to n!.
  double weight(std::uint64_t seed, std::uint64_t index) const;

 private:
  void cell(std::uint64_t seed, std::uint64_t index, std::uint64_t* coordinates) const;

  int balls_;
  bool exchange_;
  std::uint64_t side_ = 1, cells_ = 1;
};

}  // namespace equipoise
