// From a study and two axes to a basin slice: pixels are requested, computed, kept and put together.
#include "equipoise/analyses/basin_slices/basin_slice.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "equipoise/analyses/basin_slices/slice_axis.hpp"
#include "equipoise/analyses/basin_slices/slice_figures.hpp"
#include "equipoise/analyses/basin_slices/slice_names.hpp"
#include "equipoise/analyses/basin_slices/slice_store.hpp"
#include "equipoise/analyses/basin_slices/start_pixels.hpp"
#include "equipoise/analyses/continuation/parameter_line.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/ensembles/stored_ensemble.hpp"
#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/running/run_info.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/results/types/outcome.hpp"
#include "equipoise/simulation/kernels/long_call.hpp"

namespace equipoise {

namespace {

// Unless the study states it: long enough for pixels of a family whose rotors may settle slowly.
constexpr double default_horizon = 3000.0;
// Starts requested at once: 16 MB of numbers, minutes of work.
constexpr std::size_t most_starts_asked = std::size_t{1} << 22;

void check(const BasinSlice& map) {
  check_axes(map.x, map.y, "map", "pixels");
  for (const AngleLink& link : map.links)
    if (std::min(link.ball, link.of) < 1 || std::max(link.ball, link.of) > map.study.parameters.balls ||
        link.ball == link.of)
      throw InputError("map", "links", fmt::format("phi_{} = phi_{} + {}", link.ball, link.of, link.offset),
                       fmt::format("must name two different balls from 1 to {}", map.study.parameters.balls));
  for (std::size_t k = 0; k < map.links.size(); ++k) {
    const AngleLink& link = map.links[k];
    const auto moved = [&](const std::string& by) {
      throw InputError("map", "links", fmt::format("phi_{} = phi_{} + {}", link.ball, link.of, link.offset),
                       fmt::format("ball {} has its angle from {}; must be another ball", link.ball, by));
    };
    for (const SliceAxis* axis : {&map.x, &map.y})
      if (axis->key == fmt::format("initial.phi_{}", link.ball)) moved("an axis");
    for (std::size_t other = 0; other < k; ++other)
      if (map.links[other].ball == link.ball) moved("another tie");
  }
  for (const int column : {0, map.x.pixels - 1})
    for (const int row : {0, map.y.pixels - 1}) check_offers(study_at(map, column, row), model::ResultKind::maps);
  const auto with_x = [&](int column) {
    return to_toml(study_with(study_with(map.study, map.x.key, map.x.centre(column)), map.y.key, map.y.centre(0)));
  };
  if (map.x.pixels > 1 && with_x(0) == with_x(map.x.pixels - 1))
    throw InputError("map", map.x.key, "", fmt::format(set_by_other_axis, map.y.key));
}

// Along a parameter no rule is made that could use other grounds.
void check_decides(const Study& study) {
  const ClassificationMode decide = study.numerics.decide;
  if (decide != ClassificationMode::validated)
    throw InputError(
        study.name, "numerics.decide", classification_mode_names[static_cast<std::size_t>(decide)],
        "along a parameter every pixel is followed until it is seen to approach a motion; must be \"validated\"");
}

void check_memory(const BasinSlice& map, const std::string& output) {
  if (output.empty() && pixels_of(map.x, map.y) > most_pixels_in_memory)
    throw InputError("map", "size", fmt::format("{}x{}", map.x.pixels, map.y.pixels),
                     fmt::format("pixels; more than {:.1f} million in all (4096x4096) must go to an output file",
                                 1e-6 * static_cast<double>(most_pixels_in_memory)));
}

// Without shares yet: the attractors seen, with final codes, then outcomes without attractor.
std::vector<OutcomeShare> map_codes(const std::map<short, OutcomeShare>& seen, const Study& study) {
  std::vector<OutcomeShare> codes;
  for (const auto& [given, code] : seen) codes.push_back(code);
  std::sort(codes.begin(), codes.end(), [](const OutcomeShare& a, const OutcomeShare& b) { return a.id < b.id; });
  for (const NoAttractor& n : no_attractors)
    if (n.kind != OutcomeKind::stalled || study.speed.driven()) {
      const bool overlap = n.kind == OutcomeKind::failed && study.parameters.balls_collide();
      codes.push_back({n.code, overlap ? "balls would overlap, or failed" : n.name, "", {}});
    }
  return codes;
}

constexpr int band_rows = 64;  // read at once

// A 32nd of the pixels that count, because following them again takes time, and no more than a share needs. They are
// spread over the slice by the additive recurrence of M. Roberts (extremelearning.com.au, 2018). None of a small slice,
// or if pixels draw their starts.
std::vector<std::uint32_t> spread_pixels(const BasinSlice& map) {
  constexpr std::uint64_t part = 32, fewest = 100, most = 1024;
  constexpr double across = 0.7548776662466927, up = 0.5698402909980532;
  const InvariantPixels invariant(map);
  const std::uint64_t wanted = std::min(most, (pixels_of(map.x, map.y) - invariant.count()) / part);
  std::vector<std::uint32_t> positions;
  if (wanted < fewest || draws_starts(map)) return positions;
  for (double k = 1.0; positions.size() < wanted; ++k) {
    const auto place = [k](double step, int pixels) { return static_cast<int>(std::fmod(k * step, 1.0) * pixels); };
    const int column = place(across, map.x.pixels), row = place(up, map.y.pixels);
    if (!invariant.holds(column, row))
      positions.push_back(static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(map.x.pixels) +
                          static_cast<std::uint32_t>(column));
  }
  return positions;
}

class MapRun {
 public:
  MapRun(const Study& study, const BasinSliceSettings& settings) : settings_(settings) {
    map_.study = with_medians(study);
    map_.x = settings.x;
    map_.y = settings.y;
    map_.links = settings.links;
  }

