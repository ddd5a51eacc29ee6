// Which pixels of a slice are computed, in which order, and which are filled in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

/// Without blocks: every pixel, row by row. With blocks: first the edges of all blocks (neighbours share them), then
/// those of the quarters of each block whose edges do not have a single outcome, and so on down to single pixels. The
/// rest is filled in (Mariani and Silver's way to draw the Mandelbrot set). A basin inside a block that touches none of
/// its edges is missed. Undecided and failed pixels are no outcome: blocks with one of them are divided.
class PixelPlan {
 public:
  /// `block`: 0, or a power of two.
  PixelPlan(int columns, int rows, int block);

  void know(std::uint32_t position, short code);
  bool known(std::uint32_t position) const;
  /// The next pixels to compute, at most `most` plus those of one block; none once all are known or filled in. Call it
  /// again once all of them are known.
  std::vector<std::uint32_t> next(std::size_t most);
  std::uint64_t known_count() const { return known_count_; }
  /// Pixels that are known, and those already certain to be filled in.
  std::uint64_t settled() const { return known_count_ + filled_; }
  std::uint64_t size() const { return static_cast<std::uint64_t>(columns_) * static_cast<std::uint64_t>(rows_); }

  /// Frees memory, once nothing more is asked or known.
  void close();
  /// Fills in the decided pixels of rows first .. first + rows - 1. The first must be a multiple of `block`, the last
  /// one before such a multiple or the slice's last.
  void fill(int first, int rows, SlicePixel* pixels) const;

 private:
  struct Span {
    int low = 0, high = 0;  // inclusive
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
  std::vector<std::uint8_t> mark_;  // with blocks: mark of each pixel, see pixel_plan.cpp
  std::vector<short> codes_;        // by mark
  std::size_t level_ = 0;           // the level at work
  int row_ = 0, column_ = 0;        // the next block there, or the next pixel
  std::uint64_t known_count_ = 0, filled_ = 0;
};

}  // namespace equipoise
