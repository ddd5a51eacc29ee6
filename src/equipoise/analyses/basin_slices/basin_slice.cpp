// From a study and two axes to a basin slice: pixels are requested, computed, kept and put together.
#include "equipoise/analyses/basin_slices/basin_slice.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "equipoise/analyses/basin_slices/invariant_pixels.hpp"
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
  const std::uint64_t pixels = static_cast<std::uint64_t>(map.x.pixels) * static_cast<std::uint64_t>(map.y.pixels);
  if (output.empty() && pixels > most_pixels_in_memory)
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

// Reads all rows of a slice in order, renames codes by `seen`, and counts. Adds to `map`, whose axes are those of the
// whole slice: pixels (of a large slice, only some), shares, figures.
class SliceAssembly {
 public:
  using ReadRows = std::function<void(int first, int rows, SlicePixel* pixels)>;  // whole rows
  SliceAssembly(BasinSlice& map, const ReadRows& read_rows, const std::map<short, OutcomeShare>& seen);
  void run();

 private:
  short id_of(short code) const;
  void give_codes(std::vector<SlicePixel>& pixels) const;
  void add_row(int row, const SlicePixel* pixels);
  void hold(const SlicePixel* pixels);
  void finish();

  BasinSlice& map_;
  const ReadRows& read_rows_;
  const std::map<short, OutcomeShare>& seen_;
  SliceFigureCount figures_;
  const InvariantPixels invariant_;
  std::map<short, std::uint64_t> counts_;
  bool one_rotor_;
  int every_ = 1;
};

// Rows read at once.
constexpr int band_rows = 64;

SliceAssembly::SliceAssembly(BasinSlice& map, const ReadRows& read_rows, const std::map<short, OutcomeShare>& seen)
    : map_(map),
      read_rows_(read_rows),
      seen_(seen),
      figures_(map),
      invariant_(map),
      one_rotor_(!map.balance_margin.empty()) {
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
    read_rows_(first, there, pixels.data());
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
  if (!counts_.contains(not_computed_code)) figures_.add_row(codes.data());  // only a complete map has any
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
  map_.balls_together = invariant_.everywhere();
  for (OutcomeShare& code : map_.codes)
    code.share = wilson_share(counts_[static_cast<short>(code.id)], map_.pixels - map_.pixels_left_out - missing);
  if (map_.complete && !draws_starts(map_)) map_.figures = figures_.figures();
  map_.x = thinned(map_.x, every_);
  map_.y = thinned(map_.y, every_);
  map_.every = every_;
}

// A 32nd of the pixels that count, because following them again takes time, and no more than a share needs. They are
// spread over the slice by the additive recurrence of M. Roberts (extremelearning.com.au, 2018). None of a small slice,
// or if pixels draw their starts.
std::vector<std::uint32_t> spread_pixels(const BasinSlice& map) {
  constexpr std::uint64_t part = 32, fewest = 100, most = 1024;
  constexpr double across = 0.7548776662466927, up = 0.5698402909980532;
  const InvariantPixels invariant(map);
  const std::uint64_t all = static_cast<std::uint64_t>(map.x.pixels) * static_cast<std::uint64_t>(map.y.pixels);
  const std::uint64_t wanted = std::min(most, (all - invariant.count()) / part);
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
  std::size_t pixel_count() const {
    return static_cast<std::size_t>(map_.x.pixels) * static_cast<std::size_t>(map_.y.pixels);
  }

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
      held_.resize(pixel_count());
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
    known_.assign(pixel_count(), false);
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

  void assemble(const std::map<short, OutcomeShare>& seen) {
    const SliceAssembly::ReadRows read_rows = [this](int first, int rows, SlicePixel* to) {
      if (file_) return file_->read_rows(first, rows, to);
      const auto columns = static_cast<std::size_t>(map_.x.pixels);
      std::copy_n(&held_[static_cast<std::size_t>(first) * columns], static_cast<std::size_t>(rows) * columns, to);
    };
    SliceAssembly(map_, read_rows, seen).run();
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