  BasinSlice run() {
    const RunClock clock;
    check(map_);
    check_memory(map_, settings_.output);
    prepare();
    open();
    if (file_ && file_->says_complete()) {
      read_whole();
    } else {
      compute();
      if (complete_) compare_tolerances();
      put_together();
    }
    map_.took(clock.time());
    return std::move(map_);
  }

 private:
  void prepare() {
    note_machine(map_, settings_);
    starts_ = maps_starts(map_);
    if (starts_) {
      map_.study = with_horizon(map_.study);
      map_.balance_margin = {static_cast<float>(balance_margin(map_.study.parameters))};
      map_.balance_growth = {static_cast<float>(balance_growth(map_.study.system()))};
    } else {
      check_decides(map_.study);
      if (!map_.study.numerics.horizon) map_.study.numerics.horizon = default_horizon;
    }
    const BasinFileHeader of_starts = basin_file_header(map_.study, true, false);
    header_ = {to_toml(map_.study), map_.x, map_.y, map_.links, of_starts.arithmetic, starts_};
    header_.components = of_starts.variables.size();
    if (!starts_) return;
    header_.rotor.balance_margin = map_.balance_margin.front();
    header_.rotor.balance_growth = map_.balance_growth.front();
  }

  void open() {
    if (!settings_.output.empty()) {
      file_ = std::make_unique<SliceStore>(settings_.output, header_);
      give_notice(settings_, file_->loss());
      for (const OutcomeShare& code : file_->codes()) names_.know(code);
    } else {
      held_.resize(pixels_of(map_.x, map_.y));
    }
  }

  void read_whole() {
    std::map<short, OutcomeShare> codes;
    for (const OutcomeShare& c : names_.codes()) codes.emplace(c.id, c);
    assemble(codes);
    map_.pixels_kept = map_.pixels_computed;
    map_.figures.flipped = file_->flipped();
    map_.read_whole = true;
  }

  void compute() {
    known_.assign(pixels_of(map_.x, map_.y), false);
    if (file_)
      file_->for_each_known([&](std::uint32_t position, short code) {
        if (code > 0 && !names_.listed(code)) return names_.avoid(code);  // computed again
        know(position, code);
      });
    map_.pixels_kept = known_count_;
    for (;;) {
      const auto positions = next_open();
      if (positions.empty() || !start_pixels().compute(positions)) break;
    }
    complete_ = known_count_ == known_.size();
    known_ = {};
  }

  void know(std::uint32_t position, short code) {
    known_count_ += !known_[position];
    known_[position] = true;
    names_.see(code, position);
  }

  std::vector<std::uint32_t> next_open() {
    std::vector<std::uint32_t> positions;
    for (; next_ < known_.size() && positions.size() < most_starts_asked; ++next_)
      if (!known_[next_]) positions.push_back(static_cast<std::uint32_t>(next_));
    return positions;
  }

  StartPixels& start_pixels() {
    if (!start_pixels_)
      start_pixels_.emplace(map_, settings_, names_, file_.get(),
                            [this](const auto& places, const auto& pixels) { take(places, pixels); });
    return *start_pixels_;
  }

  // Follows some pixels again: this shows how far the others can be trusted. Not complete if stopped meanwhile.
  void compare_tolerances() {
    constexpr double finest = 1e-14;  // below this, rounding decides
    const std::vector<std::uint32_t> positions = spread_pixels(map_);
    const double tolerance = SliceFigures::finer * map_.study.numerics.tolerance.value_or(default_basin_tolerance);
    if (positions.empty() || tolerance < finest) return;
    flipped_ = start_pixels().flipped(positions, tolerance);
    complete_ = flipped_.has_value();
  }

  void take(const std::vector<std::uint32_t>& positions, const std::vector<SlicePixel>& pixels) {
    if (file_) file_->append(positions, pixels);
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      if (!file_) held_[positions[k]] = pixels[k];
      know(positions[k], pixels[k].code);
    }
    if (settings_.progress) settings_.progress({known_count_, known_.size(), "pixels", {}});
  }

