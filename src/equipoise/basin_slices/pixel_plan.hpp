// Which pixels of a map are computed, in which order, and which are filled in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "equipoise/results/basin_slice.hpp"

namespace equipoise {

/// Every pixel, row by row; or, with blocks, first the edges of all blocks of so many pixels (neighbours share them),
/// then those of the quarters of each block whose edges have not one outcome throughout, and so on down to single
/// pixels. What is left of the others is filled in (Mariani and Silver's way to draw the Mandelbrot set). A basin that
/// lies within a block and touches none of its edges is missed. Undecided and failed pixels are no outcome: blocks with
/// one of them are divided.
class PixelPlan {
 public:
  /// `block`: 0, or a power of two.
  PixelPlan(int columns, int rows, int block);

  void know(std::uint32_t position, short code);
  bool known(std::uint32_t position) const;
  /// Pixels to be computed next, at most `most` and as many as a block has; none once all is known or filled in. To be
  /// asked again once all of them are known.
  std::vector<std::uint32_t> next(std::size_t most);
  std::uint64_t known_count() const { return known_count_; }
  /// Pixels that are known, and those that will be filled in as far as that is decided.
  std::uint64_t settled() const { return known_count_ + filled_; }
  std::uint64_t size() const { return static_cast<std::uint64_t>(columns_) * static_cast<std::uint64_t>(rows_); }

  /// Nothing more is asked or known: gives memory back.
  void close();
  /// Rows first .. first + rows - 1 of the map, of which the first is a multiple of `block` and the last another or the
  /// map's last: fills in what is decided.
  void fill(int first, int rows, SlicePixel* pixels) const;

 private:
  struct Span {
    int low = 0, high = 0;  // both belong to it
  };
  struct Level {
    int side = 1, across = 1, down = 1;  // blocks
    std::vector<bool> divided;           // once judged
  };
  std::vector<std::uint32_t> next_of_all(std::size_t most);
  Span span(int block, int side, int pixels) const;
  bool live(std::size_t level, int x, int y) const;
  bool ask_edges(std::size_t level, std::size_t most, std::vector<std::uint32_t>& batch);
  void ask(int column, int row, std::vector<std::uint32_t>& batch);
  bool agrees(const Span& x, const Span& y) const;
  void judge(std::size_t level);
  void fill_block(std::size_t level, int x, int y, int first, SlicePixel* pixels) const;
  void fill_inside(const Span& x, const Span& y, int first, SlicePixel* pixels) const;
  std::uint32_t at(int column, int row) const {
    return static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(columns_) + static_cast<std::uint32_t>(column);
  }

  int columns_, rows_;
  std::vector<bool> known_;         // without blocks
  std::vector<Level> levels_;       // with blocks, the largest first
  std::vector<std::uint8_t> mark_;  // with blocks, a pixel's: what it stands for is in pixel_plan.cpp
  std::vector<short> codes_;        // of marks
  std::size_t level_ = 0;           // at which it is asked
  int row_ = 0, column_ = 0;        // the block there, or the pixel, that comes next
  std::uint64_t known_count_ = 0, filled_ = 0;
};

}  // namespace equipoise
