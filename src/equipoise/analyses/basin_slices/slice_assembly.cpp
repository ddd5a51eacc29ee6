// Assembles a slice in one pass over its rows.
#include "equipoise/analyses/basin_slices/slice_assembly.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

#include "equipoise/analyses/basin_slices/basin_slice.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/results/types/fate.hpp"

namespace equipoise {

namespace {

// Rows read at once.
constexpr int band_rows = 64;

}  // namespace

std::vector<OutcomeShare> map_codes(const std::map<short, OutcomeShare>& seen, const Study& study) {
  std::vector<OutcomeShare> codes;
  for (const auto& [given, code] : seen) codes.push_back(code);
  std::sort(codes.begin(), codes.end(), [](const OutcomeShare& a, const OutcomeShare& b) { return a.id < b.id; });
  for (const NoAttractor& n : no_attractors)
    if (n.outcome != Outcome::stalled || study.speed.driven()) {
      const bool overlap = n.outcome == Outcome::failed && study.parameters.balls_collide();
      codes.push_back({n.code, overlap ? "balls would overlap, or failed" : n.name, "", {}});
    }
  return codes;
}

SliceAssembly::SliceAssembly(BasinSlice& map, const PixelStore& store, const std::map<short, OutcomeShare>& seen)
    : map_(map), store_(store), seen_(seen), figures_(map), invariant_(map), one_rotor_(!map.balance_margin.empty()) {
  map_.codes = map_codes(seen, map.study);
  map_.pixels = static_cast<std::uint64_t>(map.x.pixels) * static_cast<std::uint64_t>(map.y.pixels);
  if (map_.pixels > most_pixels_in_memory)
    every_ = (std::max(map.x.pixels, map.y.pixels) + most_held_side - 1) / most_held_side;
  every_ = std::min({every_, map.x.pixels, map.y.pixels});
  const std::size_t held =
      static_cast<std::size_t>(thinned(map.x, every_).pixels) * static_cast<std::size_t>(thinned(map.y, every_).pixels);
  map.code.reserve(held);
  map.time.reserve(held);
  map.r_max.reserve(held);
}

// Codes may come from a file, and be anything.
short SliceAssembly::id_of(short code) const {
  const auto found = seen_.find(code);
  if (found == seen_.end())
    throw RunError(fmt::format("the map is damaged: a pixel has outcome {}, which it does not name", code));
  return static_cast<short>(found->second.id);
}

void SliceAssembly::run() {
  const std::size_t columns = static_cast<std::size_t>(map_.x.pixels);
  std::vector<SlicePixel> pixels;
  for (int first = 0; first < map_.y.pixels; first += band_rows) {
    const int there = std::min(band_rows, map_.y.pixels - first);
    pixels.resize(columns * static_cast<std::size_t>(there));
    store_.read_rows(first, there, pixels.data());
    give_codes(pixels);
    for (int row = 0; row < there; ++row) add_row(first + row, pixels.data() + columns * static_cast<std::size_t>(row));
  }
  finish();
}

void SliceAssembly::give_codes(std::vector<SlicePixel>& pixels) const {
  const bool same = std::all_of(seen_.begin(), seen_.end(), [](const auto& s) { return s.first == s.second.id; });
  if (same) return;
  for (SlicePixel& pixel : pixels)
    if (pixel.code > 0) pixel.code = id_of(pixel.code);
}

void SliceAssembly::add_row(int row, const SlicePixel* pixels) {
  const std::size_t columns = static_cast<std::size_t>(map_.x.pixels);
  std::vector<short> codes(columns);
  for (std::size_t k = 0; k < columns; ++k) {
    codes[k] = invariant_.holds(static_cast<int>(k), row) ? left_out_code : pixels[k].code;
    map_.pixels_computed += pixels[k].code != not_computed_code;
  }
  for (std::size_t begin = 0, end = 0; begin < columns; begin = end) {  // rows are long runs of one code
    while (end < columns && codes[end] == codes[begin]) ++end;
    counts_[codes[begin]] += end - begin;
  }
  figures_.add_row(codes.data());
  if (row % every_ == first_of(every_)) hold(pixels);
}

void SliceAssembly::hold(const SlicePixel* pixels) {
  for (int column = first_of(every_); column < map_.x.pixels; column += every_) {
    const SlicePixel& pixel = pixels[column];
    map_.code.push_back(pixel.code);
    map_.time.push_back(pixel.time);
    map_.r_max.push_back(pixel.r_max);
    if (one_rotor_) continue;
    map_.balance_margin.push_back(pixel.balance_margin);
    map_.balance_growth.push_back(pixel.balance_growth);
  }
}

void SliceAssembly::finish() {
  const std::uint64_t missing = counts_[not_computed_code];
  map_.complete = map_.pixels_computed == map_.pixels;
  map_.pixels_left_out = invariant_.count();
  for (OutcomeShare& code : map_.codes)
    code.share = wilson_share(counts_[static_cast<short>(code.id)], map_.pixels - map_.pixels_left_out - missing);
  if (map_.complete && !draws_starts(map_)) map_.figures = figures_.figures();
  map_.x = thinned(map_.x, every_);
  map_.y = thinned(map_.y, every_);
  map_.every = every_;
}

}  // namespace equipoise
