// Pixels whose starts cannot stand for others: alike balls begin as one and stay so, or colliding balls overlap.
#pragma once

#include <cstdint>
#include <vector>

#include "equipoise/machine/balance/coincident_balls.hpp"
#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

/// Alike balls that start in one place with one rate move as one, even where others of the plane's starts drive them
/// apart. Such starts have measure zero, but a grid may hit them: a whole diagonal of a square over two angles. Pairs
/// that are in one place all over the plane are the user's choice, and count. Colliding balls that overlap are no
/// start.
class InvariantPixels {
 public:
  explicit InvariantPixels(const BasinSlice& plane);

  bool holds(int column, int row) const;
  /// In the whole plane. 0 if they are all there is.
  std::uint64_t count() const { return count_; }
  /// Whether every pixel starts some alike balls in one place, which no count includes.
  bool everywhere() const { return everywhere_; }

 private:
  // How far one ball of a pair is ahead of the other: the sum of what column and row give.
  struct Pair {
    std::vector<double> angle_of_column, angle_of_row, rate_of_column, rate_of_row;
    struct {
      double angle, rate;
    } meet{model::parting, model::parting};  // below both
  };
  std::vector<Pair> pairs_;  // those that the plane moves apart
  std::uint64_t count_ = 0;
  bool everywhere_ = false;
};

}  // namespace equipoise