  void put_together() {
    const auto seen = names_.seen(complete_);  // a run that continues must find the codes that this one gave
    assemble(seen);
    map_.complete = complete_;
    map_.figures.flipped = flipped_;
    if (file_ && (file_->unfinished() || complete_)) file_->finish(map_.codes, seen, complete_, flipped_);
  }

  // Reads all rows in order and counts: shares and figures. If the slice is large, only some pixels stay in the result.
  void assemble(const std::map<short, OutcomeShare>& seen) {
    map_.codes = map_codes(seen, map_.study);
    map_.pixels = pixels_of(map_.x, map_.y);
    if (map_.pixels > most_pixels_in_memory)
      map_.every = (std::max(map_.x.pixels, map_.y.pixels) + most_held_side - 1) / most_held_side;
    map_.every = std::min({map_.every, map_.x.pixels, map_.y.pixels});
    const SliceAxis x = thinned(map_.x, map_.every), y = thinned(map_.y, map_.every);
    map_.code.reserve(pixels_of(x, y));
    map_.time.reserve(pixels_of(x, y));
    map_.r_max.reserve(pixels_of(x, y));
    const InvariantPixels invariant(map_);
    SliceFigureCount figures(map_);
    std::map<short, std::uint64_t> counts;
    std::vector<short> codes(static_cast<std::size_t>(map_.x.pixels));
    std::vector<SlicePixel> pixels;
    for (int row = 0; row < map_.y.pixels; ++row) {
      if (row % band_rows == 0) pixels = rows_from(row, seen);
      const SlicePixel* line = &pixels[codes.size() * static_cast<std::size_t>(row % band_rows)];
      for (std::size_t k = 0; k < codes.size(); ++k) {
        codes[k] = invariant.holds(static_cast<int>(k), row) ? left_out_code : line[k].code;
        map_.pixels_computed += line[k].code != not_computed_code;
      }
      for (std::size_t begin = 0, end = 0; begin < codes.size(); begin = end) {  // rows are long runs of one code
        while (end < codes.size() && codes[end] == codes[begin]) ++end;
        counts[codes[begin]] += end - begin;
      }
      if (!counts.contains(not_computed_code)) figures.add_row(codes.data());  // only a complete map has any
      if (row % map_.every == first_of(map_.every)) hold(line);
    }
    map_.complete = map_.pixels_computed == map_.pixels;
    map_.pixels_left_out = invariant.count();
    map_.balls_together = invariant.everywhere();
    const std::uint64_t counted = map_.pixels - map_.pixels_left_out - counts[not_computed_code];
    for (OutcomeShare& code : map_.codes) code.share = wilson_share(counts[static_cast<short>(code.id)], counted);
    if (map_.complete && !draws_starts(map_)) map_.figures = figures.figures();
    map_.x = x;
    map_.y = y;
  }

  // A band of rows, with final codes.
  std::vector<SlicePixel> rows_from(int first, const std::map<short, OutcomeShare>& seen) const {
    const int rows = std::min(band_rows, map_.y.pixels - first);
    const auto columns = static_cast<std::size_t>(map_.x.pixels);
    std::vector<SlicePixel> pixels(columns * static_cast<std::size_t>(rows));
    if (file_)
      file_->read_rows(first, rows, pixels.data());
    else
      std::copy_n(&held_[static_cast<std::size_t>(first) * columns], pixels.size(), pixels.begin());
    if (std::all_of(seen.begin(), seen.end(), [](const auto& s) { return s.first == s.second.id; })) return pixels;
    for (SlicePixel& pixel : pixels) {
      if (pixel.code <= 0) continue;
      const auto found = seen.find(pixel.code);
      if (found == seen.end())  // codes may come from a file, and be anything
        throw RunError(fmt::format("the map is damaged: a pixel has outcome {}, which it does not name", pixel.code));
      pixel.code = static_cast<short>(found->second.id);
    }
    return pixels;
  }

  void hold(const SlicePixel* pixels) {
    for (int column = first_of(map_.every); column < map_.x.pixels; column += map_.every) {
      map_.code.push_back(pixels[column].code);
      visit_pixel_numbers(starts_,
                          [&](std::size_t, const PixelNumber& n) { (map_.*n.all).push_back(pixels[column].*n.value); });
    }
  }

  const BasinSliceSettings& settings_;
  bool starts_ = false, complete_ = false;
  BasinSlice map_;
  io::SliceFileHeader header_;
  std::unique_ptr<SliceStore> file_;
  std::vector<SlicePixel> held_;  // without a file: all, row by row
  SliceNames names_;
  std::vector<bool> known_;  // pixels, row by row
  std::uint64_t known_count_ = 0;
  std::size_t next_ = 0;  // all before it are known or were requested
  std::optional<StartPixels> start_pixels_;
  std::optional<Share> flipped_;  // SliceFigures::flipped
};

}  // namespace

BasinSlice basin_slice(const Study& study, const BasinSliceSettings& settings) {
  check_has_balls(study);
  return long_call(settings, [&](const BasinSliceSettings& s) { return MapRun(study, s).run(); });
}

}  // namespace equipoise
