// Requests edges, judges blocks, fills in their insides.
#include "equipoise/analyses/basin_slices/pixel_plan.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/results/result_files/basin_file.hpp"

namespace equipoise {

namespace {

// Marks of a pixel: unknown; asked for; known, but no outcome or one too many; from first_outcome on: its outcome.
constexpr std::uint8_t unknown = 0, asked = 1, alone = 2, first_outcome = 3;
constexpr std::size_t most_outcomes = 256 - first_outcome;

}  // namespace

PixelPlan::PixelPlan(int columns, int rows, int block) : columns_(columns), rows_(rows) {
  if (block == 0) {
    known_.assign(size(), false);
    return;
  }
  mark_.assign(size(), unknown);
  for (int side = block; side >= 1; side /= 2)
    levels_.push_back({side, std::max(1, (columns - 2) / side + 1), std::max(1, (rows - 2) / side + 1), {}});
}

void PixelPlan::know(std::uint32_t position, short code) {
  if (known(position)) return;
  ++known_count_;
  if (mark_.empty()) {
    known_[position] = true;
    return;
  }
  std::uint8_t mark = alone;
  if (code > 0 || code == diverged_code || code == stalled_code) {
    const auto entry = std::find(codes_.begin(), codes_.end(), code);
    const auto number = static_cast<std::size_t>(entry - codes_.begin());
    if (entry == codes_.end() && number < most_outcomes) codes_.push_back(code);
    if (number < most_outcomes) mark = static_cast<std::uint8_t>(first_outcome + number);
  }
  mark_[position] = mark;
}

bool PixelPlan::known(std::uint32_t position) const {
  return mark_.empty() ? known_[position] : mark_[position] >= alone;
}

std::vector<std::uint32_t> PixelPlan::next(std::size_t most) {
  if (mark_.empty()) return next_of_all(most);
  std::vector<std::uint32_t> batch;
  while (level_ < levels_.size() && batch.size() < most) {
    if (!ask_edges(level_, most, batch)) break;  // there are enough
    if (!batch.empty()) break;                   // they must be known before blocks are judged
    judge(level_++);
    row_ = column_ = 0;
  }
  return batch;
}

std::vector<std::uint32_t> PixelPlan::next_of_all(std::size_t most) {
  std::vector<std::uint32_t> batch;
  for (; row_ < rows_; ++row_, column_ = 0)
    for (; column_ < columns_; ++column_) {
      if (batch.size() == most) return batch;
      if (const std::uint32_t here = at(column_, row_); !known_[here]) batch.push_back(here);
    }
  return batch;
}

PixelPlan::Span PixelPlan::span(int block, int side, int pixels) const {
  return {block * side, std::min((block + 1) * side, pixels - 1)};
}

bool PixelPlan::live(std::size_t level, int x, int y) const {
  if (level == 0) return true;
  const Level& parent = levels_[level - 1];
  return parent.divided[static_cast<std::size_t>(y / 2) * static_cast<std::size_t>(parent.across) +
                        static_cast<std::size_t>(x / 2)];
}

// Starts at the next block. False if `most` were requested before the level's end.
bool PixelPlan::ask_edges(std::size_t level, std::size_t most, std::vector<std::uint32_t>& batch) {
  const Level& l = levels_[level];
  for (; row_ < l.down; ++row_, column_ = 0)
    for (; column_ < l.across; ++column_) {
      if (!live(level, column_, row_)) continue;
      if (batch.size() >= most) return false;
      const Span x = span(column_, l.side, columns_), y = span(row_, l.side, rows_);
      for (const int row : {y.low, y.high})
        for (int column = x.low; column <= x.high; ++column) ask(column, row, batch);
      for (int row = y.low + 1; row < y.high; ++row)
        for (const int column : {x.low, x.high}) ask(column, row, batch);
    }
  return true;
}

void PixelPlan::ask(int column, int row, std::vector<std::uint32_t>& batch) {
  const std::uint32_t here = at(column, row);
  if (mark_[here] != unknown) return;
  mark_[here] = asked;
  batch.push_back(here);
}

// Compares everything known of the block: its edges, and pixels from a file.
bool PixelPlan::agrees(const Span& x, const Span& y) const {
  const std::uint8_t mark = mark_[at(x.low, y.low)];
  if (mark < first_outcome) return false;
  for (const int row : {y.low, y.high})
    for (int column = x.low; column <= x.high; ++column)
      if (mark_[at(column, row)] != mark) return false;
  for (int row = y.low + 1; row < y.high; ++row) {
    if (mark_[at(x.low, row)] != mark || mark_[at(x.high, row)] != mark) return false;
    for (int column = x.low + 1; column < x.high; ++column)
      if (const std::uint8_t inside = mark_[at(column, row)]; inside != unknown && inside != mark) return false;
  }
  return true;
}

void PixelPlan::judge(std::size_t level) {
  Level& l = levels_[level];
  if (l.side == 1) return;  // all corners
  l.divided.assign(static_cast<std::size_t>(l.across) * static_cast<std::size_t>(l.down), false);
  for (int by = 0; by < l.down; ++by)
    for (int bx = 0; bx < l.across; ++bx) {
      if (!live(level, bx, by)) continue;
      const Span x = span(bx, l.side, columns_), y = span(by, l.side, rows_);
      if (!agrees(x, y)) {
        l.divided[static_cast<std::size_t>(by) * static_cast<std::size_t>(l.across) + static_cast<std::size_t>(bx)] =
            true;
        continue;
      }
      for (int row = y.low + 1; row < y.high; ++row)
        for (int column = x.low + 1; column < x.high; ++column) filled_ += mark_[at(column, row)] == unknown;
    }
}

void PixelPlan::close() {
  mark_ = {};
  known_ = {};
}

void PixelPlan::fill(int first, int rows, SlicePixel* pixels) const {
  if (levels_.empty()) return;
  const Level& l = levels_.front();
  for (int y = first / l.side; y < l.down && y * l.side < first + rows - 1; ++y)
    for (int x = 0; x < l.across; ++x) fill_block(0, x, y, first, pixels);
}

void PixelPlan::fill_block(std::size_t level, int x, int y, int first, SlicePixel* pixels) const {
  const Level& l = levels_[level];
  if (level >= level_ || l.side == 1) return;  // not judged, or nothing inside
  if (!l.divided[static_cast<std::size_t>(y) * static_cast<std::size_t>(l.across) + static_cast<std::size_t>(x)])
    return fill_inside(span(x, l.side, columns_), span(y, l.side, rows_), first, pixels);
  const Level& next = levels_[level + 1];
  for (int v = 2 * y; v < std::min(2 * y + 2, next.down); ++v)
    for (int u = 2 * x; u < std::min(2 * x + 2, next.across); ++u) fill_block(level + 1, u, v, first, pixels);
}

// The time of decision is unknown; balance is interpolated between the corners.
void PixelPlan::fill_inside(const Span& x, const Span& y, int first, SlicePixel* pixels) const {
  const auto here = [&](int column, int row) -> SlicePixel& {
    return pixels[static_cast<std::size_t>(row - first) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(column)];
  };
  const SlicePixel corners[]{here(x.low, y.low), here(x.high, y.low), here(x.low, y.high), here(x.high, y.high)};
  for (int row = y.low + 1; row < y.high; ++row)
    for (int column = x.low + 1; column < x.high; ++column) {
      SlicePixel& pixel = here(column, row);
      if (pixel.computed) continue;
      const float u = static_cast<float>(column - x.low) / static_cast<float>(x.high - x.low);
      const float v = static_cast<float>(row - y.low) / static_cast<float>(y.high - y.low);
      const auto between = [&](float SlicePixel::*number) {
        return (1.0f - v) * ((1.0f - u) * corners[0].*number + u * corners[1].*number) +
               v * ((1.0f - u) * corners[2].*number + u * corners[3].*number);
      };
      pixel.code = corners[0].code;
      pixel.balance_margin = between(&SlicePixel::balance_margin);
      pixel.balance_growth = between(&SlicePixel::balance_growth);
    }
}

}  // namespace equipoise
